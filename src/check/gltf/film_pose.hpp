// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "check/gltf/glb_parts.hpp"

namespace cloudgen::check {

/// The nodes of a file as its first animation has them, so many seconds of the forecast after the start: the asset says
/// how many seconds of the animation are an hour. Throws json::exception where the file has no such animation.
nlohmann::json nodesAt(const GlbParts& glb, double seconds);

}  // namespace cloudgen::check
