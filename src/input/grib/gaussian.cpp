// SPDX-License-Identifier: Apache-2.0
#include "input/grib/gaussian.hpp"

#include <cmath>
#include <numbers>

namespace cloudgen::input::grib {

std::vector<double> gaussianLatitudes(int n) {
  const int degree = 2 * n;
  std::vector<double> latitudes(static_cast<std::size_t>(degree));
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (degree + 0.5));
    for (int round = 0; round < 20; ++round) {
      double value = x, before = 1;  // Legendre polynomials of degree 1 and 0, by their recurrence
      for (int k = 2; k <= degree; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      const double change = value * (1 - x * x) / (degree * (before - x * value));
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    const double latitude = std::asin(x) * 180 / std::numbers::pi;
    latitudes[static_cast<std::size_t>(i)] = latitude;
    latitudes[static_cast<std::size_t>(degree - 1 - i)] = -latitude;
  }
  return latitudes;
}

}  // namespace cloudgen::input::grib
