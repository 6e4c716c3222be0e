// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Every format that this build writes, in the order in which they are written.
std::span<const Format> formats();

/// The formats that are designed but not part of this build, with what they will be.
std::span<const std::pair<std::string_view, std::string_view>> formatsNotBuilt();

/// The formats of a list like "x3d,glb"; "default" and an empty list mean the default set. Throws UsageError
/// for an unknown name (with the nearest known one) and NotBuiltError for one that this build lacks.
std::vector<const Format*> chosenFormats(const std::string& list);

}  // namespace cloudgen::writer
