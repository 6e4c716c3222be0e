// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/imager.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/fidelity/height_profile.hpp"

namespace cloudgen::check {
namespace {

/// Bins along a side at most: their table stays small beside the blobs.
constexpr int kMostBins = 1024;

/// What a ray gathers: of the optical depth that viewers draw, all and what lies below the two borders of the
/// ranges.
struct Ray {
  double drawn = 0;
  std::array<double, 2> drawnBelow{};
};

/// The last float before 1: what is opaque would otherwise have no logarithm.
constexpr float kMostOpaque = 1 - 0x1p-24f;

double normalShareBelow(double deviations) { return 0.5 * std::erfc(-deviations / std::numbers::sqrt2); }

/// Share of what a footprint draws that lies below a height: a normal distribution, of a card no more than
/// its sprite shows.
double shareBelow(double height, double mean, const Footprint& footprint) {
  const double most = footprint.card ? kCardReach : 3.0;
  const double distance = height - mean;
  if (std::abs(distance) >= most * footprint.heightDeviation) return distance > 0 ? 1 : 0;
  const double cut = normalShareBelow(-most);
  return (normalShareBelow(distance / footprint.heightDeviation) - cut) / (1 - 2 * cut);
}

}  // namespace

Imager::Imager(std::span<const Footprint> footprints) : footprints_(footprints) {
  if (footprints.empty()) {
    start_.assign(2, 0);
    return;
  }
  glm::dvec2 lower(1e30), upper(-1e30);
  double sides = 0;
  for (const Footprint& footprint : footprints) {
    const glm::dvec2 place(footprint.place), half(footprint.halfSides());
    lower = glm::dvec2(std::min(lower.x, place.x), std::min(lower.y, place.y));
    upper = glm::dvec2(std::max(upper.x, place.x), std::max(upper.y, place.y));
    sides += std::min(1e6, half.x + half.y);
  }
  const double extent = std::max({upper.x - lower.x, upper.y - lower.y, 1.0});
  binMeters_ = std::max(extent / kMostBins, sides / static_cast<double>(footprints.size()));
  lower_ = lower;
  columns_ = std::min(kMostBins, static_cast<int>((upper.x - lower.x) / binMeters_) + 1);
  rows_ = std::min(kMostBins, static_cast<int>((upper.y - lower.y) / binMeters_) + 1);
  start_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  const auto eachBin = [&](const auto& take) {
    for (std::uint32_t i = 0; i < footprints_.size(); ++i) {
      const BinRange range = binsOf(footprints_[i]);
      for (int row = range.top; row <= range.bottom; ++row)
        for (int column = range.left; column <= range.right; ++column)
          take(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column),
               i);
    }
  };
  eachBin([&](std::size_t bin, std::uint32_t) { ++start_[bin + 1]; });
  for (std::size_t bin = 1; bin < start_.size(); ++bin) start_[bin] += start_[bin - 1];
  members_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  eachBin([&](std::size_t bin, std::uint32_t i) { members_[next[bin]++] = i; });
}

Imager::BinRange Imager::binsOf(const Footprint& footprint) const {
  const glm::dvec2 place(footprint.place), half(footprint.halfSides());
  const auto bin = [&](double meters, int count) {
    return static_cast<int>(std::clamp(std::floor(meters / binMeters_), 0.0, static_cast<double>(count - 1)));
  };
  return {bin(place.x - half.x - lower_.x, columns_), bin(place.x + half.x - lower_.x, columns_),
          bin(place.y - half.y - lower_.y, rows_), bin(place.y + half.y - lower_.y, rows_)};
}

ColumnView Imager::look(std::span<const glm::dvec2> rays, const ModelColumn& column) const {
  constexpr double kGround = -500, kSpace = 22000;
  ColumnView seen;
  if (rays.empty()) return seen;
  HeightProfile profile;
  for (const glm::dvec2& place : rays) {
    Ray ray;
    // Places beyond the outermost bins belong to those, as the footprints that reach out there do.
    const auto binAlong = [&](double meters, int count) {
      return static_cast<std::size_t>(
          std::clamp(std::floor(meters / binMeters_), 0.0, static_cast<double>(count - 1)));
    };
    const std::size_t bin = binAlong(place.y - lower_.y, rows_) * static_cast<std::size_t>(columns_) +
                            binAlong(place.x - lower_.x, columns_);
    for (std::uint32_t m = start_[bin]; m < start_[bin + 1]; ++m) {
      const Footprint& blob = footprints_[members_[m]];
      const glm::vec2 off = glm::vec2(place - glm::dvec2(blob.place));
      const float opacityShare = blob.opacityShareAt(off);
      if (!(opacityShare > 0)) continue;
      const double depth = blob.opticalDepthOf(opacityShare);
      const double height = blob.height + static_cast<double>(blob.heightSlope.x) * off.x +
                            static_cast<double>(blob.heightSlope.y) * off.y;
      const double drawn = -std::log1p(-std::min(kMostOpaque, blob.opacity * opacityShare));
      seen.opticalDepth += depth;
      ray.drawn += drawn;
      for (std::size_t border = 0; border < 2; ++border)
        ray.drawnBelow[border] += drawn * shareBelow(column.borders[border], height, blob);
      profile.addGaussian(height, blob.heightDeviation, depth);
    }
    if (ray.drawn > kCloudyOpticalDepth) seen.cover += 1;
    const std::array<double, kRanges> parts{ray.drawnBelow[0], ray.drawnBelow[1] - ray.drawnBelow[0],
                                            ray.drawn - ray.drawnBelow[1]};
    for (std::size_t range = 0; range < kRanges; ++range)
      if (parts[range] > kCloudyOpticalDepth) seen.coverIn[range] += 1;
  }
  const auto count = static_cast<double>(rays.size());
  seen.opticalDepth /= count;
  seen.cover /= count;
  for (double& cover : seen.coverIn) cover /= count;
  if (!(seen.cover > 0)) return seen;
  const std::array<double, 4> edges{kGround, column.borders[0], column.borders[1], kSpace};
  const auto lowest = static_cast<std::size_t>(column.lowestRange),
             highest = static_cast<std::size_t>(column.highestRange);
  seen.baseMeters = profile.heightAt(kBorderShare, edges[lowest], edges[lowest + 1]);
  seen.topMeters = profile.heightAt(1 - kBorderShare, edges[highest], edges[highest + 1]);
  return seen;
}

}  // namespace cloudgen::check
