// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cloudgen::check {

/// The path that a content's uri names from the folder of its tileset, percent signs decoded and anything
/// from a question mark on left out; an empty text if it leads out of that folder or is no plain path.
std::string contentPath(std::string_view uri);

}  // namespace cloudgen::check
