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
  return puffsDrawn(made.table, test::usualOptions(), made.general);
}

double enlargement(const test::MadeTable& made) {
  return enlargementOf(made.general, made.table.layers, test::usualOptions());
}

TEST(Generalisation, DrawsAboutTheBudget) {
  for (const std::uint64_t budget : {20'000u, 200'000u, 1'000'000u}) {
    const test::MadeTable made(heaps(), test::usualOptions(budget));
    EXPECT_NEAR(drawn(made) / static_cast<double>(budget), 1, 0.4) << budget;
  }
}

TEST(Generalisation, DrawsAboutTheBudgetOfSheets) {
  test::MadeSource source(10, 46, 0.25, 8, 8);
  source.cover(test::stratocumulusLayer());
  for (const std::uint64_t budget : {100'000u, 200'000u})
    EXPECT_NEAR(drawn({source, test::usualOptions(budget)}) / static_cast<double>(budget), 1, 0.4) << budget;
}

// Not all of the sky in one cloud: a budget too small for that is overdrawn, not answered with absurd widths.
TEST(Generalisation, ABudgetThatCannotBeMetEnlargesNoFurtherThanItHelps) {
  const test::MadeTable made(heaps(), test::usualOptions(1));
  EXPECT_FALSE(made.table.clouds.empty());
  for (const field::Cloud& cloud : made.table.clouds) EXPECT_LT(cloud.widthMeters, 220'000 / 3);
}

// A small budget is saved on both: wider clouds, told by fewer puffs.
TEST(Generalisation, WiderCloudsAreSimpler) {
  const auto cumulus = static_cast<std::size_t>(base::Genus::Cumulus);
  const test::MadeTable small(heaps(), test::usualOptions(5'000)),
      large(heaps(), test::usualOptions(100'000));
  EXPECT_GT(enlargement(small), enlargement(large));
  EXPECT_LT(small.general.puffsPerCloud[cumulus], large.general.puffsPerCloud[cumulus]);
  EXPECT_GE(small.general.puffsPerCloud[cumulus], 9);
}

TEST(Generalisation, ASmallSkyIsDrawnAsItIs) {
  test::MadeSource source(10, 46, 0.05, 2, 2);
  source.cover(test::cumulusLayer());
  const test::MadeTable made(source, test::usualOptions(100'000));
  EXPECT_EQ(enlargement(made), 1);
  EXPECT_GT(made.general.puffsPerCloud[static_cast<std::size_t>(base::Genus::Cumulus)],
            fewestPuffs(test::usualOptions().recipes.of(base::Genus::Cumulus)));
}

TEST(Generalisation, ALargerBudgetNeverEnlargesMore) {
  double last = 1e9;
  for (const std::uint64_t budget : {5'000u, 20'000u, 100'000u, 3'000'000u}) {
    const double wider = enlargement({heaps(), test::usualOptions(budget)});
    EXPECT_LE(wider, last);
    EXPECT_GE(wider, 1);
    last = wider;
  }
  EXPECT_EQ(last, 1);
}

TEST(Generalisation, ASmallerBoxIsDrawnNearerToNature) {
  Options part = test::usualOptions(50'000);
  const double whole = enlargement({heaps(), part});
  part.box = base::GeoBox{10.3, 46.3, 10.6, 46.6};
  const test::MadeTable small(heaps(), part);
  EXPECT_LT(enlargement(small), whole);
  EXPECT_NEAR(drawn(small) / 50'000, 1, 0.6);
}

TEST(Generalisation, NoCloudsNeedNoBudget) {
  const test::MadeTable made(test::MadeSource(10, 46, 0.25, 2, 2), test::usualOptions());
  EXPECT_EQ(enlargement(made), 1);
  EXPECT_TRUE(made.table.clouds.empty());
}

// Clouds are told by ever fewer puffs before they grow wider than the cells that they have to tell apart.
TEST(Generalisation, CellsAreToldApartAsLongAsPuffsCanBeSaved) {
  test::MadeSource source(10, 46, 0.25, 8, 8);
  source.cover(test::stratocumulusLayer());
  const double cell = std::sqrt(field::cellAreaSquareMeters(source.grid(), 0));
  for (const std::uint64_t budget : {5'000u, 100'000u}) {
    const test::MadeTable made(source, test::usualOptions(budget));
    EXPECT_LT(made.general.narrowestMeters, cell) << budget;
    EXPECT_NEAR(drawn(made) / static_cast<double>(budget), 1, 0.4) << budget;
  }
}

// The elements of a sheet are narrow enough to tell how much of a cell is covered.
TEST(Generalisation, ElementsAreSmallerThanCells) {
  test::MadeSource source(10, 46, 0.5, 4, 4);
  source.cover(test::stratocumulusLayer());
  const test::MadeTable made(source, test::usualOptions(1'000'000));
  const double cell = std::sqrt(field::cellAreaSquareMeters(source.grid(), 0));
  for (const field::Cloud& cloud : made.table.clouds) EXPECT_LT(cloud.widthMeters, cell / 3);
}

}  // namespace
}  // namespace cloudgen::pipeline
