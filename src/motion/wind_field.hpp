// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace cloudgen::motion {

/// The wind at a place (x and z of the scene, metres) and height above sea level, m/s along x and z.
struct WindSample {
  glm::dvec2 place{0};
  float heightMeters = 0;
  glm::vec2 wind{0};
};

/// The wind everywhere, from where it is known: means over a raster of squares and kilometres of height, what is
/// unknown filled from ever wider surroundings; linear between them. Calm without samples.
class WindField {
 public:
  WindField() = default;
  WindField(const glm::dvec2& lower, const glm::dvec2& upper, std::span<const WindSample> samples);
  glm::vec2 at(const glm::dvec2& place, double heightMeters) const;

 private:
  struct Known {
    glm::vec2 wind{0};
    float weight = 0;
  };
  static void fill(std::vector<Known>& level, int columns, int rows);
  glm::vec2 onLevel(int level, double column, double row) const;

  glm::dvec2 lower_{0}, perSquare_{1};  ///< squares a metre
  int columns_ = 0, rows_ = 0, levels_ = 0;
  std::vector<glm::vec2> winds_;
};

/// The wind between two times, linear in time.
struct WindBetween {
  const WindField& before;
  const WindField& after;
  double seconds = 0;  ///< from the one to the other
};

/// The places that the air of a place goes through, at evenly spaced times, the first at the place itself. Forwards
/// from the first time to the second, or backwards from the second to the first (then in that order). The fourth order
/// of Runge and Kutta, with steps of a quarter of an interval.
std::vector<glm::dvec2> pathOf(const WindBetween& wind, const glm::dvec2& place, double heightMeters, int intervals,
                               bool backwards);

}  // namespace cloudgen::motion
