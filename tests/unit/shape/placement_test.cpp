// SPDX-License-Identifier: Apache-2.0
#include "shape/placement.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace cloudgen::shape {
namespace {

constexpr CoordinateSystem kSystems[] = {CoordinateSystem::Cubic, CoordinateSystem::Cylindrical,
                                         CoordinateSystem::Conical, CoordinateSystem::Spherical,
                                         CoordinateSystem::HalfSpherical};
constexpr PlacementVariant kVariants[] = {PlacementVariant::Literal, PlacementVariant::Uniform,
                                          PlacementVariant::Incremental};
constexpr double kTau = 2 * std::numbers::pi;

base::RandomStream stream() { return {7, 3, base::Purpose::Test}; }

Placement placement(CoordinateSystem system, PlacementVariant variant) {
  return {system, variant, 30, 80, 0.5};
}

std::vector<glm::dvec3> placed(CoordinateSystem system, PlacementVariant variant, int count) {
  base::RandomStream random = stream();
  return place(placement(system, variant), count, random);
}

bool inside(const Placement& p, const glm::dvec3& at) {
  const double hair = 1e-9, fromAxis = std::hypot(at.x, at.z);
  const bool standing = at.y >= 0 && at.y < p.height;
  switch (p.system) {
    case CoordinateSystem::Cubic:
      return std::min({at.x, at.y, at.z}) >= 0 && std::max({at.x, at.y, at.z}) < p.radius;
    case CoordinateSystem::Cylindrical:
      return standing && fromAxis <= (p.height - at.y) * std::tan(p.angleRadians) + hair;
    case CoordinateSystem::Conical:
      return standing && fromAxis <= p.radius + hair;
    case CoordinateSystem::Spherical:
      return glm::length(at) <= p.radius + hair;
    case CoordinateSystem::HalfSpherical:
      return glm::length(at) <= p.radius + hair && at.y >= -hair;
  }
  return false;
}

template <class Value>
double meanOf(const std::vector<glm::dvec3>& points, Value&& value) {
  double sum = 0;
  for (const glm::dvec3& point : points) sum += value(point);
  return sum / static_cast<double>(points.size());
}

double fromAxis(const glm::dvec3& p) { return std::hypot(p.x, p.z); }
double fromOrigin(const glm::dvec3& p) { return glm::length(p); }
double height(const glm::dvec3& p) { return p.y; }

TEST(Placement, EveryPointLiesInItsRegion) {
  for (const CoordinateSystem system : kSystems)
    for (const PlacementVariant variant : kVariants) {
      const auto points = placed(system, variant, 2000);
      ASSERT_EQ(points.size(), 2000u);
      for (const glm::dvec3& point : points)
        ASSERT_TRUE(inside(placement(system, variant), point))
            << static_cast<int>(system) << ' ' << static_cast<int>(variant);
    }
}

TEST(Placement, NothingIsPlacedForNothing) {
  for (const CoordinateSystem system : kSystems)
    for (const PlacementVariant variant : kVariants) EXPECT_TRUE(placed(system, variant, 0).empty());
}

TEST(Placement, TheSameStreamPlacesTheSamePoints) {
  for (const CoordinateSystem system : kSystems)
    EXPECT_EQ(placed(system, PlacementVariant::Uniform, 50), placed(system, PlacementVariant::Uniform, 50));
}

// The printed formulas of Murphy 2008, ch. III.B.4, worked out here from the same random numbers.
TEST(Placement, LiteralFormulasAreThoseOfTheThesis) {
  base::RandomStream u = stream();
  for (const glm::dvec3& point : placed(CoordinateSystem::Cubic, PlacementVariant::Literal, 20)) {
    const double x = 30 * u.uniform(), y = 30 * u.uniform(), z = 30 * u.uniform();
    EXPECT_LT(glm::distance(point, glm::dvec3(x, y, z)), 1e-9);
  }
  u = stream();
  for (const glm::dvec3& point : placed(CoordinateSystem::Cylindrical, PlacementVariant::Literal, 20)) {
    const double phi = 0.5 * u.uniform(), theta = kTau * u.uniform(), y = 80 * u.uniform(),
                 r = (80 - y) * std::tan(phi);
    EXPECT_LT(glm::distance(point, glm::dvec3(r * std::cos(theta), y, r * std::sin(theta))), 1e-9);
  }
  u = stream();
  for (const glm::dvec3& point : placed(CoordinateSystem::Conical, PlacementVariant::Literal, 20)) {
    const double theta = kTau * u.uniform(), r = 30 * u.uniform(), y = 80 * u.uniform();
    EXPECT_LT(glm::distance(point, glm::dvec3(r * std::cos(theta), y, r * std::sin(theta))), 1e-9);
  }
  for (const CoordinateSystem system : {CoordinateSystem::Spherical, CoordinateSystem::HalfSpherical}) {
    u = stream();
    const double widest = system == CoordinateSystem::Spherical ? kTau / 2 : kTau / 4;
    for (const glm::dvec3& point : placed(system, PlacementVariant::Literal, 20)) {
      const double theta = kTau * u.uniform(), phi = widest * u.uniform(), r = 30 * u.uniform();
      const glm::dvec3 byHand(r * std::cos(theta) * std::sin(phi), r * std::cos(phi),
                              r * std::sin(theta) * std::sin(phi));
      EXPECT_LT(glm::distance(point, byHand), 1e-9);
    }
  }
}

TEST(Placement, UniformFillsTheVolumeEvenly) {
  const int count = 20000;
  const auto cube = placed(CoordinateSystem::Cubic, PlacementVariant::Uniform, count);
  EXPECT_NEAR(meanOf(cube, height), 15, 0.3);
  EXPECT_NEAR(meanOf(cube, [](auto& p) { return p.x * p.x; }), 300, 6);
  const auto ball = placed(CoordinateSystem::Spherical, PlacementVariant::Uniform, count);
  EXPECT_NEAR(meanOf(ball, fromOrigin), 0.75 * 30, 0.2);
  EXPECT_NEAR(meanOf(ball, height), 0, 0.4);
  EXPECT_NEAR(meanOf(ball, [](auto& p) { return p.y * p.y; }), 900 / 5.0, 5);
  EXPECT_NEAR(meanOf(ball, [](auto& p) { return p.x * p.x; }), 900 / 5.0, 5);
  const auto dome = placed(CoordinateSystem::HalfSpherical, PlacementVariant::Uniform, count);
  EXPECT_NEAR(meanOf(dome, fromOrigin), 0.75 * 30, 0.2);
  EXPECT_NEAR(meanOf(dome, height), 0.375 * 30, 0.25);
  const auto column = placed(CoordinateSystem::Conical, PlacementVariant::Uniform, count);
  EXPECT_NEAR(meanOf(column, fromAxis), 2.0 / 3 * 30, 0.2);
  EXPECT_NEAR(meanOf(column, height), 40, 0.7);
}

// Of a cone's volume, 7/8 lie in the lower half of its height, and the mean height is a quarter.
TEST(Placement, UniformConeIsFullBelow) {
  const auto cone = placed(CoordinateSystem::Cylindrical, PlacementVariant::Uniform, 20000);
  EXPECT_NEAR(meanOf(cone, height), 20, 0.4);
  EXPECT_NEAR(meanOf(cone, [](auto& p) { return p.y < 40 ? 1.0 : 0.0; }), 0.875, 0.01);
  const auto share = [](const glm::dvec3& p) { return fromAxis(p) / ((80 - p.y) * std::tan(0.5)); };
  EXPECT_NEAR(meanOf(cone, share), 2.0 / 3, 0.01);
}

TEST(Placement, LiteralCrowdsTheAxis) {
  for (const CoordinateSystem system : {CoordinateSystem::Cylindrical, CoordinateSystem::Conical,
                                        CoordinateSystem::Spherical, CoordinateSystem::HalfSpherical})
    EXPECT_LT(meanOf(placed(system, PlacementVariant::Literal, 5000), fromAxis),
              0.85 * meanOf(placed(system, PlacementVariant::Uniform, 5000), fromAxis));
}

TEST(Placement, IncrementalStepsByTheMaximumOverTheCount) {
  const int count = 40;
  const auto steps = [&](CoordinateSystem system, double largest, auto&& value) {
    const auto points = placed(system, PlacementVariant::Incremental, count);
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(value(points[static_cast<std::size_t>(i)]), largest * i / count, 1e-9);
  };
  steps(CoordinateSystem::Cubic, 30, height);
  steps(CoordinateSystem::Cylindrical, 80, height);
  steps(CoordinateSystem::Conical, 30, fromAxis);
  steps(CoordinateSystem::Spherical, 30, fromOrigin);
  steps(CoordinateSystem::HalfSpherical, 30, fromOrigin);
}

TEST(Placement, NamesOfRecipesAreKnown) {
  EXPECT_EQ(coordinateSystemFromName("half_spherical"), CoordinateSystem::HalfSpherical);
  EXPECT_EQ(coordinateSystemFromName("conical"), CoordinateSystem::Conical);
  EXPECT_FALSE(coordinateSystemFromName("toroidal"));
  EXPECT_EQ(placementVariantFromName("incremental"), PlacementVariant::Incremental);
  EXPECT_FALSE(placementVariantFromName(""));
}

}  // namespace
}  // namespace cloudgen::shape
