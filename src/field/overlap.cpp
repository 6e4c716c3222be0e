// SPDX-License-Identifier: Apache-2.0
#include "field/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cloudgen::field {
namespace {

/// Levels whose borders were rounded still touch.
constexpr double kNoGapMeters = 1;

double middleOf(const CoverLayer& layer) { return 0.5 * (layer.baseMeters + layer.topMeters); }

double coverOf(const CoverLayer& layer) { return std::clamp(layer.cover, 0.0, 1.0); }

}  // namespace

double decorrelationMeters(double latitudeDegrees) {
  const double cosine = std::cos(latitudeDegrees * std::numbers::pi / 180);
  return 750 + 2149 * cosine * cosine;
}

double overlapOf(const CoverLayer& one, const CoverLayer& other, double latitudeDegrees) {
  const bool touch =
      one.baseMeters <= other.topMeters + kNoGapMeters && other.baseMeters <= one.topMeters + kNoGapMeters;
  if (!touch) return 0;
  return std::exp(-std::abs(middleOf(one) - middleOf(other)) / decorrelationMeters(latitudeDegrees));
}

double overlappedCover(std::span<const CoverLayer> layers, double latitudeDegrees) {
  std::vector<CoverLayer> sorted;
  for (const CoverLayer& layer : layers)
    if (coverOf(layer) > 0) sorted.push_back(layer);
  if (sorted.empty()) return 0;
  std::stable_sort(sorted.begin(), sorted.end(), [](const CoverLayer& one, const CoverLayer& other) {
    return middleOf(one) > middleOf(other);
  });
  double clear = 1 - coverOf(sorted.front());
  for (std::size_t i = 1; i < sorted.size() && clear > 0; ++i) {
    const double above = coverOf(sorted[i - 1]), here = coverOf(sorted[i]);
    const double alpha = overlapOf(sorted[i - 1], sorted[i], latitudeDegrees);
    const double both = alpha * std::max(above, here) + (1 - alpha) * (above + here - above * here);
    clear *= (1 - both) / (1 - above);  // above < 1, or nothing would be clear
  }
  return 1 - std::max(0.0, clear);
}

}  // namespace cloudgen::field
