// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/source.hpp"
#include "input/metar/report.hpp"
#include "input/point/air.hpp"

namespace cloudgen::input {

/// Each group's own cover. Reports tell what a layer and all below hide; the part of a higher layer that
/// is seen between the lower ones is taken for the whole of it: (n - m) / (1 - m), n and m the covers
/// reported up to it and below it. A group of the same class as the one below adds an okta, within its class;
/// one of a lower class than what is below states its own amount. Above a full cover nothing is known: 0.
std::vector<double> ownCovers(const std::vector<CloudGroup>& groups);

/// The layers of a report, upwards (heights above mean sea level). `day`: the sun is up.
///
/// Genus: CB Cb (over 3 oktas the rest of it is Sc), TCU Cu congestus; thunder or showers without one make
/// the lowest layer under 2 km such; a remark of types decides the rest; vertical visibility, and layers
/// under 60 m with fog, are fog (with steady precipitation and no fog: Ns); under 2 km BKN and OVC are Ns
/// with steady precipitation, St under 450 m or with drizzle, else Sc; FEW and SCT are St under 300 m in
/// moist air (dew-point spread under 2 K), Cu by day in drier air, else Sc; middle etage: OVC is Ns with
/// steady precipitation under 3 km, else As, less is Ac; high: BKN and OVC are Cs, less is Ci.
///
/// Depth: fog 150 m, or twice the vertical visibility within 60 and 400 m; St 300, Sc 450, Cu 700 (FEW), 1100
/// (SCT), 1400 (more), congestus to -12 C within 3 and 5 km, Ns 2.5, 3.5 and 4.5 km by the intensity, Ac 400
/// m, As 1500 m, Ci and Cs 1 km, Cb stormTopMeters; a sheet ends at the base of the next layer. A missing
/// height is that of condensation, else 1000 m. Fog's extinction is 3.912 over the visibility (Koschmieder).
std::vector<field::StatedLayer> layersOf(const MetarReport& report, const Air& air, bool day);

}  // namespace cloudgen::input
