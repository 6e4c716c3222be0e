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

/// From humidity alone no cloud is derived where the pressure is lower: models' humidity means little there.
inline constexpr float kLeastHumidCloudPa = 10000;

/// Reads a source level by level (three levels in memory at a time, and those that wait where a quantity is
/// missing on some: GapFiller) and keeps the cloudy cells of the columns `cells` (grid indices, ascending).
/// Heights, pressures and temperatures are taken or made as AirMaker says. A cell reaches half-way (in
/// height) to the levels below and above; the lowest and the highest one reach as far outwards as inwards; a
/// lone level reaches 50 hPa to either side (300 m above 100 hPa). None reaches below the surface, and levels
/// below the surface are dropped where the source knows the orography or the surface pressure.
///
/// Fraction: the source's; Xu & Randall where it has none, or where it is zero in every cloudy cell; 1 where
/// humidity is missing too. Sources without condensate on any level: fraction by Sundqvist from humidity (or
/// given), water diagnosed (Hack 1998), both cut to the source's own cloud base and top where it tells them.
/// What was made is told in CloudColumns::derived. Throws InputError when the source has neither condensate
/// nor humidity nor fraction.
CloudColumns collectColumns(const Source& source, const std::vector<std::uint32_t>& cells);

}  // namespace cloudgen::field
