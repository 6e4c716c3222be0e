// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "input/grib/messages.hpp"

/// What ecCodes is asked for: values and names. Whatever it finds wrong becomes an InputError that names the
/// message; it prints nothing and does not abort. To keep it away from what it need not know, it sees
/// messages that are made for the purpose.
namespace cloudgen::input::grib {

/// Every value of a field in the order of the file; NaN where the bitmap says missing. Throws InputError for
/// damaged data, and unless there are `count`.
std::vector<double> decodedValues(const FieldLocation& location, std::size_t count);

/// What decodeValues() gives for a missing value.
inline constexpr double kMissingValue = -1e100;

/// The same as ecCodes gives them, into a vector that may serve again for the next message: with millions of
/// values each pass over them counts.
void decodeValues(const FieldLocation& location, std::size_t count, std::vector<double>& values);

/// ecCodes' short name of a field, by its head; "unknown" where it has none.
std::string shortNameOf(const FieldHead& head);

}  // namespace cloudgen::input::grib
