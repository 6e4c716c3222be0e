// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "input/catalogue.hpp"
#include "pipeline/pipeline.hpp"
#include "shape/puff.hpp"
#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

bool mentions(const std::vector<std::string>& warnings, const std::string& word) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](auto& line) { return line.find(word) != std::string::npos; });
}

TEST(Run, FromStatedLayersToAScene) {
  test::MadeSource source(10, 46, 0.5, 2, 2);
  source.cover(test::cumulusLayer());
  const Outcome outcome = run(source, test::usualOptions(10'000), {});
  EXPECT_EQ(outcome.columns, 4u);
  EXPECT_EQ(outcome.layers, 4u);
  EXPECT_EQ(outcome.patches, 1u);
  EXPECT_FALSE(outcome.scene.instances.empty());
  ASSERT_FALSE(outcome.cloudyLayers.empty());
  EXPECT_LE(outcome.cloudyLayers.size(), 4u);
  EXPECT_EQ(outcome.cloudyLayers[0].layer.rule, "stated");
  EXPECT_GT(outcome.enlargement, 1);
  EXPECT_TRUE(mentions(outcome.warnings, "--max-puffs"));
  // A scene does not tell where it was made.
  EXPECT_EQ(outcome.scene.provenance.files, std::vector<std::string>{"made.grib2"});
  EXPECT_NEAR(static_cast<double>(scene::drawnPuffs(outcome.scene)), 10'000, 4'000);
}

TEST(Run, AClearSkyIsASceneWithAWarning) {
  test::MadeSource source(10, 46, 0.5, 2, 2);
  field::StatedLayer clear = test::cumulusLayer(0);
  source.cover(clear);
  const Outcome outcome = run(source, test::usualOptions(), {});
  EXPECT_TRUE(outcome.scene.instances.empty());
  EXPECT_TRUE(mentions(outcome.warnings, "clear"));
}

TEST(Run, AnOverdrawnBudgetIsSaid) {
  test::MadeSource source(10, 46, 0.5, 2, 2);
  source.cover(test::cumulusLayer());
  EXPECT_TRUE(mentions(run(source, test::usualOptions(10), {}).warnings, "too small"));
}

TEST(Run, StopsWhenTheUserWants) {
  test::MadeSource source(10, 46, 0.5, 2, 2);
  base::Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_THROW(run(source, test::usualOptions(), progress), base::InterruptedError);
}

class RealModel : public testing::Test {
 protected:
  static std::filesystem::path data(const std::string& name) {
    return std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data" / name;
  }
  static void expectWholeScene(const Outcome& outcome, double budget) {
    EXPECT_GT(outcome.cells, 100u);
    EXPECT_GT(outcome.layers, 20u);
    EXPECT_LE(outcome.patches, outcome.layers);
    EXPECT_GT(outcome.scene.instances.size(), 20u);
    const double drawn = static_cast<double>(scene::drawnPuffs(outcome.scene));
    EXPECT_GT(drawn, 0.5 * budget);
    EXPECT_LT(drawn, 1.6 * budget);
    for (const scene::CloudRecord& cloud : outcome.scene.clouds) {
      EXPECT_FALSE(cloud.rule.empty());
      ASSERT_GT(cloud.topMeters, cloud.baseMeters);
      ASSERT_LT(cloud.topMeters, 22000);
      ASSERT_TRUE(std::isfinite(cloud.opticalDepth) && cloud.opticalDepth > 0);
      EXPECT_TRUE(cloud.genus != base::Genus::Cirrus || cloud.baseMeters > 3500);
      EXPECT_TRUE(cloud.genus != base::Genus::Stratus || cloud.topMeters < 5000);
      EXPECT_TRUE(cloud.genus != base::Genus::Cumulonimbus || cloud.topMeters > 5000);
    }
  }
};

TEST_F(RealModel, GlobalForecastOverEurope) {
  if (!std::filesystem::exists(data("gfs_2p5_20110110_f120.grib2"))) GTEST_SKIP() << "../shared is not there";
  const auto source = input::open({data("gfs_2p5_20110110_f120.grib2")});
  Options options = test::usualOptions(20'000);
  options.box = base::GeoBox{-10, 45, 5, 55};
  const Outcome outcome = run(*source, options, {});
  expectWholeScene(outcome, 20'000);
  std::map<base::Genus, int> genera;
  for (const scene::CloudRecord& cloud : outcome.scene.clouds) ++genera[cloud.genus];
  EXPECT_GE(genera.size(), 4u);
  EXPECT_TRUE(std::any_of(outcome.derived.begin(), outcome.derived.end(),
                          [](auto& made) { return made.first == "liquid and ice"; }));
  EXPECT_TRUE(std::any_of(outcome.derived.begin(), outcome.derived.end(),
                          [](auto& made) { return made.first == "cloud fraction"; }));
}

}  // namespace
}  // namespace cloudgen::pipeline
