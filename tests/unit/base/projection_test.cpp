// SPDX-License-Identifier: Apache-2.0
#include "base/projection.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "base/error.hpp"

namespace cloudgen::base {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Projection, LongitudeAndLatitudeStayWhatTheyAre) {
  const Projection plain("+proj=longlat +R=6371229");
  EXPECT_TRUE(plain.inDegrees());
  EXPECT_DOUBLE_EQ(plain.periodX(), 360);
  EXPECT_DOUBLE_EQ(plain.toGeographic({190, 40}).x, -170);
  EXPECT_DOUBLE_EQ(plain.toPlane({-170, 40}).y, 40);
}

/// The rotated pole of COSMO at 39.25 N 162 W: (0, 0) lies at 18 E 50.75 N, and degrees go in and out.
TEST(Projection, RotatedPoleIsInDegreesBothWays) {
  const Projection rotated("+proj=ob_tran +o_proj=longlat +o_lat_p=39.25 +o_lon_p=0 +lon_0=18 +R=6371229");
  EXPECT_TRUE(rotated.inDegrees());
  const glm::dvec2 origin = rotated.toGeographic({0, 0});
  EXPECT_NEAR(origin.x, 18, 1e-9);
  EXPECT_NEAR(origin.y, 50.75, 1e-9);
  const glm::dvec2 north = rotated.toGeographic({0, 10});
  EXPECT_NEAR(north.x, 18, 1e-9);
  EXPECT_NEAR(north.y, 60.75, 1e-9);
  // Ten degrees along the rotated equator, by the spherical triangle with the pole.
  const glm::dvec2 east = rotated.toGeographic({10, 0});
  EXPECT_NEAR(east.y, std::asin(std::cos(10 * kDegree) * std::sin(50.75 * kDegree)) / kDegree, 1e-9);
  EXPECT_NEAR(
      east.x,
      18 + std::atan2(std::sin(10 * kDegree), std::cos(10 * kDegree) * std::cos(50.75 * kDegree)) / kDegree,
      1e-9);
  const glm::dvec2 back = rotated.toPlane(east);
  EXPECT_NEAR(back.x, 10, 1e-9);
  EXPECT_NEAR(back.y, 0, 1e-9);
}

/// Polar stereographic on a sphere by its textbook formula (Snyder 1987, 21-33).
TEST(Projection, PolarStereographicKeepsTheSphere) {
  const double radius = 6371221.3;
  const Projection polar("+proj=stere +lat_0=90 +lat_ts=60 +lon_0=10 +R=6371221.3");
  const glm::dvec2 place = polar.toPlane({10, 45});
  const double distance = radius * (1 + std::sin(60 * kDegree)) * std::tan(0.5 * 45 * kDegree);
  EXPECT_NEAR(place.x, 0, 1e-6);
  EXPECT_NEAR(place.y, -distance, 1e-6);
  EXPECT_NEAR(polar.toGeographic({0, 0}).y, 90, 1e-12);
}

TEST(Projection, ThereAndBack) {
  for (const char* definition :
       {"+proj=lcc +lat_0=25 +lat_1=25 +lat_2=25 +lon_0=-95 +R=6371229", "+proj=merc +lat_ts=10 +R=6370000",
        "+proj=laea +lat_0=50 +lon_0=-60 +R=6371229",
        "+proj=stere +lat_0=90 +lat_ts=60 +ellps=WGS84 +units=km",
        "+proj=geos +h=35785831 +lon_0=-75 +sweep=x +ellps=GRS80", "+proj=merc +R=6370000 +type=crs",
        "+proj=ob_tran +o_proj=longlat +o_lat_p=30 +o_lon_p=0 +lon_0=-100 +R=6371229"}) {
    const glm::dvec2 back =
        Projection(definition).toGeographic(Projection(definition).toPlane({-80.5, 35.25}));
    EXPECT_NEAR(back.x, -80.5, 1e-7) << definition;
    EXPECT_NEAR(back.y, 35.25, 1e-7) << definition;
  }
}

TEST(Projection, CylindricalMapsRepeatAroundTheEarth) {
  const Projection mercator("+proj=merc +lon_0=150 +R=6370000");
  EXPECT_NEAR(mercator.periodX(), 2 * std::numbers::pi * 6370000, 1);
  EXPECT_DOUBLE_EQ(Projection("+proj=laea +lat_0=90 +R=6370000").periodX(), 0);
}

TEST(Projection, WhatHasNoImageIsNotANumber) {
  const Projection disc("+proj=geos +h=35785831 +lon_0=0 +ellps=GRS80");
  EXPECT_TRUE(std::isnan(disc.toPlane({180, 0}).x));
  EXPECT_TRUE(std::isnan(disc.toGeographic({6e6, 6e6}).x));
  EXPECT_NEAR(disc.toGeographic({0, 0}).x, 0, 1e-9) << "and harms nothing after it";
}

TEST(Projection, AbsurdDefinitionsAreNamed) {
  for (const char* definition :
       {"", "nonsense", "+proj=nosuch +R=1", "+proj=lcc +lat_1=30 +lat_2=-30 +R=6371229", "+proj=merc +R=-5",
        "+proj=pipeline +step +proj=merc", "EPSG:4326", "+init=epsg:4326"}) {
    try {
      const Projection refused(definition);
      ADD_FAILURE() << definition;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(definition));
    }
  }
}

TEST(Projection, EachThreadHasItsOwn) {
  const std::string definition = "+proj=merc +R=6370000";
  const Projection* here = Projection::of(definition).get();
  EXPECT_EQ(Projection::of(definition).get(), here);
  const Projection* there = here;
  std::shared_ptr<const Projection> kept;
  std::thread([&] {
    kept = Projection::of(definition);
    there = kept.get();
  }).join();
  EXPECT_NE(there, here);
}

}  // namespace
}  // namespace cloudgen::base
