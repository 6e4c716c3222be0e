// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/cloud_columns.hpp"
#include "field/source.hpp"

namespace cloudgen::field {

/// Reads a source level by level and keeps the cloudy cells of the columns `cells` (grid indices, ascending).
/// A cell reaches half-way (in height) to the levels below and above. Throws InputError when the source has no
/// condensate or lacks what heights and temperatures need.
CloudColumns collectColumns(const Source& source, const std::vector<std::uint32_t>& cells);

}  // namespace cloudgen::field
