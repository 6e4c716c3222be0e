// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/thread.hpp"
#include "input/cdfs/counts.hpp"
#include "input/cdfs/placed_layer.hpp"

namespace cloudgen::input::cdfs {
namespace {

/// The lowest latitude of each band, and the top that a cumulonimbus passes there.
struct Band {
  double fromDegrees = 0;
  float topMeters = 0;
};
constexpr std::array kBands{Band{0, 12600}, Band{10, 12300}, Band{25, 12000}, Band{42.5, 11700},
                            Band{60, 11400}};

constexpr int kTotalSlack = 5;

bool isCumulonimbus(const CloudKind& kind) { return kind.genus == base::Genus::Cumulonimbus; }

/// The rules over some rows of one half.
class RuleBook {
 public:
  explicit RuleBook(Analysis& analysis) : analysis_(analysis) {
    for (std::size_t i = 0; i < kBands.size(); ++i)
      bandBorders_[i] = squaredRadiusAt(analysis.mesh, kBands[i].fromDegrees);
  }

  Counts row(std::size_t half, int row) const {
    Counts counts;
    const Mesh& mesh = analysis_.mesh;
    const auto columns = static_cast<std::size_t>(mesh.columns);
    const std::size_t first = half * mesh.size() + static_cast<std::size_t>(row) * columns;
    const bool joined = analysis_.halves.size() == 2;
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t cell = first + column;
      std::uint8_t* const amounts = analysis_.amount.data() + cell * kLayers;
      std::uint32_t all = 0;
      std::memcpy(&all, amounts, sizeof all);
      if (all == 0 && analysis_.totalCover.empty()) continue;
      const double fromPole = squaredRadius(mesh, static_cast<int>(column), row);
      if (joined && fromPole > bandBorders_[0]) {
        std::memset(amounts, 0, kLayers);
        continue;
      }
      checkAmounts(amounts, counts);
      compareTotal(cell, amounts, counts);
      for (std::size_t layer = 0; layer < kLayers; ++layer)
        if (amounts[layer] > 0) settle(cell, cell * kLayers + layer, fromPole, counts);
    }
    return counts;
  }

 private:
  static void checkAmounts(std::uint8_t* amounts, Counts& counts) {
    for (std::size_t layer = 0; layer < kLayers; ++layer) {
      if (amounts[layer] <= 100) continue;
      counts.amountTooLarge += amounts[layer] != 255;  // 255: missing
      amounts[layer] = 0;
    }
  }

  void compareTotal(std::size_t cell, const std::uint8_t* amounts, Counts& counts) const {
    if (analysis_.totalCover.empty() || analysis_.totalCover[cell] > 100) return;
    ++counts.totalCells;
    const int total = analysis_.totalCover[cell];
    const int largest = *std::max_element(amounts, amounts + kLayers);
    const int sum = std::min(100, amounts[0] + amounts[1] + amounts[2] + amounts[3]);
    const int off = std::max(largest - total, total - sum);
    if (off <= kTotalSlack) return;
    ++counts.totalOff;
    counts.totalOffBy += off;
  }

  void settle(std::size_t cell, std::size_t slot, double fromPole, Counts& counts) const {
    if (!analysis_.type.empty()) checkType(slot, counts);
    const auto layer = placedLayer(analysis_, slot);
    if (!layer) {
      ++counts.withoutHeight;
      analysis_.amount[slot] = 0;
      return;
    }
    if (!isFresh(cell, layer->baseMeters, counts)) {
      analysis_.amount[slot] = 0;
      return;
    }
    ++counts.told;
    counts.baseAssumed += layer->baseAssumed;
    counts.depthAssumed += layer->depthAssumed;
    if (isCumulonimbus(*layer->kind) && !(layer->topMeters > cumulonimbusTopAt(fromPole))) {
      analysis_.type[slot] = kTallCumulus;
      ++counts.cumulonimbusAsCumulus;
    }
  }

  /// Codes that the table does not have are said and become "not filled".
  void checkType(std::size_t slot, Counts& counts) const {
    std::uint8_t& code = analysis_.type[slot];
    const CloudKind& kind = kindOf(analysis_.table, code);
    if (!kind.inTable) {
      ++counts.strangeCodes[code];
      code = analysis_.table == TypeTable::Afwa ? kNotFilled : kWmoMissing;
    } else if (!kind.genus) {
      ++counts.withoutType;
    }
    counts.aboveFog += kind.aboveFog;
  }

  bool isFresh(std::size_t cell, float baseMeters, Counts& counts) const {
    if (analysis_.ageMinutes.empty()) return true;
    const std::int16_t age = analysis_.ageMinutes[cell];
    const bool low = baseMeters < kMiddleFromMeters;
    if (age == kNeverObserved)
      ++counts.neverObserved;
    else if (age > (low ? kLowMinutes : kUpperMinutes))
      ++(low ? counts.staleLow : counts.staleUpper);
    else if (age < kEarliestMinutes)
      ++counts.tooNew;
    else
      return true;
    return false;
  }

  float cumulonimbusTopAt(double fromPole) const {
    std::size_t band = 0;
    while (band + 1 < kBands.size() && fromPole <= bandBorders_[band + 1]) ++band;
    return kBands[band].topMeters;
  }

  Analysis& analysis_;
  std::array<double, kBands.size()> bandBorders_{};  ///< squared distances from the pole
};

}  // namespace

float leastCumulonimbusTop(double latitudeDegrees) {
  const auto reached = [&](const Band& band) { return std::abs(latitudeDegrees) >= band.fromDegrees; };
  return std::find_if(kBands.rbegin(), kBands.rend() - 1, reached)->topMeters;
}

void applyRules(Analysis& analysis) {
  const auto rows = static_cast<std::size_t>(analysis.mesh.rows);
  std::vector<Counts> perTask(64);
  const RuleBook book(analysis);
  const std::size_t all = rows * analysis.halves.size();
  base::parallelFor(perTask.size(), [&](std::size_t task) {
    const std::size_t end = all * (task + 1) / perTask.size();
    for (std::size_t row = all * task / perTask.size(); row < end; ++row)
      perTask[task] += book.row(row / rows, static_cast<int>(row % rows));
  });
  Counts counts;
  for (const Counts& part : perTask) counts += part;
  for (field::Warning& warning : warningsOf(counts, analysis.table))
    analysis.warnings.push_back(std::move(warning));
  if (counts.baseAssumed > 0 && !analysis.base.empty())
    analysis.fields.push_back(
        fmt::format("base: top minus a depth by type in {} of {} layers", counts.baseAssumed, counts.told));
  if (counts.depthAssumed > 0 && !analysis.opticalDepth.empty())
    analysis.fields.push_back(fmt::format("optical depth: typical of the type in {} of {} layers",
                                          counts.depthAssumed, counts.told));
}

}  // namespace cloudgen::input::cdfs
