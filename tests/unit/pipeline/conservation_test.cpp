// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iostream>

#include "field/collect.hpp"
#include "input/catalogue.hpp"
#include "pipeline/location.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/type.hpp"
#include "support/made_source.hpp"
#include "support/painted_sky.hpp"

namespace cloudgen::pipeline {
namespace {

/// The drawn sky against the layers, over the cells of the grid that lie well inside of the box.
struct Difference {
  double coverBias = 0, coverRmse = 0, opticalDepthBias = 0;  ///< the last relative
  double cells = 0, clouds = 0, puffs = 0;
};

std::ostream& operator<<(std::ostream& out, const Difference& d) {
  return out << "cover bias " << d.coverBias << " rmse " << d.coverRmse << ", optical depth bias "
             << d.opticalDepthBias << ", cells " << d.cells << ", clouds " << d.clouds << ", puffs "
             << d.puffs;
}

/// `inner`: rings of cells at the border that are left out, because clouds beyond it are missing there.
Difference differenceOf(const test::MadeSource& source, const Options& options, double pixel, int inner) {
  const Outcome outcome = run(source, options, {});
  const field::Grid& grid = source.grid();
  std::map<std::uint32_t, const field::StatedLayer*> layers;
  for (const field::StatedLayer& layer : source.layers) layers[layer.cell] = &layer;
  const auto seen = test::PaintedSky(outcome.scene, pixel).byCell(outcome.scene, grid);
  Difference d;
  double water = 0, wanted = 0;
  for (const auto& [cell, sky] : seen) {
    const int column = grid.column(cell), row = grid.row(cell);
    if (column < inner || row < inner || column >= grid.columns - inner || row >= grid.rows - inner) continue;
    const double error = sky.cover() - layers.at(cell)->coverFraction;
    d.coverBias += error, d.coverRmse += error * error, d.cells += 1;
    water += sky.meanOpticalDepth(), wanted += layers.at(cell)->coverFraction * layers.at(cell)->opticalDepth;
  }
  d.coverBias /= d.cells, d.coverRmse = std::sqrt(d.coverRmse / d.cells);
  d.opticalDepthBias = water / wanted - 1;
  d.clouds = static_cast<double>(outcome.scene.instances.size());
  d.puffs = static_cast<double>(scene::drawnPuffs(outcome.scene));
  return d;
}

field::StatedLayer layerOf(base::Genus genus, float cover) {
  static const Options kOptions = test::usualOptions();
  const shape::Recipe& recipe = kOptions.recipes.of(genus);
  const float depth = std::sqrt(recipe.thicknessMeters.low * recipe.thicknessMeters.high);
  return {.genus = genus,
          .coverFraction = cover,
          .baseMeters = 1000,
          .topMeters = 1000 + depth,
          .opticalDepth = recipe.opticalDepth,
          .windEast = 8,
          .windNorth = 3};
}

// Regional boxes of a real forecast, genus by genus: what is drawn in a cell against its layers. The box of
// the comparison lies within the one that is built.
TEST(Conservation, OfARealForecast) {
  const std::filesystem::path file =
      std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data" / "gfs_2p5_20110110_f120.grib2";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "../shared is not there";
  const auto source = input::open({file});
  for (const std::uint64_t budget : {20'000u, 200'000u}) {
    Options options = test::usualOptions(budget);
    options.box = base::GeoBox{-100, 25, -60, 50};
    const Outcome outcome = run(*source, options, {});
    auto layers = locateLayers(
        field::collectColumns(*source, field::cellsTouching(source->grid(), field::extent(source->grid()))));
    typeLayers(source->grid(), layers);
    double bias = 0, square = 0, water = 0, wanted = 0, cells = 0, away = 0;
    for (const base::Genus genus : base::allGenera()) {
      std::map<std::uint32_t, double> clear, depth;
      for (const field::Layer& layer : layers)
        if (layer.genus == genus) {
          clear.try_emplace(layer.cell, 1).first->second *= 1 - layer.fraction;
          depth[layer.cell] += layer.fraction * layer.opticalDepth();
        }
      const auto seen = test::PaintedSky(outcome.scene, 4000, genus).byCell(outcome.scene, source->grid());
      double genusBias = 0;
      for (const auto& [cell, sky] : seen) {
        genusBias += (sky.cover() - (clear.contains(cell) ? 1 - clear.at(cell) : 0)) / 187;
        const double cover = clear.contains(cell) ? 1 - clear.at(cell) : 0;
        const double difference = sky.cover() - cover;
        bias += difference, square += difference * difference, away += std::abs(difference), cells += 1;
        water += sky.meanOpticalDepth() * sky.pixels,
            wanted += (depth.contains(cell) ? depth.at(cell) : 0) * sky.pixels;
      }
      std::cout << base::abbreviation(genus) << ' ' << genusBias << ' ';
    }
    std::cout << "MEASURE GFS " << budget << ": cover bias " << bias / cells << " rmse "
              << std::sqrt(square / cells) << " abs " << away / cells << " tau " << water / wanted - 1
              << " puffs " << scene::drawnPuffs(outcome.scene) << std::endl;
    EXPECT_LT(std::abs(bias / cells), 0.03) << budget;
    EXPECT_LT(std::sqrt(square / cells), budget < 100'000 ? 0.2 : 0.12) << budget;
    EXPECT_NEAR(water / wanted, 1, 0.08) << budget;  // clouds at the box's border reach in and out
    EXPECT_LT(static_cast<double>(scene::drawnPuffs(outcome.scene)), 1.5 * static_cast<double>(budget));
  }
}

struct Tolerance {
  double bias, rmse;
};

void expectConserved(const field::StatedLayer& layer, std::uint64_t budget, std::uint64_t seed,
                     const Tolerance& tolerance) {
  test::MadeSource source(10, 44, 1.5, 5, 5);
  source.cover(layer);
  Options options = test::usualOptions(budget);
  options.seed = seed;
  const Difference d = differenceOf(source, options, 1500, 1);
  EXPECT_LT(std::abs(d.coverBias), tolerance.bias)
      << base::name(*layer.genus) << ' ' << layer.coverFraction << ": " << d;
  EXPECT_LT(d.coverRmse, tolerance.rmse)
      << base::name(*layer.genus) << ' ' << layer.coverFraction << ": " << d;
}

// What is drawn covers what the layer says, however broken it is. Filaments cover too little where they are
// many: they are threads.
TEST(Conservation, OfCoverForAllGenera) {
  for (const base::Genus genus : base::allGenera())
    for (const float cover : {0.15f, 0.8f, 1.0f}) {
      const bool fewClouds = genus == base::Genus::Cumulonimbus || genus == base::Genus::Nimbostratus ||
                             genus == base::Genus::Altostratus;
      if (genus == base::Genus::Cirrus || (genus == base::Genus::Cirrocumulus && cover == 1)) continue;
      expectConserved(layerOf(genus, cover), 200'000, 1,
                      fewClouds ? Tolerance{0.12, 0.25} : Tolerance{0.025, 0.06});
    }
}

TEST(Conservation, OfCoverForManySeedsAndBudgets) {
  for (const std::uint64_t budget : {60'000u, 200'000u})
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
      expectConserved(layerOf(base::Genus::Stratocumulus, 0.6f), budget, seed, {0.03, 0.07});
      expectConserved(layerOf(base::Genus::Cumulus, 0.3f), budget, seed, {0.03, 0.07});
    }
}

TEST(Conservation, OfOpticalDepth) {
  for (const base::Genus genus : base::allGenera())
    for (const float cover : {0.2f, 1.0f}) {
      test::MadeSource source(10, 44, 1.5, 4, 4);
      source.cover(layerOf(genus, cover));
      const Outcome outcome = run(source, test::usualOptions(100'000), {});
      double water = 0, wanted = 0;
      for (const scene::Instance& instance : outcome.scene.instances)
        for (const shape::Puff& puff :
             outcome.scene.archetypes[outcome.scene.lit[instance.lit].archetype].puffs)
          water += shape::extinctionArea(scene::placed(outcome.scene, instance, puff));
      for (const field::StatedLayer& layer : source.layers)
        wanted +=
            layer.coverFraction * layer.opticalDepth * field::cellAreaSquareMeters(source.grid(), layer.cell);
      EXPECT_NEAR(water / wanted, 1, 0.005) << base::name(genus) << ' ' << cover;
    }
}

// Cells much smaller than the elements of a sheet leave no trace: along the rows, the spectrum of the drawn
// cover at the spacing of the cells is no higher than beside it.
TEST(Conservation, TheGridDoesNotShow) {
  for (const base::Genus genus : {base::Genus::Stratocumulus, base::Genus::Cumulus}) {
    test::MadeSource source(10, 44, 0.25, 32, 16);
    source.cover(layerOf(genus, 0.5f));
    const Outcome outcome = run(source, test::usualOptions(400'000), {});
    const double spacing = field::cellSidesMeters(source.grid(), source.grid().index(0, 8)).x;
    const test::PaintedSky sky(outcome.scene, spacing / 8);
    const auto powerAt = [&](double waves) {
      double power = 0;
      for (int row = 0; row < sky.rows; ++row) {
        double re = 0, im = 0;
        for (int column = 0; column < sky.columns; ++column) {
          const double phase = 2 * std::numbers::pi * waves * column / sky.columns;
          const double covered = sky.at(column, row) > 0.1f;
          re += covered * std::cos(phase), im += covered * std::sin(phase);
        }
        power += re * re + im * im;
      }
      return power;
    };
    const double cells = sky.columns / 8.0;
    double beside = 0, there = 0;
    for (const double away : {-5.0, -4.0, -3.0, 3.0, 4.0, 5.0}) beside += powerAt(cells + away) / 6;
    for (const double away : {-1.0, 0.0, 1.0}) there += powerAt(cells + away) / 3;
    EXPECT_LT(there / beside, 1.5) << base::name(genus);
  }
}

}  // namespace
}  // namespace cloudgen::pipeline
