// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity.hpp"

#include <cmath>
#include <map>

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

TEST(Quantity, FootprintsAddUpToTheCover) {
  for (const field::StatedLayer& layer :
       {test::cumulusLayer(), test::stratocumulusLayer(), test::stratocumulusLayer(1)}) {
    const test::MadeSource source = sky(layer);
    const test::MadeTable made(source, test::usualOptions(100'000));
    std::map<std::uint32_t, double> covered, largest;
    for (const field::Cloud& cloud : made.table.clouds) {
      covered[cloud.layer] += cloud.coversSquareMeters;
      largest[cloud.layer] = std::max(largest[cloud.layer], cloud.coversSquareMeters);
    }
    for (std::uint32_t i = 0; i < made.table.layers.size(); ++i) {
      const double expected =
          layer.coverFraction * field::cellAreaSquareMeters(source.grid(), made.table.layers[i].cell);
      EXPECT_NEAR(covered[i], expected, 1.01 * largest[i]);
    }
  }
}

// Cells smaller than what one cloud covers have one only now and then; over many cells the cover is right.
TEST(Quantity, CellsSmallerThanACloudAddUpToo) {
  for (const field::StatedLayer& layer :
       {test::cumulusLayer(0.2f), test::stratocumulusLayer(0.3f), test::stratocumulusLayer(1)}) {
    test::MadeSource source(10, 46, 0.01, 60, 60);
    source.cover(layer);
    const test::MadeTable made(source, test::usualOptions(100'000'000));
    double covered = 0, expected = 0;
    for (const field::Cloud& cloud : made.table.clouds) covered += cloud.coversSquareMeters;
    for (const field::Layer& each : made.table.layers)
      expected += each.fraction * field::cellAreaSquareMeters(source.grid(), each.cell);
    EXPECT_NEAR(covered / expected, 1, 0.08) << base::name(*layer.genus) << ' ' << layer.coverFraction;
  }
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

TEST(Quantity, ASmallerBoxHasTheSameCloudsAtTheSamePlaces) {
  for (const field::StatedLayer& layer : {test::cumulusLayer(), test::stratocumulusLayer()}) {
    const test::MadeSource source = sky(layer);
    Options options = test::usualOptions(100'000);
    const test::MadeTable whole(source, options);
    options.box = base::GeoBox{10.7, 46.2, 11.6, 47.1};
    const test::MadeTable part(source, options, whole.general);
    Placed expected = placesOf(whole.table);
    std::erase_if(expected, [&](auto& entry) {
      return !options.box->contains(entry.second.first, entry.second.second);
    });
    EXPECT_FALSE(expected.empty());
    EXPECT_LT(expected.size(), whole.table.clouds.size());
    EXPECT_EQ(placesOf(part.table), expected);
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
  const Options options = test::usualOptions(50'000);
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
        double covered = 0;
        for (const field::Cloud& cloud : made.table.clouds) covered += cloud.coversSquareMeters;
        EXPECT_NEAR(covered / (layer.coverFraction * field::cellAreaSquareMeters(source.grid(), 0)), 1, 1e-6);
      }
}

TEST(Quantity, CountedCloudsKeepTheirSpacing) {
  const test::MadeTable made(countedSky(test::cumulusLayer(0.3f), 30, 2700), test::usualOptions());
  EXPECT_EQ(made.table.clouds.size(), 30u);
  for (const double distance : nearestDistances(made.table)) EXPECT_GT(distance, 2700 * 0.99);
}

TEST(Quantity, WhereCountedCloudsFindNoRoomThereAreFewerOfTheSameCover) {
  const test::MadeSource source = countedSky(test::cumulusLayer(0.3f), 30, 8000);
  const test::MadeTable made(source, test::usualOptions());
  EXPECT_GT(made.table.clouds.size(), 3u);
  EXPECT_LT(made.table.clouds.size(), 12u);
  double covered = 0;
  for (const field::Cloud& cloud : made.table.clouds) covered += cloud.coversSquareMeters;
  EXPECT_NEAR(covered / (0.3 * field::cellAreaSquareMeters(source.grid(), 0)), 1, 1e-6);
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
