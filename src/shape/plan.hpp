// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
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
    visit(plan, [&](float& value, double gaussian) { value += static_cast<float>(valueOf(gaussian)); });
  }

  /// As add() of what is not negative, but pixels that have more than `enough` are left as they are.
  /// Returns how many came to have more.
  template <class ValueOf>
  std::size_t addUpTo(double enough, const PlanGaussian& plan, ValueOf valueOf) {
    std::size_t full = 0;
    visit(plan, [&](float& value, double gaussian) {
      if (value > enough) return;
      value += static_cast<float>(valueOf(gaussian));
      full += value > enough;
    });
    return full;
  }

  /// `does(value, gaussian)` at each pixel within reach.
  template <class Does>
  void visit(const PlanGaussian& plan, Does does) {
    const Box box = boxOf(plan);
    const double ratioOfRatios = std::exp(-bendOf(plan));
    for (int row = box.top; row <= box.bottom; ++row) {
      const Row along = rowOf(plan, row, box, ratioOfRatios);
      float* const values = values_.data() + row * pixels_;
      Falling gaussian = along.rightwards;
      for (int column = along.brightest; column <= box.right && gaussian.isLeft(); ++column)
        does(values[column], gaussian.next());
      gaussian = along.leftwards;
      gaussian.next();
      for (int column = along.brightest - 1; column >= box.left && gaussian.isLeft(); --column)
        does(values[column], gaussian.next());
    }
  }

 private:
  struct Box {
    int left = 0, right = 0, top = 0, bottom = 0;
  };
  Box boxOf(const PlanGaussian& plan) const;

  /// A Gaussian from pixel to pixel, away from where it is brightest: its logarithm is a parabola, so that the
  /// ratio of neighbours has itself a constant ratio, and a step costs two products.
  struct Falling {
    double value, ratio, ratioOfRatios;

    double next() {
      const double here = value;
      value *= ratio, ratio *= ratioOfRatios;
      return here;
    }
    /// Whether a float could still tell.
    bool isLeft() const { return value > 1e-9; }
  };
  struct Row {
    int brightest;  ///< column
    Falling rightwards, leftwards;
  };
  Row rowOf(const PlanGaussian& plan, int row, const Box& box, double ratioOfRatios) const;
  /// Half the second difference of the square of the distance, from pixel to pixel of a row.
  double bendOf(const PlanGaussian& plan) const { return plan.zz * pixel_.x * pixel_.x / plan.determinant(); }


  glm::dvec2 lower_, pixel_;
  int pixels_;
  std::vector<float> values_;
};

}  // namespace cloudgen::shape
