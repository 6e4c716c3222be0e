// SPDX-License-Identifier: Apache-2.0
#include "pipeline/size.hpp"

#include <cmath>
#include <map>
#include <set>

#include "support/made_table.hpp"

namespace cloudgen::pipeline {
namespace {

test::MadeTable made(const field::StatedLayer& layer, std::uint64_t maxPuffs = 400'000) {
  test::MadeSource source(10, 46, 0.5, 6, 4);
  source.cover(layer);
  return {source, test::usualOptions(maxPuffs)};
}

TEST(Size, CloudsOfALayerShareItsBaseAndStayWithinIt) {
  for (const field::StatedLayer& layer : {test::cumulusLayer(), test::stratocumulusLayer()})
    for (const field::Cloud& cloud : made(layer).table.clouds) {
      ASSERT_NEAR(cloud.baseMeters, layer.baseMeters, 0.5);
      ASSERT_LE(cloud.baseMeters + cloud.depthMeters, layer.topMeters + 0.5f);
      ASSERT_GT(cloud.depthMeters, 0);
    }
}

TEST(Size, HeapsAreOfManySizesMostlySmall) {
  const test::MadeTable sky = made(test::cumulusLayer());
  const double mean =
      meanWidthMeters(sky.general, test::usualOptions().recipes.of(base::Genus::Cumulus), 1000, 0.3);
  std::set<float> widths;
  std::size_t small = 0;
  for (const field::Cloud& cloud : sky.table.clouds) {
    widths.insert(cloud.widthMeters);
    small += cloud.widthMeters < mean;
    EXPECT_GT(cloud.widthMeters, mean / 15);  // the smallest, drawn as narrow as one may be where only that fits
    EXPECT_LT(cloud.widthMeters, 3 * mean);
  }
  EXPECT_GT(widths.size(), sky.table.clouds.size() / 2);
  EXPECT_GT(small, sky.table.clouds.size() * 6 / 10);
}

TEST(Size, ElementsOfASheetAreAlike) {
  std::map<float, int> widths;
  const test::MadeTable sky = made(test::stratocumulusLayer());
  for (const field::Cloud& cloud : sky.table.clouds) ++widths[std::round(cloud.widthMeters)];
  int most = 0;
  for (const auto& [width, clouds] : widths) most = std::max(most, clouds);
  // But for those at the edges that make the cover right.
  EXPECT_GT(most, 0.8 * static_cast<double>(sky.table.clouds.size()));
}

}  // namespace
}  // namespace cloudgen::pipeline
