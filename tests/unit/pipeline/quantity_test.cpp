// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity.hpp"

#include <cmath>
#include <map>

#include "shape/generate.hpp"
#include "support/made_table.hpp"

namespace cloudgen::pipeline {
namespace {

using Placed = std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>>;

test::MadeSource sky(const field::StatedLayer& layer) {
  test::MadeSource source(10, 46, 0.5, 6, 4);
  source.cover(layer);
  return source;
}

/// Place of each cloud by cell and ordinal; the layers of these tests are one a cell.
Placed placesOf(const field::CloudTable& table) {
  Placed places;
  for (const field::Cloud& cloud : table.clouds)
    places[{table.layers[cloud.layer].cell, cloud.ordinal}] = {cloud.longitudeDegrees, cloud.latitudeDegrees};
  return places;
}

TEST(Quantity, CloudsStandInTheirCells) {
  const test::MadeSource source = sky(test::cumulusLayer());
  const test::MadeTable made(source, test::usualOptions(100'000));
  for (const field::Cloud& cloud : made.table.clouds) {
    const std::uint32_t cell = made.table.layers[cloud.layer].cell;
    EXPECT_NEAR(cloud.longitudeDegrees, 10.25 + 0.5 * source.grid().column(cell), 0.2501);
    EXPECT_NEAR(cloud.latitudeDegrees, 46.25 + 0.5 * source.grid().row(cell), 0.2501);
  }
}

TEST(Quantity, TheSeedDecides) {
  const test::MadeSource source = sky(test::cumulusLayer());
  Options options = test::usualOptions(50'000);
  const Placed one = placesOf(test::MadeTable(source, options).table);
  EXPECT_EQ(placesOf(test::MadeTable(source, options).table), one);
  options.seed = 2;
  EXPECT_NE(placesOf(test::MadeTable(source, options).table), one);
}

TEST(Quantity, TheOrderOfTheLayersDoesNotMatter) {
  const test::MadeSource source = sky(test::cumulusLayer());
  std::vector<field::Layer> backwards = test::MadeTable::layersOf(source);
  std::reverse(backwards.begin(), backwards.end());
  Options options = test::usualOptions(50'000);
  for (options.seed = 1; options.seed < 4; ++options.seed)
    EXPECT_EQ(placesOf(test::MadeTable(source, options, backwards).table),
              placesOf(test::MadeTable(source, options).table));
}

TEST(Quantity, ClearCellsHaveNoClouds) {
  const test::MadeTable made(sky(test::cumulusLayer(0)), test::usualOptions());
  EXPECT_TRUE(made.table.clouds.empty());
}

// A sky of 20 km whose clouds are counted.
test::MadeSource countedSky(field::StatedLayer layer, int count, float spacingMeters) {
  test::MadeSource source(0, 0, 0.18, 1, 1);
  layer.cloudCount = count;
  layer.spacingMeters = spacingMeters;
  source.cover(layer);
  return source;
}

/// Optical depth times area of all clouds, and of all layers.
double water(const field::CloudTable& table) {
  double sum = 0;
  for (const field::Cloud& cloud : table.clouds)
    sum += cloud.opticalDepth * shape::footprintSquareMeters(cloud.widthMeters);
  return sum;
}
double water(const test::MadeSource& source) {
  double sum = 0;
  for (const field::StatedLayer& layer : source.layers)
    sum += layer.coverFraction * layer.opticalDepth * field::cellAreaSquareMeters(source.grid(), layer.cell);
  return sum;
}

/// Distances to the nearest other cloud, metres.
std::vector<double> nearestDistances(const field::CloudTable& table) {
  std::vector<double> distances;
  for (const field::Cloud& a : table.clouds) {
    double nearest = 1e9;
    for (const field::Cloud& b : table.clouds)
      if (&a != &b)
        nearest = std::min(nearest, 111195 * std::hypot(a.longitudeDegrees - b.longitudeDegrees,
                                                        a.latitudeDegrees - b.latitudeDegrees));
    distances.push_back(nearest);
  }
  return distances;
}

TEST(Quantity, CountedCloudsAreExactlyThatMany) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const field::StatedLayer& layer : {test::cumulusLayer(0.1f), test::cumulusLayer(1),
                                            test::stratocumulusLayer(0.4f), test::stratocumulusLayer(1)})
      for (const int count : {1, 2, 10, 75, 200}) {
        const test::MadeSource source = countedSky(layer, count, 0);
        Options options = test::usualOptions(100);  // however small the budget
        options.seed = seed;
        const test::MadeTable made(source, options);
        EXPECT_EQ(made.table.clouds.size(), static_cast<std::size_t>(count));
        EXPECT_NEAR(water(made.table) / water(source), 1, 1e-4);
      }
}

TEST(Quantity, CountedCloudsKeepTheirSpacing) {
  const test::MadeTable made(countedSky(test::cumulusLayer(0.3f), 30, 2700), test::usualOptions());
  EXPECT_EQ(made.table.clouds.size(), 30u);
  for (const double distance : nearestDistances(made.table)) EXPECT_GT(distance, 2700 * 0.99);
}

TEST(Quantity, WhereCountedCloudsFindNoRoomThereAreFewerOfTheSameWater) {
  const test::MadeSource source = countedSky(test::cumulusLayer(0.3f), 30, 8000);
  const test::MadeTable made(source, test::usualOptions());
  EXPECT_GT(made.table.clouds.size(), 3u);
  EXPECT_LT(made.table.clouds.size(), 12u);
  EXPECT_NEAR(water(made.table) / water(source), 1, 1e-4);
}

// By Clark & Evans 1954: the mean distance to the nearest, over that of places by chance (half the root of
// the area of each), is above 1 for clouds that keep apart and below 1 for clusters.
TEST(Quantity, CountedCloudsWithoutSpacingStandInClusters) {
  const auto ratio = [](float spacing, int count) {
    double sum = 0;
    std::size_t clouds = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Options options = test::usualOptions();
      options.seed = seed;
      for (const double distance : nearestDistances(
               test::MadeTable(countedSky(test::cumulusLayer(0.3f), count, spacing), options).table)) {
        sum += distance;
        ++clouds;
      }
    }
    return sum / static_cast<double>(clouds) / (0.5 * 20015 / std::sqrt(count));
  };
  EXPECT_GT(ratio(2700, 30), 1.3);
  EXPECT_LT(ratio(0, 200), 0.9);
}

TEST(Quantity, CountedCloudsOfASmallerBoxStandAtTheSamePlaces) {
  const test::MadeSource source = countedSky(test::cumulusLayer(0.3f), 30, 2700);
  Options options = test::usualOptions();
  Placed expected = placesOf(test::MadeTable(source, options).table);
  options.box = base::GeoBox{0.02, 0.02, 0.1, 0.12};
  std::erase_if(expected,
                [&](auto& entry) { return !options.box->contains(entry.second.first, entry.second.second); });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(placesOf(test::MadeTable(source, options).table), expected);
}

}  // namespace
}  // namespace cloudgen::pipeline
