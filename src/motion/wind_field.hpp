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
  glm::dvec2 lower() const { return lower_; }
  /// Of the raster.
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double squareMeters() const { return 1 / perSquare_.x; }

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

/// The wind between two times: its pattern goes from the one to the other by a way (see wayOfPattern), and meanwhile
/// each of its winds turns into that of the later time, linear in time.
struct WindBetween {
  const WindField& before;
  const WindField& after;
  double seconds = 0;  ///< from the one to the other
  glm::dvec2 way{0};
  glm::dvec2 at(const glm::dvec2& place, double heightMeters, double share) const;
};

/// How far the pattern of the wind has moved from one time to a later one, as an eye does: the shift of the one that
/// comes nearest to the other where they overlap, up to a quarter of the box. None unless the misfit is at most
/// kMovedMisfit of that in one place: where winds are alike all over there is no pattern to be seen.
inline constexpr double kMovedMisfit = 0.75;
glm::dvec2 wayOfPattern(const WindField& before, const WindField& after);

/// From a share of the time between to a later one.
struct Stretch {
  double from = 0, to = 1;
};

/// The places that the air of a place goes through, at evenly spaced times, the first at the place itself. Forwards
/// from the first time of a stretch to the second, or backwards from the second to the first (then in that order). The
/// fourth order of Runge and Kutta, with steps of a quarter of an interval.
std::vector<glm::dvec2> pathOf(const WindBetween& wind, const glm::dvec2& place, double heightMeters, int intervals,
                               bool backwards, const Stretch& stretch = {});

}  // namespace cloudgen::motion
