// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/frame.hpp"
#include "field/source.hpp"

namespace cloudgen::check {

/// Three ranges of height: low, middle, high.
inline constexpr int kRanges = 3;
/// Bases from here on are middle and high clouds, metres above mean sea level.
inline constexpr std::array<double, 2> kRangeBorders{2000, 6000};
/// A ray of less optical depth meets no cloud; layers of less are none.
inline constexpr double kCloudyOpticalDepth = 0.1;
/// Base and top are where this share of the optical depth of the lowest (highest) clouds lies below (above).
inline constexpr double kBorderShare = 0.05;

/// What one observer says of a column. Cover is a share of its area, optical depth the mean over it.
struct ColumnView {
  double cover = 0;
  std::array<double, kRanges> coverIn{};
  double opticalDepth = 0;
  std::optional<double> baseMeters, topMeters;  ///< of all cloud in it; nothing where it is clear
};

/// What the model says of a column.
struct ModelColumn {
  std::uint32_t cell = 0;                            ///< grid index
  double longitudeDegrees = 0, latitudeDegrees = 0;  ///< of its centre
  double squareMeters = 0;                           ///< of what lies in the box
  double shareInside = 1;
  ColumnView view;
  /// The heights that part low, middle and high clouds here: in clear air between the model's own layers
  /// where there is some.
  std::array<double, 2> borders = kRangeBorders;
  int lowestRange = 0, highestRange = 0;  ///< that have cloud
  double levelMeters = 0;  ///< mean thickness of the model's cells at base and top; 0 for stated layers
};

/// The columns of a source that touch the box, by grid index, and what they say. Layers are runs of cloudy
/// levels, parted where the water falls under a tenth of what is below and above; within one the levels
/// overlap as much as they can (its cover is the greatest fraction), layers as field::overlappedCover says. A
/// layer is low, middle or high by its base. Layers thinner than kCloudyOpticalDepth count for optical depth
/// alone. Throws InputError as the source does.
std::vector<ModelColumn> modelColumns(const field::Source& source, const base::GeoBox& box);

}  // namespace cloudgen::check
