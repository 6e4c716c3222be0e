// SPDX-License-Identifier: Apache-2.0
#include "input/grib/grib.hpp"

#include "input/grib/messages.hpp"
#include "input/model/model_source.hpp"

namespace cloudgen::input {

bool isGrib(std::string_view firstBytes) { return grib::startsLikeGrib(firstBytes); }

std::unique_ptr<field::Source> openGrib(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options) {
  return model::makeSource(grib::readContents(files), options);
}

}  // namespace cloudgen::input
