// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

/// Opens input files with the reader that knows their format (by content, not by name).
/// Throws InputError: missing, empty, truncated, unknown format, no cloud field.
std::unique_ptr<field::Source> open(const std::vector<std::filesystem::path>& files,
                                    const OpenOptions& options = {});

}  // namespace cloudgen::input
