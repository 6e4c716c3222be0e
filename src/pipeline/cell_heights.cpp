// SPDX-License-Identifier: Apache-2.0
#include "pipeline/cell_heights.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::pipeline {
namespace {

constexpr float kGroundMeters = -500, kSpaceMeters = 20000;
constexpr std::size_t kMostBins = 82, kLeastBins = 8, kMostValues = 40'000'000;
/// A range that has less than this share of the optical depth that it should have is taken as clear.
constexpr double kClearShare = 1e-3;
constexpr double kLinearFromMeters = 1000;
/// Less than field::kBorderShare: what is close to moving a base or a top counts, too.
constexpr double kShare = 0.035;

double harmOf(double errorMeters) {
  const double error = std::abs(errorMeters);
  return error < kLinearFromMeters ? error * error : kLinearFromMeters * (2 * error - kLinearFromMeters);
}

/// Where a share of the optical depth between two bins lies below; below 0 where there is less than `least`.
float heightAt(const float* profile, std::size_t first, std::size_t end, double share, double least) {
  double whole = 0;
  for (std::size_t bin = first; bin < end; ++bin) whole += std::max(profile[bin], 0.0f);
  if (!(whole > least)) return -1;
  double below = 0;
  for (std::size_t bin = first; bin < end; ++bin) {
    const double here = std::max(profile[bin], 0.0f);
    if (here > 0 && below + here >= share * whole)
      return static_cast<float>(static_cast<double>(bin) + (share * whole - below) / here);
    below += here;
  }
  return static_cast<float>(end);
}

/// Between the clouds of a range and those of the next, half-way; above or below all of one alone, in some
/// distance.
float borderAbove(std::size_t range, std::span<const PaintedLayer> own,
                  std::span<const field::Layer> layers) {
  constexpr float kDistanceMeters = 500;
  const auto usual = static_cast<float>(kRangeBordersMeters[range]);
  float top = kGroundMeters, base = kSpaceMeters;
  for (const PaintedLayer& painted : own) {
    const field::Layer& layer = layers[painted.layer];
    if (!painted.covers) continue;
    if (rangeOf(layer.baseMeters) <= range)
      top = std::max(top, layer.topMeters);
    else
      base = std::min(base, layer.baseMeters);
  }
  if (top > kGroundMeters && base < kSpaceMeters) return 0.5f * (top + base);
  if (top > kGroundMeters) return std::max(usual, top + kDistanceMeters);
  return std::min(usual, base - kDistanceMeters);
}

}  // namespace

CellHeights::CellHeights(const Canvas& canvas, std::span<const field::Layer> layers) {
  const std::size_t cells = std::max<std::size_t>(canvas.cells().size(), 1);
  bins_ = std::clamp(kMostValues / cells, kLeastBins, kMostBins);
  binMeters_ = (kSpaceMeters - kGroundMeters) / static_cast<float>(bins_);
  changed_.resize(bins_);
  for (const PaintedCell& cell : canvas.cells())
    describe({canvas.layers().data() + cell.firstLayer, cell.layerCount}, layers, wanted_.emplace_back());
  profiles_.assign(canvas.cells().size() * bins_, 0);
}

void CellHeights::describe(std::span<const PaintedLayer> own, std::span<const field::Layer> layers,
                           Wanted& wanted) {
  std::size_t lowest = kRanges, highest = 0;
  std::array<double, kRanges> whole{};
  std::fill(changed_.begin(), changed_.end(), 0.0f);
  for (const PaintedLayer& painted : own) {
    if (!painted.covers) continue;
    const field::Layer& layer = layers[painted.layer];
    const std::size_t range = rangeOf(layer.baseMeters);
    lowest = std::min(lowest, range), highest = std::max(highest, range);
    whole[range] += painted.wantedOpticalDepth;
    // Half of it below its middle and half above, of each half a tenth beyond the border.
    constexpr float kBeyond = field::kBorderShare / (0.5f - field::kBorderShare);
    spread(changed_.data(), layer.lowerMeters - kBeyond * (layer.middleMeters - layer.lowerMeters),
           layer.middleMeters, 0.5 * painted.wantedOpticalDepth);
    spread(changed_.data(), layer.middleMeters,
           layer.upperMeters + kBeyond * (layer.upperMeters - layer.middleMeters),
           0.5 * painted.wantedOpticalDepth);
  }
  if (lowest == kRanges) return;
  const auto border = [&](std::size_t above) {
    return static_cast<std::size_t>(std::lround(binOf(borderAbove(above, own, layers))));
  };
  const std::array<std::size_t, kRanges + 1> edges{0, border(0), std::max(border(0), border(1)), bins_};
  wanted.lowest = {edges[lowest], edges[lowest + 1]};
  wanted.highest = {edges[highest], edges[highest + 1]};
  wanted.least = kClearShare * std::min(whole[lowest], whole[highest]);
  wanted.base = heightAt(changed_.data(), wanted.lowest.first, wanted.lowest.end, kShare, 0);
  wanted.top =
      heightAt(changed_.data(), wanted.highest.first, wanted.highest.end, 1 - kShare, 0);
  // A layer so thin that the border next to it was rounded beyond it.
  if (wanted.base < 0 || wanted.top < 0) wanted = {};
}

double CellHeights::changeBy(std::uint32_t cell, float baseMeters, float topMeters,
                             double opticalDepth) const {
  const Wanted& wanted = wanted_[cell];
  if (wanted.highest.end == 0) return 0;
  const float* profile = profiles_.data() + cell * bins_;
  std::copy(profile, profile + bins_, changed_.begin());
  spread(changed_.data(), baseMeters, topMeters, opticalDepth);
  return errorOf(wanted, changed_.data()) - errorOf(wanted, profile);
}

void CellHeights::add(std::uint32_t cell, float baseMeters, float topMeters, double opticalDepth) {
  spread(profiles_.data() + cell * bins_, baseMeters, topMeters, opticalDepth);
}

void CellHeights::clear() { std::fill(profiles_.begin(), profiles_.end(), 0.0f); }

double CellHeights::errorOf(const Wanted& wanted, const float* profile) const {
  const float base =
      heightAt(profile, wanted.lowest.first, wanted.lowest.end, kShare, wanted.least);
  const float top =
      heightAt(profile, wanted.highest.first, wanted.highest.end, 1 - kShare, wanted.least);
  return (base < 0 ? 0 : harmOf(binMeters_ * (base - wanted.base))) +
         (top < 0 ? 0 : harmOf(binMeters_ * (top - wanted.top)));
}

float CellHeights::binOf(float meters) const {
  return std::clamp((meters - kGroundMeters) / binMeters_, 0.0f, static_cast<float>(bins_));
}

void CellHeights::spread(float* profile, float baseMeters, float topMeters, double opticalDepth) const {
  const float last = static_cast<float>(bins_) - 1e-3f;
  const float from = std::min(binOf(baseMeters), last), to = std::max(binOf(topMeters), from + 1e-3f);
  const auto perBin = static_cast<float>(opticalDepth / (to - from));
  for (float at = from; at < to;) {
    const float next = std::min(to, std::floor(at) + 1);
    profile[static_cast<std::size_t>(at)] += perBin * (next - at);
    at = next;
  }
}

}  // namespace cloudgen::pipeline
