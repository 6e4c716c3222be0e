// SPDX-License-Identifier: Apache-2.0
#include "pipeline/structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cloudgen::pipeline {
namespace {

constexpr double kDegreeMeters = 111195;

/// Mean square of differences over a distance along the equator and along the Greenwich meridian.
double structureFunction(const Structure& structure, double meters, bool east) {
  double sum = 0;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    const double lon = 0.731 * i, lat = 30 * std::sin(0.37 * i);
    const double away = meters / kDegreeMeters;
    const double here = structure.along({lon, lat}, {10, 0}, 8),
                 there = structure.along({lon + (east ? away / std::cos(lat * 0.017453292519943295) : 0),
                                          lat + (east ? 0 : away)},
                                         {10, 0}, 8);
    sum += (here - there) * (here - there) / count;
  }
  return sum;
}

TEST(Structure, IsAStandardNormalDeviate) {
  const Structure structure(200'000, 2'000, 7);
  double sum = 0, square = 0;
  const int count = 20'000;
  std::vector<double> ranks;
  for (int i = 0; i < count; ++i) {
    const double value = structure.at({0.618 * i, 80 * std::sin(0.11 * i)});
    sum += value / count, square += value * value / count;
    ranks.push_back(rankOf(value));
  }
  EXPECT_NEAR(sum, 0, 0.05);
  EXPECT_NEAR(std::sqrt(square), 1, 0.1);
  std::sort(ranks.begin(), ranks.end());
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
    EXPECT_NEAR(ranks[static_cast<std::size_t>(share * count)], share, 0.05);
}

// Power to the -5/3 is a structure function that grows with the distance to the 2/3 (Kolmogorov 1941).
TEST(Structure, HasASpectrumOfMinusFiveThirds) {
  const Structure structure(400'000, 1'000, 3);
  const auto at = [&](double meters) {
    double sum = 0;
    const int count = 20'000;
    for (int i = 0; i < count; ++i) {
      const field::GeoPoint here{0.731 * i, 40 * std::sin(0.37 * i)};
      const double difference =
          structure.at(here) -
          structure.at({here.longitudeDegrees, here.latitudeDegrees + meters / kDegreeMeters});
      sum += difference * difference / count;
    }
    return sum;
  };
  const double slope = std::log(at(40'000) / at(5'000)) / std::log(8.0);
  EXPECT_NEAR(slope, 2.0 / 3.0, 0.12);
}

TEST(Structure, StreetsLieAlongTheWind) {
  const Structure structure(50'000, 2'000, 5);
  EXPECT_GT(structureFunction(structure, 6'000, false), 1.7 * structureFunction(structure, 6'000, true));
}

}  // namespace
}  // namespace cloudgen::pipeline
