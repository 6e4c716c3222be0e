// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "field/source.hpp"
#include "input/netcdf/file.hpp"

namespace cloudgen::input::netcdf {

/// The moments that a time variable tells, by its units and calendar; nothing where a value is missing or
/// absurd. Times of a calendar with other leap days keep their date, with a warning. Throws InputError if the
/// unit or the calendar is none.
std::vector<std::optional<base::UtcTime>> moments(const File& file, const Variable& variable,
                                                  std::vector<field::Warning>& warnings);

/// "2005-08-28_00:00:00", as WRF writes it.
std::optional<base::UtcTime> wrfTime(const std::string& text);

}  // namespace cloudgen::input::netcdf
