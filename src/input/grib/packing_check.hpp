// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "input/grib/messages.hpp"

namespace cloudgen::input::grib {

/// Throws InputError if the packed values of a field do not fit its sections: ecCodes follows the counts and
/// widths of a message without looking whether the octets are there. `count` is the number of points.
void checkPacking(const FieldLocation& location, const std::array<std::string, 8>& sections,
                  std::size_t count);

}  // namespace cloudgen::input::grib
