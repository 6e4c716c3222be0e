// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "pipeline/archetype.hpp"

namespace cloudgen::pipeline {

/// Mean of heights and of their squares.
struct HeightMoments {
  float mean = 0, square = 0;
};

/// A cloud seen from straight above: its vertical optical depth on a square raster, as a share of what the
/// same extinction would give spread over the square of its width. Lengths are in widths, from its origin.
class Footprint {
 public:
  /// Of puffs as they are.
  Footprint(std::span<const shape::Puff> puffs, double widthMeters);
  /// Of the blobs that viewers blend for them: their flanks, which fill the gaps between clouds, are softer.
  static Footprint asDrawn(std::span<const shape::Puff> puffs, double widthMeters);

  /// Optical depth that is drawn for one that is there: what opacity leaves of dense puffs.
  double drawnShare() const { return drawnShare_; }
  /// Between pixels linear; 0 beyond the puffs' reach.
  float at(double x, double z) const {
    const double column = (x - lower_.x) * perWidth_.x - 0.5, row = (z - lower_.y) * perWidth_.y - 0.5;
    if (!(column >= 0 && row >= 0 && column < pixels_ - 1 && row < pixels_ - 1)) return 0;
    const auto left = static_cast<int>(column), top = static_cast<int>(row);
    const float* here = values_.data() + top * pixels_ + left;
    const auto a = static_cast<float>(column - left), b = static_cast<float>(row - top);
    return (1 - b) * ((1 - a) * here[0] + a * here[1]) +
           b * ((1 - a) * here[pixels_] + a * here[pixels_ + 1]);
  }
  /// Heights of what is there, of the nearest pixel.
  const HeightMoments& heightsAt(double x, double z) const {
    const auto indexOf = [&](double place) { return std::clamp(static_cast<int>(place), 0, pixels_ - 1); };
    return heights_[static_cast<std::size_t>(indexOf((z - lower_.y) * perWidth_.y) * pixels_ +
                                             indexOf((x - lower_.x) * perWidth_.x))];
  }
  /// How far it reaches from its origin.
  double reach() const { return reach_; }
  /// The box beyond which there is nothing of it.
  const glm::dvec2& lower() const { return lower_; }
  const glm::dvec2& upper() const { return upper_; }
  /// The ground, in squares of the width, that the cloud covers with more than `threshold` if it stands alone
  /// and its optical depth over that ground is `opticalDepth`.
  double coveredAlone(double opticalDepth, double threshold) const;

 private:
  Footprint(std::span<const shape::Puff> puffs, double widthMeters, bool blended);

  glm::dvec2 lower_{0}, upper_{0};
  double drawnShare_ = 1;
  glm::dvec2 perWidth_{1};  ///< pixels
  double reach_ = 0;
  int pixels_ = 1;  ///< along each side
  std::vector<float> values_;
  std::vector<HeightMoments> heights_;
  /// For each n: the greatest product of count and faintest value of the n or more brightest pixels.
  std::vector<float> waterOfBrightest_;
};

/// Footprints of a build, each measured when it is first asked for. Any thread may ask.
class FootprintBook {
 public:
  FootprintBook(const Options& options, const Generalisation& general)
      : options_(options), general_(general) {}
  const Footprint& of(const ArchetypeKey& key);

 private:
  template <class Made>
  struct Entry {
    std::once_flag once;
    std::unique_ptr<Made> made;
  };
  /// What stands under a key; made of it when it is first asked for.
  template <class Made, class Make>
  const Made& oneOf(std::map<ArchetypeKey, Entry<Made>>& entries, const ArchetypeKey& key, Make make);

  const Options& options_;
  const Generalisation& general_;
  std::mutex mutex_;
  std::map<ArchetypeKey, Entry<Footprint>> footprints_;
  std::map<ArchetypeKey, Entry<ArchetypeShape>> shapes_;  ///< in the class 0 of optical depth
};

}  // namespace cloudgen::pipeline
