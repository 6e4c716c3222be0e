// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/height_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::check {
namespace {

constexpr double kLowest = -500, kStep = 25;
constexpr int kBins = 900;

/// Eight points of equal weight that stand for a normal distribution: the middles of its octiles, stretched
/// so that their variance is 1.
constexpr std::array<double, 8> kNormalPoints{-1.6628, -0.9618, -0.5299, -0.1706,
                                              0.1706,  0.5299,  0.9618,  1.6628};

double positionOf(double height) {
  return std::clamp((height - kLowest) / kStep, 0.0, static_cast<double>(kBins) - 1e-9);
}

}  // namespace

HeightProfile::HeightProfile() : bins_(kBins, 0.0) {}

void HeightProfile::add(double height, double opticalDepth) {
  bins_[static_cast<std::size_t>(positionOf(height))] += opticalDepth;
}

void HeightProfile::addUniform(double baseMeters, double topMeters, double opticalDepth) {
  const double low = positionOf(baseMeters), high = positionOf(topMeters);
  if (!(high > low)) return add(baseMeters, opticalDepth);
  for (double from = low; from < high;) {
    const double to = std::min(high, std::floor(from) + 1);
    bins_[static_cast<std::size_t>(from)] += opticalDepth * (to - from) / (high - low);
    from = to;
  }
}

void HeightProfile::addGaussian(double meanMeters, double deviationMeters, double opticalDepth) {
  if (deviationMeters < 0.5 * kStep) return add(meanMeters, opticalDepth);
  for (const double point : kNormalPoints)
    add(meanMeters + point * deviationMeters, opticalDepth / kNormalPoints.size());
}

double HeightProfile::between(double lowestMeters, double highestMeters) const {
  const double low = positionOf(lowestMeters), high = positionOf(highestMeters);
  double sum = 0;
  for (double from = low; from < high;) {
    const double to = std::min(high, std::floor(from) + 1);
    sum += bins_[static_cast<std::size_t>(from)] * (to - from);
    from = to;
  }
  return sum;
}

std::optional<double> HeightProfile::heightAt(double share, double lowestMeters, double highestMeters) const {
  const double low = positionOf(lowestMeters), high = positionOf(highestMeters);
  const double wanted = share * between(lowestMeters, highestMeters);
  if (!(wanted > 0)) return std::nullopt;
  double sum = 0;
  for (double from = low; from < high;) {
    const double to = std::min(high, std::floor(from) + 1);
    const double here = bins_[static_cast<std::size_t>(from)] * (to - from);
    if (here > 0 && sum + here >= wanted)
      return kLowest + kStep * (from + (to - from) * (wanted - sum) / here);
    sum += here;
    from = to;
  }
  return highestMeters;
}

}  // namespace cloudgen::check
