// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

bool isDescribedSky(std::string_view firstBytes);

/// A described sky (schemas/sky.schema.json): typed layers stated outright, on a grid of equal cells over a
/// box. `where` is the file's name for messages. Throws InputError that names the place in the JSON document.
std::unique_ptr<field::Source> readDescribedSky(std::string_view text, const std::string& where);

/// Opens one file of that kind; throws InputError for several.
std::unique_ptr<field::Source> openDescribedSky(const std::vector<std::filesystem::path>& files,
                                                const OpenOptions& options);

}  // namespace cloudgen::input
