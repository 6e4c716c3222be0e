// SPDX-License-Identifier: Apache-2.0
// Layers of one column overlap as Hogan & Illingworth (2000) found.
#include "field/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cloudgen::field {
namespace {

using Layers = std::vector<CoverLayer>;

TEST(Overlap, DecorrelatesOverTheDistanceOfShonk) {
  EXPECT_NEAR(decorrelationMeters(0), 2899, 1e-9);
  EXPECT_NEAR(decorrelationMeters(90), 750, 1e-9);
  EXPECT_NEAR(decorrelationMeters(60), 750 + 2149 * 0.25, 1e-9);
  EXPECT_EQ(decorrelationMeters(-35), decorrelationMeters(35));
}

TEST(Overlap, OneLayerIsItself) {
  EXPECT_EQ(overlappedCover({}, 50), 0);
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}}, 50), 0.3, 1e-12);
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}, {0, 2000, 3000}}, 50), 0.3, 1e-12);
}

TEST(Overlap, LayersOfOneHeightOverlapAsMuchAsTheyCan) {
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}, {0.5, 1000, 2000}}, 50), 0.5, 1e-12);
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}, {0.5, 1200, 1800}}, 50), 0.5, 1e-12);
}

TEST(Overlap, LayersWithClearAirBetweenOverlapByChance) {
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}, {0.5, 2100, 2500}, {0.2, 8000, 9000}}, 10),
              1 - 0.7 * 0.5 * 0.8, 1e-12);
}

TEST(Overlap, TouchingLayersOverlapByTheDistanceOfTheirMiddles) {
  const double alpha = std::exp(-1000.0 / decorrelationMeters(50));
  EXPECT_NEAR(overlappedCover(Layers{{0.3, 1000, 2000}, {0.5, 2000, 3000}}, 50),
              alpha * 0.5 + (1 - alpha) * 0.65, 1e-12);
}

TEST(Overlap, FartherAndNearerThePoleMeansMoreCover) {
  double before = 0;
  for (const double depth : {100.0, 500.0, 1000.0, 3000.0, 10000.0}) {
    const double cover = overlappedCover(Layers{{0.4, 0, depth}, {0.4, depth, 2 * depth}}, 40);
    EXPECT_GT(cover, before);
    EXPECT_GE(cover, 0.4);
    EXPECT_LE(cover, 0.64);
    before = cover;
  }
  before = 0;
  for (const double latitude : {0.0, 30.0, 60.0, 90.0}) {
    const double cover = overlappedCover(Layers{{0.4, 0, 1000}, {0.4, 1000, 2000}}, latitude);
    EXPECT_GT(cover, before);
    before = cover;
  }
}

TEST(Overlap, MoreCoverOfOneOfTwoIsMoreOfBoth) {
  double before = 0;
  for (double cover = 0; cover <= 1; cover += 0.05) {
    const double both = overlappedCover(Layers{{cover, 0, 1000}, {0.4, 1000, 2000}}, 40);
    EXPECT_GE(both, before);
    before = both;
  }
  EXPECT_EQ(overlappedCover(Layers{{0.2, 0, 500}, {1, 500, 1000}, {0.4, 1000, 2000}}, 40), 1);
}

TEST(Overlap, ItDoesNotMatterFromWhichEndOneCounts) {
  Layers layers{{0.2, 0, 800}, {0.7, 800, 1500}, {0.4, 1500, 4000}, {0.6, 5000, 6000}, {0.1, 6000, 6200}};
  const double cover = overlappedCover(layers, 55);
  std::reverse(layers.begin(), layers.end());
  EXPECT_NEAR(overlappedCover(layers, 55), cover, 1e-12);
  for (CoverLayer& layer : layers) {
    const double base = layer.baseMeters;
    layer.baseMeters = 7000 - layer.topMeters;
    layer.topMeters = 7000 - base;
  }
  EXPECT_NEAR(overlappedCover(layers, 55), cover, 1e-12) << "upside down";
}

TEST(Overlap, LiesBetweenTheGreatestAndChance) {
  for (int i = 0; i < 200; ++i) {
    Layers layers;
    double greatest = 0, clear = 1, height = 500;
    for (int k = 0; k < 6; ++k) {
      const double cover = std::fmod(0.37 * i + 0.618 * k * (i + 1), 1.0), depth = 100 + 37 * ((i + k) % 11);
      layers.push_back({cover, height, height + depth});
      height += depth + (k % 3 == 2 ? 50 : 0);
      greatest = std::max(greatest, cover);
      clear *= 1 - cover;
    }
    const double cover = overlappedCover(layers, i % 90);
    EXPECT_GE(cover, greatest - 1e-12);
    EXPECT_LE(cover, 1 - clear + 1e-12);
  }
}

}  // namespace
}  // namespace cloudgen::field
