// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/grib/product.hpp"

namespace cloudgen::input::grib {

/// "NCEP GFS", or centre and process by number.
std::string modelName(const Product& product);

}  // namespace cloudgen::input::grib
