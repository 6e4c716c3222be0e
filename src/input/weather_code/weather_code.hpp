// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"
#include "input/weather_code/foreca_json.hpp"

namespace cloudgen::input {

/// JSON with weather symbols (Foreca): "weather" or "forecast" and a code such as "d210".
bool isWeatherCode(std::string_view firstBytes);

/// Opens the forecasts of one place or of several; files of one place are joined. The grid is a lattice of
/// cells of 20 km over all places (see kSkySideMeters). A cell takes the skies of the places within 60 km of
/// its middle, weighted by the inverse square of their distance (Shepard 1968): counts, covers and heights
/// of the same part of the sky are averaged. Cells farther from every place tell nothing. Places without
/// coordinates take options.place. Throws InputError: not such a JSON, no place, a time that is not there.
std::unique_ptr<field::Source> openWeatherCode(const std::vector<std::filesystem::path>& files,
                                               const OpenOptions& options);

/// The same from what was read.
std::unique_ptr<field::Source> skyOfPlaces(std::vector<CodedPlace> places,
                                           const std::vector<std::string>& files, const OpenOptions& options);

}  // namespace cloudgen::input
