// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "runtime/lighting.hpp"

namespace cloudgen::runtime::gles {

/// The clear sky by single scattering on air (Rayleigh) and aerosol (Mie) with an allowance for higher orders (Nishita et
/// al. 1993, "Display of the Earth taking into account atmospheric scattering"), display-linear and exposed as the clouds
/// are. Rows by the square root of the sine of the elevation, columns by the square root of the azimuth from the sun's
/// over pi: both 0 to 1.
struct SkyTable {
  static constexpr int kColumns = 33, kRows = 48;
  std::array<float, std::size_t{4} * kColumns * kRows> texels{};  ///< RGB and nothing
  Vec3 sunlight;                                                  ///< what a white face square to the sun shows

  /// `sunColor` is the sun's at the ground.
  void fill(const Lighting& lighting, const Vec3& sunColor, float sunElevationDegrees, float eyeHeightMeters) noexcept;
};

}  // namespace cloudgen::runtime::gles
