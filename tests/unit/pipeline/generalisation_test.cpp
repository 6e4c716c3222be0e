// SPDX-License-Identifier: Apache-2.0
#include "pipeline/generalisation.hpp"

#include <cmath>

#include "shape/generate.hpp"
#include "support/made_table.hpp"

namespace cloudgen::pipeline {
namespace {

test::MadeSource heaps() {
  test::MadeSource source(10, 46, 0.25, 8, 8);
  source.cover(test::cumulusLayer());
  return source;
}

double drawn(const test::MadeTable& made) {
  double puffs = 0;
  for (const field::Cloud& cloud : made.table.clouds)
    puffs += made.general.puffsPerCloud[static_cast<std::size_t>(made.table.layers[cloud.layer].genus)];
  return puffs;
}

TEST(Generalisation, DrawsAboutTheBudget) {
  for (const std::uint64_t budget : {20'000u, 200'000u, 1'000'000u}) {
    const test::MadeTable made(heaps(), test::usualOptions(budget));
    EXPECT_NEAR(drawn(made) / static_cast<double>(budget), 1, 0.5) << budget;
  }
}

TEST(Generalisation, DrawsAboutTheBudgetOfSheets) {
  test::MadeSource source(10, 46, 0.25, 8, 8);
  source.cover(test::stratocumulusLayer());
  for (const std::uint64_t budget : {100'000u, 200'000u})
    EXPECT_NEAR(drawn({source, test::usualOptions(budget)}) / static_cast<double>(budget), 1, 0.3) << budget;
}

// Many cells and a small budget: fewer and larger clouds, wider than the cells.
TEST(Generalisation, DrawsAboutTheBudgetOverManyCells) {
  for (const field::StatedLayer& layer : {test::cumulusLayer(), test::stratocumulusLayer()}) {
    test::MadeSource source(0, 40, 0.1, 80, 80);
    source.cover(layer);
    const test::MadeTable made(source, test::usualOptions(20'000));
    EXPECT_LT(drawn(made), 30'000);
    EXPECT_GT(drawn(made), 10'000);
  }
}

// A sheet of cells that are smaller than its elements covers all the same.
TEST(Generalisation, SheetsOfSmallCellsDoNotVanish) {
  test::MadeSource source(10, 46, 0.05, 1, 3);
  source.cover(test::stratocumulusLayer(1));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Options options = test::usualOptions(20'000);
    options.seed = seed;
    EXPECT_FALSE(test::MadeTable(source, options).table.clouds.empty());
  }
}

TEST(Generalisation, ABudgetThatCannotBeMetEnlargesNoFurtherThanItHelps) {
  const test::MadeTable made(heaps(), test::usualOptions(1));
  const double natural = naturalWidthMeters(test::usualOptions().recipes.of(base::Genus::Cumulus), 1000);
  EXPECT_LT(made.general.enlargement, 1.1 * made.general.widestMeters / natural);
  EXPECT_FALSE(made.table.clouds.empty());
}

TEST(Generalisation, ASmallSkyIsDrawnAsItIs) {
  test::MadeSource source(10, 46, 0.05, 2, 2);
  source.cover(test::cumulusLayer());
  const test::MadeTable made(source, test::usualOptions(500'000));
  EXPECT_EQ(made.general.enlargement, 1);
  EXPECT_GT(made.general.puffsPerCloud[static_cast<std::size_t>(base::Genus::Cumulus)],
            fewestPuffs(test::usualOptions().recipes.of(base::Genus::Cumulus)));
}

TEST(Generalisation, ALargerBudgetNeverEnlargesMore) {
  double last = 1e9;
  for (const std::uint64_t budget : {5'000u, 20'000u, 100'000u, 1'000'000u, 50'000'000u}) {
    const double enlargement = test::MadeTable(heaps(), test::usualOptions(budget)).general.enlargement;
    EXPECT_LE(enlargement, last);
    EXPECT_GE(enlargement, 1);
    last = enlargement;
  }
  EXPECT_EQ(last, 1);
}

TEST(Generalisation, ASmallerBoxIsDrawnNearerToNature) {
  Options part = test::usualOptions(50'000);
  const double whole = test::MadeTable(heaps(), part).general.enlargement;
  part.box = base::GeoBox{10.3, 46.3, 10.6, 46.6};
  const test::MadeTable small(heaps(), part);
  EXPECT_LT(small.general.enlargement, whole);
  EXPECT_NEAR(drawn(small) / 50'000, 1, 0.4);
}

TEST(Generalisation, NoCloudsNeedNoBudget) {
  const test::MadeTable made(test::MadeSource(10, 46, 0.25, 2, 2), test::usualOptions());
  EXPECT_EQ(made.general.enlargement, 1);
  EXPECT_TRUE(made.table.clouds.empty());
}

TEST(Generalisation, EnlargedCloudsStayWithinHalfACell) {
  const test::MadeSource source = heaps();
  const test::MadeTable made(source, test::usualOptions(2'000));
  const double cell = std::sqrt(field::cellAreaSquareMeters(source.grid(), 0));
  for (const field::Cloud& cloud : made.table.clouds) EXPECT_LT(cloud.widthMeters, 2 * 0.5 * cell);
}

}  // namespace
}  // namespace cloudgen::pipeline
