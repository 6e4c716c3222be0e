// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.hpp"

namespace cloudgen::writer {

/// What the page says about the scene (title, times, box, mapping, sun, sky, counts by genus), as JSON that
/// is safe inside an HTML script element. `splatsFile` is the file to fetch, or empty when the splats stand
/// in the page.
std::string pageData(const scene::Scene& scene, std::uint64_t splatsBytes, const std::string& splatsFile);

}  // namespace cloudgen::writer
