// SPDX-License-Identifier: Apache-2.0
#include "shape/generate.hpp"

#include <cmath>
#include <numbers>

#include "support/all_recipes.hpp"

namespace cloudgen::shape {
namespace {

class EveryGenus : public testing::TestWithParam<base::Genus> {
 protected:
  Recipe recipe = test::recipeOf(GetParam());

  /// As production asks: a thickness in the middle of the recipe's range and a width that goes with it.
  ShapeRequest request(int puffs) const {
    ShapeRequest wanted;
    wanted.depthMeters = std::sqrt(recipe.thicknessMeters.low * recipe.thicknessMeters.high);
    const double perDepth = recipe.form == Form::Heap        ? 0.9
                            : recipe.form == Form::Tower     ? 1.9
                            : recipe.form == Form::Filaments ? 10
                                                             : 22;
    wanted.widthMeters = perDepth * wanted.depthMeters;
    wanted.opticalDepth = recipe.opticalDepth;
    wanted.puffs = puffs;
    wanted.seed = 11;
    return wanted;
  }
};

std::string genusName(const testing::TestParamInfo<base::Genus>& info) {
  return std::string(base::name(info.param));
}
INSTANTIATE_TEST_SUITE_P(Shape, EveryGenus, testing::ValuesIn(base::allGenera()), genusName);

double totalArea(const CloudShape& cloud) {
  double sum = 0;
  for (const Puff& puff : cloud.puffs) sum += extinctionArea(puff);
  return sum;
}

bool finite(const Puff& puff) {
  const float sum = puff.center.x + puff.center.y + puff.center.z + puff.sigma.x + puff.sigma.y +
                    puff.sigma.z + puff.rotation.w + puff.rotation.x + puff.rotation.y + puff.rotation.z +
                    puff.extinctionPerMeter;
  return std::isfinite(sum) && std::min({puff.sigma.x, puff.sigma.y, puff.sigma.z}) > 0 &&
         puff.extinctionPerMeter >= 0;
}

TEST_P(EveryGenus, WaterIsWhatWasAskedFor) {
  recipe.precipitation = 0;
  for (const int puffs : {100, 1000}) {
    const ShapeRequest wanted = request(puffs);
    const double footprint = 0.25 * std::numbers::pi * wanted.widthMeters * wanted.widthMeters;
    EXPECT_DOUBLE_EQ(footprintSquareMeters(wanted.widthMeters), footprint);
    EXPECT_NEAR(totalArea(generate(recipe, wanted)) / (wanted.opticalDepth * footprint), 1, 1e-3);
  }
}

TEST_P(EveryGenus, EveryBudgetMakesAWholeCloud) {
  for (const int puffs : {1, 30, 100, 1000, 20000})
    for (const std::uint64_t variant : {0u, 1u, 2u, 3u}) {
      ShapeRequest wanted = request(puffs);
      wanted.variant = variant;
      const CloudShape cloud = generate(recipe, wanted);
      ASSERT_FALSE(cloud.puffs.empty()) << puffs;
      if (puffs >= 1000) {
        EXPECT_LE(cloud.puffs.size(), 1.5 * puffs) << puffs << " variant " << variant;
        EXPECT_GE(cloud.puffs.size(), 0.5 * puffs) << puffs << " variant " << variant;
      }
      EXPECT_LE(cloud.puffs.size(), std::max(1.5 * puffs, 170.0)) << puffs << " variant " << variant;
      for (const Puff& puff : cloud.puffs) ASSERT_TRUE(finite(puff)) << puffs << " variant " << variant;
    }
}

TEST_P(EveryGenus, TheSmallestBudgetNeverLosesTheCloud) {
  for (const int puffs : {1, 20})
    for (std::uint64_t variant = 0; variant < 100; ++variant) {
      ShapeRequest wanted = request(puffs);
      wanted.variant = variant;
      const CloudShape cloud = generate(recipe, wanted);
      ASSERT_FALSE(cloud.puffs.empty()) << puffs << " variant " << variant;
      for (const Puff& puff : cloud.puffs) ASSERT_TRUE(finite(puff)) << puffs << " variant " << variant;
    }
}

TEST_P(EveryGenus, SectionsAreOrderedAndTheirStartsRight) {
  for (const int puffs : {40, 2000}) {
    const CloudShape cloud = generate(recipe, request(puffs));
    ASSERT_GE(cloud.sectionStart.size(), 2u);
    EXPECT_EQ(cloud.sectionStart.front(), 0u);
    EXPECT_EQ(cloud.sectionStart.back(), cloud.puffs.size());
    for (std::size_t section = 0; section + 1 < cloud.sectionStart.size(); ++section) {
      ASSERT_LT(cloud.sectionStart[section], cloud.sectionStart[section + 1]);
      for (std::uint32_t i = cloud.sectionStart[section]; i < cloud.sectionStart[section + 1]; ++i)
        ASSERT_EQ(cloud.puffs[i].section, section);
    }
  }
}

TEST_P(EveryGenus, SpritesAreTilesOfTheAtlas) {
  for (const Puff& puff : generate(recipe, request(300)).puffs) ASSERT_LT(puff.sprite, 16);
}

TEST_P(EveryGenus, StandsOnItsBaseAndKeepsItsDepth) {
  recipe.precipitation = 0;
  const ShapeRequest wanted = request(1000);
  double within = 0, all = 0;
  for (const Puff& puff : generate(recipe, wanted).puffs) {
    const Bounds own = boundsOf({&puff, 1}, 1.0f);
    const double sigmaY = 0.5 * (own.upper.y - own.lower.y);
    EXPECT_GE(puff.center.y + 2 * sigmaY, 0);
    EXPECT_GE(puff.center.y, -0.05 * wanted.depthMeters);
    EXPECT_LE(puff.center.y, 1.25 * wanted.depthMeters);
    all += extinctionArea(puff);
    if (puff.center.y - sigmaY > -0.05 * wanted.depthMeters &&
        puff.center.y + sigmaY < 1.1 * wanted.depthMeters)
      within += extinctionArea(puff);
  }
  EXPECT_GT(within, 0.9 * all);
}

TEST_P(EveryGenus, PrecipitationHangsBelowAndAddsLittle) {
  const ShapeRequest wanted = request(1000);
  const double footprint = footprintSquareMeters(wanted.widthMeters);
  double below = 0;
  for (const Puff& puff : generate(recipe, wanted).puffs)
    if (puff.center.y < -0.02 * wanted.depthMeters) below += extinctionArea(puff);
  if (recipe.precipitation > 0)
    EXPECT_GT(below, 0);
  else
    EXPECT_EQ(below, 0);
  EXPECT_LT(below, 0.1 * wanted.opticalDepth * footprint);
}

bool samePuffs(const CloudShape& a, const CloudShape& b) {
  return a.sectionStart == b.sectionStart &&
         std::equal(a.puffs.begin(), a.puffs.end(), b.puffs.begin(), b.puffs.end(), [](auto& p, auto& q) {
           return p.center == q.center && p.sigma == q.sigma && p.rotation == q.rotation &&
                  p.extinctionPerMeter == q.extinctionPerMeter && p.sprite == q.sprite;
         });
}

TEST_P(EveryGenus, TheRequestDecidesEverything) {
  const ShapeRequest wanted = request(400);
  ShapeRequest otherVariant = wanted, otherSeed = wanted;
  otherVariant.variant = 1;
  otherSeed.seed = 12;
  const CloudShape cloud = generate(recipe, wanted);
  EXPECT_TRUE(samePuffs(cloud, generate(recipe, wanted)));
  EXPECT_FALSE(samePuffs(cloud, generate(recipe, otherVariant)));
  EXPECT_FALSE(samePuffs(cloud, generate(recipe, otherSeed)));
}

/// Mean distance downwind of the puffs in the upper or the lower half.
double meanDownwind(const CloudShape& cloud, double middle, bool upper) {
  double sum = 0, area = 0;
  for (const Puff& puff : cloud.puffs) {
    if ((puff.center.y > middle) != upper) continue;
    sum += extinctionArea(puff) * puff.center.x;
    area += extinctionArea(puff);
  }
  return sum / area;
}

TEST_P(EveryGenus, ShearLeansHeapsAndTowersDownwind) {
  if (recipe.form != Form::Heap && recipe.form != Form::Tower) GTEST_SKIP() << "not a heap or a tower";
  ShapeRequest calm = request(1500), sheared = calm;
  sheared.tilt = 0.5;
  const double middle = 0.4 * calm.depthMeters;
  const auto lean = [&](const ShapeRequest& wanted) {
    const CloudShape cloud = generate(recipe, wanted);
    return meanDownwind(cloud, middle, true) - meanDownwind(cloud, middle, false);
  };
  EXPECT_GT(lean(sheared), lean(calm) + 0.05 * calm.depthMeters);
}

TEST_P(EveryGenus, SheetsFadeAtTheirBorder) {
  if (!recipe.sheet) GTEST_SKIP() << "not a sheet";
  const ShapeRequest wanted = request(4000);
  double inner = 0, outer = 0, beyond = 0, all = 0;
  for (const Puff& puff : generate(recipe, wanted).puffs) {
    const double q = std::hypot(puff.center.x, puff.center.z) / (0.5 * wanted.widthMeters);
    (q < 0.6 ? inner : q < 1 ? outer : beyond) += extinctionArea(puff);
    all += extinctionArea(puff);
  }
  // Optical depth over equal ground: the rim is thinner than the middle, and little lies outside the
  // footprint.
  EXPECT_GT(inner / 0.36, outer / 0.64);
  EXPECT_LT(beyond, 0.25 * all);
}

TEST(Shape, AWideHeapIsAFieldOfHeaps) {
  ShapeRequest wanted{20000, 1000, 20, 0, 800, 5, 0};
  const CloudShape cloud = generate(test::recipeOf(base::Genus::Cumulus), wanted);
  EXPECT_NEAR(totalArea(cloud) / (20 * footprintSquareMeters(20000)), 1, 1e-3);
  EXPECT_LE(cloud.puffs.size(), 1200u);
  EXPECT_GT(cloud.sectionStart.size(), 10u);
  for (const Puff& puff : cloud.puffs) {
    EXPECT_TRUE(finite(puff));
    EXPECT_GE(puff.center.y, 0);
    EXPECT_LE(puff.center.y, 1000);
  }
}

}  // namespace
}  // namespace cloudgen::shape
