// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

/// Opens input files with the reader that knows their format (by content, by name only where the format has
/// no header). A folder stands for the files in it that a reader knows, by name, unless a reader knows the
/// folder as such. Throws InputError: missing, empty, truncated, unknown format, no cloud field.
std::unique_ptr<field::Source> open(const std::vector<std::filesystem::path>& files,
                                    const OpenOptions& options = {});

}  // namespace cloudgen::input
