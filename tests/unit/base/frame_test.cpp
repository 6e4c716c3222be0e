// SPDX-License-Identifier: Apache-2.0
#include "base/frame.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace cloudgen::base {
namespace {

const GeoBox kBoxes[] = {{-122.6, 36.2, -121.2, 37.2},
                         {-100, 25, -60, 50},
                         {170, -25, -170, -5},
                         {-20, 70, 40, 89},
                         {5, -2, 9, 2}};

/// Area of a cell between meridians and parallels on the WGS84 ellipsoid (authalic formula; Snyder 1987, eq.
/// 3-12).
double ellipsoidalArea(double west, double south, double east, double north) {
  constexpr double a = 6378137, f = 1 / 298.257223563, degree = std::numbers::pi / 180;
  const double b = a * (1 - f), e = std::sqrt(f * (2 - f));
  const auto q = [&](double latitude) {
    const double s = std::sin(latitude * degree);
    return s / (1 - e * e * s * s) + std::log((1 + e * s) / (1 - e * s)) / (2 * e);
  };
  return 0.5 * b * b * (east - west) * degree * (q(north) - q(south));
}

/// Area of the same cell in the scene, by the shoelace formula along its finely divided border.
double sceneArea(const LocalFrame& frame, double west, double south, double east, double north) {
  std::vector<glm::dvec3> border;
  constexpr int kSteps = 200;
  const auto side = [&](double lon0, double lat0, double lon1, double lat1) {
    for (int i = 0; i < kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps;
      border.push_back(frame.toScene(lon0 + t * (lon1 - lon0), lat0 + t * (lat1 - lat0), 0));
    }
  };
  side(west, south, east, south), side(east, south, east, north), side(east, north, west, north),
      side(west, north, west, south);
  double twice = 0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const glm::dvec3 &p = border[i], &q = border[(i + 1) % border.size()];
    twice += p.x * q.z - q.x * p.z;
  }
  return std::abs(twice) / 2;
}

TEST(LocalFrame, ThereAndBackIsTheSamePlaceWithinTwoMillimetres) {
  // PROJ's series for the authalic latitude leaves up to 1.6 mm, at 25 degrees.
  constexpr double kTolerance = 2e-3;
  for (const GeoBox& box : kBoxes) {
    const LocalFrame frame(box);
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j) {
        const double longitude = box.west + box.width() * i / 8, latitude = box.south + box.height() * j / 8;
        const glm::dvec3 scene = frame.toScene(longitude, latitude, 1234.5);
        const glm::dvec3 back = frame.toGeographic(scene);
        EXPECT_LT(glm::length(frame.toScene(back.x, back.y, back.z) - scene), kTolerance);
        const double metersPerDegree = 111320;
        EXPECT_LT(std::abs(std::remainder(back.x - longitude, 360.0)) * metersPerDegree *
                      std::cos(latitude * std::numbers::pi / 180),
                  kTolerance);
        EXPECT_LT(std::abs(back.y - latitude) * metersPerDegree, kTolerance);
        EXPECT_DOUBLE_EQ(back.z, 1234.5);
      }
  }
}

TEST(LocalFrame, BoxesAboutTheGlobeHaveNoPlaceOutsideOfTheMap) {
  for (const GeoBox& box : {GeoBox{-180, -90, 180, 90}, GeoBox{-180, 55, 180, 90}, GeoBox{-90, -30, 90, 60},
                            GeoBox{20, -88, -20, -60}}) {
    const LocalFrame frame(box);
    EXPECT_TRUE(std::isfinite(frame.lowerCorner().x + frame.lowerCorner().y + frame.upperCorner().x +
                              frame.upperCorner().y));
    for (int i = 0; i <= 16; ++i)
      for (int j = 0; j <= 16; ++j) {
        const double longitude = box.west + box.width() * (i + 0.5) / 17.1;
        const double latitude = std::clamp(box.south + box.height() * j / 16, -89.5, 89.5);
        const glm::dvec3 back = frame.toGeographic(frame.toScene(longitude, latitude, 0));
        // Near the poles of a cylindrical map a micrometre on it is decimetres on the ground.
        EXPECT_LT(std::abs(back.y - latitude) * 111320, 0.5) << frame.definition();
        EXPECT_LT(std::abs(std::remainder(back.x - longitude, 360.0)) * 111320 *
                      std::cos(latitude * std::numbers::pi / 180),
                  0.5);
      }
    const double west = box.west + 0.3 * box.width(), south = box.south + 0.4 * box.height();
    EXPECT_NEAR(sceneArea(frame, west, south, west + 2, south + 2) /
                    ellipsoidalArea(west, south, west + 2, south + 2),
                1, 1e-3);
  }
}

TEST(LocalFrame, CellsKeepTheirArea) {
  for (const GeoBox& box : kBoxes) {
    const LocalFrame frame(box);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double west = box.west + box.width() * i / 4, south = box.south + box.height() * j / 4;
        const double east = west + box.width() / 4, north = south + box.height() / 4;
        const double wanted = ellipsoidalArea(west, south, east, north);
        EXPECT_NEAR(sceneArea(frame, west, south, east, north) / wanted, 1, 1e-3);
      }
  }
}

TEST(LocalFrame, StandsAtTheSouthWestCornerAndLooksEastAndUp) {
  const LocalFrame frame({-122.6, 36.2, -121.2, 37.2});
  EXPECT_LT(glm::length(frame.toScene(-122.6, 36.2, 0)), 1e-6);
  const glm::dvec3 northEast = frame.toScene(-121.2, 37.2, 500);
  EXPECT_GT(northEast.x, 100e3);
  EXPECT_LT(northEast.z, -100e3);
  EXPECT_DOUBLE_EQ(northEast.y, 500);
  const glm::dvec2 east = frame.eastDirection(-121.9, 36.7);
  EXPECT_NEAR(east.x, 1, 1e-6);
  EXPECT_NEAR(east.y, 0, 1e-6);
}

TEST(LocalFrame, IsOneRoomAcrossTheAntimeridian) {
  const LocalFrame frame({170, -25, -170, -5});
  EXPECT_NEAR(glm::length(frame.toScene(179.9999, -15, 0) - frame.toScene(-179.9999, -15, 0)), 21.5, 1);
  EXPECT_LT(frame.upperCorner().x - frame.lowerCorner().x, 2300e3);
}

TEST(GeoBox, KnowsWhatIsInside) {
  const GeoBox pacific{170, -25, -170, -5};
  EXPECT_TRUE(pacific.crossesAntimeridian());
  EXPECT_DOUBLE_EQ(pacific.width(), 20);
  EXPECT_TRUE(pacific.contains(180, -10));
  EXPECT_TRUE(pacific.contains(-175 + 720, -10));
  EXPECT_FALSE(pacific.contains(0, -10));
  EXPECT_DOUBLE_EQ(pacific.centerLongitude(), -180);
  EXPECT_DOUBLE_EQ((GeoBox{-180, -90, 180, 90}.width()), 360);
}

TEST(GeoBox, IsReadFromText) {
  const GeoBox box = boxFromText("260, 25,300,50");
  EXPECT_DOUBLE_EQ(box.west, -100);
  EXPECT_DOUBLE_EQ(box.east, -60);
  for (const char* wrong :
       {"", "1,2,3", "1,2,3,x", "0,10,5,10", "0,-91,5,0", "0,0,0,1", "nan,0,1,1", "1000,0,1,1"})
    EXPECT_THROW(boxFromText(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace cloudgen::base
