// SPDX-License-Identifier: Apache-2.0
#include "field/settle.hpp"

#include <algorithm>
#include <cmath>

#include "field/cloud_water.hpp"
#include "field/collect.hpp"

namespace cloudgen::field {
namespace {

void setExtinction(PendingCell& pending) {
  CloudCell& cell = pending.cell;
  const double perFraction = pending.airDensity / cell.fraction;
  cell.liquidExtinctionPerMeter = static_cast<float>(liquidExtinction(pending.liquid * perFraction));
  cell.iceExtinctionPerMeter =
      static_cast<float>(iceExtinction(pending.ice * perFraction, cell.temperatureK));
}

/// Sorts the cells by column; within a column they stay in their order, upwards.
void place(const std::vector<PendingCell>& cells, CloudColumns& columns) {
  columns.start.assign(columns.columns.size() + 1, 0);
  for (const PendingCell& pending : cells) ++columns.start[pending.column + 1];
  for (std::size_t c = 0; c < columns.columns.size(); ++c) columns.start[c + 1] += columns.start[c];
  std::vector<std::uint32_t> next(columns.start.begin(), columns.start.end() - 1);
  columns.cells.resize(cells.size());
  for (const PendingCell& pending : cells) columns.cells[next[pending.column]++] = pending.cell;
}

}  // namespace

void settleGivenWater(std::vector<PendingCell> cells, bool humidityKnown, CloudColumns& columns,
                      Derivations& derivations) {
  const auto any = [&](const auto& test) { return std::any_of(cells.begin(), cells.end(), test); };
  const bool given = any([](const PendingCell& pending) { return pending.givenFraction > 0; });
  const bool zeroes = any([](const PendingCell& pending) { return pending.givenFraction <= 0; });
  bool derived = false;
  std::erase_if(cells, [&](PendingCell& pending) {
    const bool here = given && std::isfinite(pending.givenFraction);
    const float fraction = here ? pending.givenFraction : pending.derivedFraction;
    if (fraction < kLeastFraction) return true;
    derived |= !here;
    pending.cell.fraction =
        std::min(1.0f, std::max(fraction, (pending.liquid + pending.ice) / kMostInCloudWater));
    setExtinction(pending);
    return false;
  });
  if (!given && zeroes) derivations.note(Derivation::FractionNotAllZero);
  if (derived)
    derivations.note(humidityKnown ? Derivation::FractionFromHumidityAndWater : Derivation::FractionFull);
  place(cells, columns);
}

void settleDiagnosedWater(std::vector<PendingCell> cells, const std::vector<float>& precipitableWater,
                          CloudColumns& columns, Derivations& derivations) {
  constexpr float kGlobalMean = 24;  // kg/m2, Trenberth et al. 2005
  for (PendingCell& pending : cells) {
    CloudCell& cell = pending.cell;
    const bool given = std::isfinite(pending.givenFraction);
    cell.fraction = std::min(1.0f, given ? pending.givenFraction : pending.derivedFraction);
    derivations.note(Derivation::WaterFromHumidity);
    if (!given) derivations.note(Derivation::FractionFromHumidity);
    const float known = precipitableWater[pending.column];
    const float above =
        0.5f * (cell.baseMeters + cell.topMeters) - columns.states[pending.column].surfaceHeightMeters;
    const double content = cell.fraction * diagnosedCloudWater(above, known > 0 ? known : kGlobalMean);
    const double water = content / pending.airDensity;
    pending.liquid = static_cast<float>(water * liquidShare(cell.temperatureK));
    pending.ice = static_cast<float>(water) - pending.liquid;
    setExtinction(pending);
  }
  place(cells, columns);
}

}  // namespace cloudgen::field
