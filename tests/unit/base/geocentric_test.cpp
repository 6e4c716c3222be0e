// SPDX-License-Identifier: Apache-2.0
#include "base/geocentric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace cloudgen::base {
namespace {

/// The closed form (Snyder 1987), with the constants of WGS84.
glm::dvec3 textbook(double longitudeDegrees, double latitudeDegrees, double height) {
  const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double longitude = glm::radians(longitudeDegrees), latitude = glm::radians(latitudeDegrees);
  const double n = a / std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  return {(n + height) * std::cos(latitude) * std::cos(longitude),
          (n + height) * std::cos(latitude) * std::sin(longitude),
          (n * (1 - e2) + height) * std::sin(latitude)};
}

TEST(Geocentric, IsTheTextbooksEverywhereAndLeadsBack) {
  const Geocentric globe;
  for (const double longitude : {-180.0, -122.4, -0.001, 0.0, 77.0, 179.9999})
    for (const double latitude : {-90.0, -89.999, -37.0, 0.0, 51.5, 89.9999, 90.0})
      for (const double height : {-50.0, 0.0, 12'000.0}) {
        const glm::dvec3 earth = globe.toEarth({longitude, latitude, height});
        EXPECT_LT(glm::distance(earth, textbook(longitude, latitude, height)), 1e-6);
        const glm::dvec3 back = globe.toGeographic(earth);
        EXPECT_LT(glm::distance(globe.toEarth(back), earth), 1e-5) << longitude << " " << latitude;
      }
}

TEST(Geocentric, EastNorthAndUpAreWhereTheyShouldBe) {
  const Geocentric globe;
  const double longitude = 131, latitude = -23, step = 1e-6;
  const glm::dvec3 here = globe.toEarth({longitude, latitude, 100});
  const glm::dmat4 plane = eastNorthUp(longitude, latitude, here);
  EXPECT_LT(glm::distance(glm::dvec3(plane[3]), here), 1e-9);
  EXPECT_NEAR(glm::determinant(glm::dmat3(plane)), 1, 1e-12);
  const auto towards = [&](const glm::dvec3& place) { return glm::normalize(globe.toEarth(place) - here); };
  EXPECT_GT(glm::dot(glm::dvec3(plane[0]), towards({longitude + step, latitude, 100})), 1 - 1e-9);
  EXPECT_GT(glm::dot(glm::dvec3(plane[1]), towards({longitude, latitude + step, 100})), 1 - 1e-9);
  EXPECT_GT(glm::dot(glm::dvec3(plane[2]), towards({longitude, latitude, 101})), 1 - 1e-12);
  const glm::dvec3 any(1, 2, 3);
  EXPECT_EQ(yUp(zUp(any)), any);
  EXPECT_EQ(zUp({1, 0, 0}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(zUp({0, 1, 0}), glm::dvec3(0, 0, 1));
}

}  // namespace
}  // namespace cloudgen::base
