// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::shape {

/// A puff seen from straight above: a Gaussian in the plane, by its middle and its covariances.
struct PlanGaussian {
  double x = 0, z = 0, xx = 0, xz = 0, zz = 0;

  double determinant() const { return xx * zz - xz * xz; }
};

/// Lengths are in units of so many metres.
PlanGaussian planOf(const Puff& puff, double unitMeters = 1);

/// Gaussians added up on a raster of as many columns as rows between two corners.
class PlanRaster {
 public:
  PlanRaster(const glm::dvec2& lower, const glm::dvec2& upper, int pixels);

  const glm::dvec2& pixel() const { return pixel_; }  ///< its sides
  const std::vector<float>& values() const { return values_; }

  /// Sets each pixel to what `valueOf` makes of its place in values().
  template <class ValueOf>
  void fill(ValueOf valueOf) {
    for (std::size_t pixel = 0; pixel < values_.size(); ++pixel) values_[pixel] = valueOf(pixel);
  }

  /// Adds what `valueOf` makes of the Gaussian (1 in its middle), as far as 3.5 deviations.
  template <class ValueOf>
  void add(const PlanGaussian& plan, ValueOf valueOf) {
    visit(plan, [&](float& value, double q) { value += static_cast<float>(valueOf(std::exp(-0.5 * q))); });
  }

  /// As add() of what is not negative, but pixels that have more than `enough` are left as they are.
  /// Returns how many came to have more.
  template <class ValueOf>
  std::size_t addUpTo(double enough, const PlanGaussian& plan, ValueOf valueOf) {
    std::size_t full = 0;
    visit(plan, [&](float& value, double q) {
      if (value > enough) return;
      value += static_cast<float>(valueOf(std::exp(-0.5 * q)));
      full += value > enough;
    });
    return full;
  }

  /// `does(value, q)` at each pixel within reach; the Gaussian is exp(-q / 2) there.
  template <class Does>
  void visit(const PlanGaussian& plan, Does does) {
    const Box box = boxOf(plan);
    for (int row = box.top; row <= box.bottom; ++row)
      for (int column = box.left; column <= box.right; ++column)
        does(values_[static_cast<std::size_t>(row * pixels_ + column)], distanceAt(plan, row, column));
  }

 private:
  struct Box {
    int left = 0, right = 0, top = 0, bottom = 0;
  };
  Box boxOf(const PlanGaussian& plan) const;

  /// Square of the distance in deviations.
  double distanceAt(const PlanGaussian& plan, int row, int column) const {
    const double dx = lower_.x + (column + 0.5) * pixel_.x - plan.x,
                 dz = lower_.y + (row + 0.5) * pixel_.y - plan.z;
    return (plan.zz * dx * dx - 2 * plan.xz * dx * dz + plan.xx * dz * dz) / plan.determinant();
  }

  glm::dvec2 lower_, pixel_;
  int pixels_;
  std::vector<float> values_;
};

}  // namespace cloudgen::shape
