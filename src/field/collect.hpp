// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/cloud_columns.hpp"
#include "field/source.hpp"

namespace cloudgen::field {

/// In-cloud water that no cell exceeds, kg/kg: where the given or derived fraction would make it denser, the
/// fraction is raised. Adiabatic cloud water of deep convection hardly passes 3 g/kg (Pruppacher & Klett, ch.
/// 2).
inline constexpr float kMostInCloudWater = 3e-3f;

/// Cells with less cover than this are clear, as in WRF's Xu & Randall.
inline constexpr float kLeastFraction = 0.01f;

/// Reads a source level by level (three levels in memory at a time) and keeps the cloudy cells of the columns
/// `cells` (grid indices, ascending). A cell reaches half-way (in height) to the levels below and above; the
/// lowest and the highest one reach as far outwards as inwards; none reaches below the surface, and levels
/// below the surface are dropped where the source knows the orography or the surface pressure. Fraction: the
/// source's; Xu & Randall where it has none, or where it is zero in every cloudy cell. Throws InputError when
/// the source has no condensate or lacks what heights, fraction and temperatures need.
CloudColumns collectColumns(const Source& source, const std::vector<std::uint32_t>& cells);

}  // namespace cloudgen::field
