// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <numbers>

#include "field/collect.hpp"
#include "input/catalogue.hpp"
#include "pipeline/location.hpp"
#include "pipeline/pipeline.hpp"
#include "support/made_source.hpp"
#include "support/painted_sky.hpp"

namespace cloudgen::pipeline {
namespace {

/// The drawn sky against what its layers say, cell by cell.
struct Difference {
  double coverBias = 0, coverRmse = 0, opticalDepthBias = 0;  ///< the last relative
};

std::ostream& operator<<(std::ostream& out, const Difference& d) {
  return out << "cover bias " << d.coverBias << " rmse " << d.coverRmse << ", optical depth bias "
             << d.opticalDepthBias;
}

using Wanted = std::map<std::uint32_t, std::pair<double, double>>;  ///< cover, mean optical depth

Difference differenceOf(const scene::Scene& scene, const field::Grid& grid, const Wanted& wanted,
                        double pixelMeters) {
  Difference d;
  double cells = 0, water = 0, owed = 0;
  for (const auto& [cell, seen] : test::PaintedSky(scene, pixelMeters).byCell(scene, grid)) {
    const auto found = wanted.find(cell);
    const auto [cover, depth] = found == wanted.end() ? std::pair{0.0, 0.0} : found->second;
    const double error = seen.cover() - cover;
    d.coverBias += error, d.coverRmse += error * error, cells += 1;
    water += seen.opticalDepth, owed += depth * seen.pixels;
  }
  d.coverBias /= cells, d.coverRmse = std::sqrt(d.coverRmse / cells);
  d.opticalDepthBias = water / owed - 1;
  return d;
}

/// Of layers one above the other with clear air between them: they overlap by chance.
Wanted wantedOf(const test::MadeSource& source) {
  Wanted wanted;
  for (const field::StatedLayer& layer : source.layers) {
    auto& [cover, depth] = wanted[layer.cell];
    cover = 1 - (1 - cover) * (1 - layer.coverFraction);
    depth += layer.coverFraction * layer.opticalDepth;
  }
  return wanted;
}

field::StatedLayer layerOf(base::Genus genus, float cover) {
  const shape::Recipe recipe = test::usualOptions().recipes.of(genus);
  const float depth = std::sqrt(recipe.thicknessMeters.low * recipe.thicknessMeters.high);
  return {.genus = genus,
          .coverFraction = cover,
          .baseMeters = 1000,
          .topMeters = 1000 + depth,
          .opticalDepth = recipe.opticalDepth,
          .windEast = 8,
          .windNorth = 3};
}

Difference drawn(const test::MadeSource& source, std::uint64_t budget, std::uint64_t seed) {
  Options options = test::usualOptions(budget);
  options.seed = seed;
  return differenceOf(run(source, options, {}).scene, source.grid(), wantedOf(source), 1200);
}

test::MadeSource uniformSky(const field::StatedLayer& layer) {
  test::MadeSource source(10, 44, 0.8, 4, 4);
  source.cover(layer);
  return source;
}

class OfAllGenera : public testing::TestWithParam<float> {};

TEST_P(OfAllGenera, CoverAndOpticalDepth) {
  const float cover = GetParam();
  for (const base::Genus genus : base::allGenera()) {
    const Difference d = drawn(uniformSky(layerOf(genus, cover)), 40'000, 1);
    // Towers stand apart: a sky full of them has gaps.
    const double tolerated = genus == base::Genus::Cumulonimbus && cover > 0.8f ? 0.1 : 0.025;
    EXPECT_LT(std::abs(d.coverBias), tolerated) << base::name(genus) << ": " << d;
    EXPECT_LT(d.coverRmse, 0.03 + tolerated) << base::name(genus) << ": " << d;
    EXPECT_LT(std::abs(d.opticalDepthBias), 0.04) << base::name(genus) << ": " << d;
  }
}
INSTANTIATE_TEST_SUITE_P(Conservation, OfAllGenera, testing::Values(0.15f, 0.6f, 1.0f));

TEST(Conservation, ThinLayersAreSeenAsWide) {
  for (const base::Genus genus : {base::Genus::Cirrus, base::Genus::Cirrostratus, base::Genus::Stratus})
    for (const float opticalDepth : {0.25f, 0.6f, 1.0f}) {
      field::StatedLayer layer = layerOf(genus, 0.6f);
      layer.opticalDepth = opticalDepth;
      const Difference d = drawn(uniformSky(layer), 100'000, 1);
      EXPECT_LT(std::abs(d.coverBias), 0.03) << base::name(genus) << ' ' << opticalDepth << ": " << d;
    }
}

TEST(Conservation, WhateverTheSeedAndTheBudget) {
  for (const std::uint64_t budget : {10'000u, 100'000u})
    for (const std::uint64_t seed : {1u, 2u, 3u})
      for (const base::Genus genus : {base::Genus::Stratocumulus, base::Genus::Cumulus}) {
        const Difference d = drawn(uniformSky(layerOf(genus, 0.4f)), budget, seed);
        EXPECT_LT(std::abs(d.coverBias), 0.01) << base::name(genus) << ' ' << budget << ": " << d;
        EXPECT_LT(d.coverRmse, 0.05) << base::name(genus) << ' ' << budget << ": " << d;
        EXPECT_LT(std::abs(d.opticalDepthBias), 0.04) << base::name(genus) << ' ' << budget << ": " << d;
      }
}

// A budget of a few puffs a cell: each still shows its own cover and optical depth.
TEST(Conservation, FewPuffsACell) {
  test::MadeSource source(10, 44, 0.2, 20, 20);
  field::StatedLayer layer = layerOf(base::Genus::Stratus, 0);
  for (std::uint32_t cell = 0; cell < source.grid().size(); ++cell) {
    layer.cell = cell;
    // Four hundred cells in soft waves of cover.
    layer.coverFraction =
        static_cast<float>(0.5 + 0.45 * std::sin(0.6 * (cell % 20)) * std::cos(0.5 * (cell / 20)));
    source.layers.push_back(layer);
  }
  const Difference d = drawn(source, 12'000, 1);
  EXPECT_LT(std::abs(d.coverBias), 0.01) << d;
  EXPECT_LT(d.coverRmse, 0.08) << d;
  EXPECT_LT(std::abs(d.opticalDepthBias), 0.02) << d;
}

// Cells that are all covered, beside cells that are clear.
TEST(Conservation, FullSheetsHaveNoGapsAndStayInTheirCells) {
  for (const base::Genus genus : {base::Genus::Stratus, base::Genus::Altostratus}) {
    test::MadeSource source(10, 44, 0.6, 8, 8);
    field::StatedLayer layer = layerOf(genus, 1);
    for (std::uint32_t cell = 0; cell < source.grid().size(); ++cell) {
      layer.cell = cell;
      if ((cell % 8 / 3 + cell / 8 / 3) % 2 == 0) source.layers.push_back(layer);
    }
    const Wanted wanted = wantedOf(source);
    const scene::Scene scene = run(source, test::usualOptions(20'000), {}).scene;
    double full = 0, fullRmse = 0, clear = 0, clearRmse = 0;
    for (const auto& [cell, seen] : test::PaintedSky(scene, 2000).byCell(scene, source.grid())) {
      const double cover = seen.cover();
      if (wanted.contains(cell))
        full += 1, fullRmse += (1 - cover) * (1 - cover);
      else
        clear += 1, clearRmse += cover * cover;
    }
    EXPECT_LT(std::sqrt(fullRmse / full), 0.05) << base::name(genus);
    EXPECT_LT(std::sqrt(clearRmse / clear), 0.12) << base::name(genus);
  }
}

TEST(Conservation, LayersOverlapByChance) {
  test::MadeSource source(10, 44, 0.8, 4, 4);
  field::StatedLayer low = layerOf(base::Genus::Stratocumulus, 0.5f),
                     high = layerOf(base::Genus::Altocumulus, 0.5f);
  high.baseMeters += 4000, high.topMeters += 4000;
  source.cover(low);
  source.cover(high);
  const Difference d = drawn(source, 100'000, 1);
  EXPECT_LT(std::abs(d.coverBias), 0.02) << d;
  EXPECT_LT(d.coverRmse, 0.04) << d;
}

// A cell of cloud amid clear ones, and covers that differ: each cell has its own.
TEST(Conservation, CellByCell) {
  test::MadeSource source(10, 44, 0.8, 5, 5);
  field::StatedLayer layer = layerOf(base::Genus::Stratocumulus, 0);
  for (std::uint32_t cell = 0; cell < source.grid().size(); ++cell) {
    layer.cell = cell;
    layer.coverFraction = static_cast<float>(cell * 7 % 5) / 4;
    source.layers.push_back(layer);
  }
  const Difference d = drawn(source, 100'000, 1);
  EXPECT_LT(std::abs(d.coverBias), 0.015) << d;
  EXPECT_LT(d.coverRmse, 0.05) << d;
}

// A part of the real forecast of the examples, before it is written.
TEST(Conservation, OfARealForecast) {
  const std::filesystem::path file =
      std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data" / "gfs_2p5_20110110_f120.grib2";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "../shared is not there";
  const auto source = input::open({file});
  Options options = test::usualOptions(80'000);
  options.box = base::GeoBox{-100, 30, -80, 45};
  const Outcome outcome = run(*source, options, {});
  Wanted wanted;
  for (const field::Layer& layer :
       locateLayers(field::collectColumns(*source, field::cellsTouching(source->grid(), *options.box)))) {
    auto& [cover, depth] = wanted[layer.cell];
    if (layer.opticalDepth() >= 0.1f) cover = 1 - (1 - cover) * (1 - layer.fraction);
    depth += layer.fraction * layer.opticalDepth();
  }
  const Difference d = differenceOf(outcome.scene, source->grid(), wanted, 5000);
  EXPECT_LT(std::abs(d.coverBias), 0.01) << d;
  EXPECT_LT(d.coverRmse, 0.05) << d;
  EXPECT_LT(std::abs(d.opticalDepthBias), 0.02) << d;
  EXPECT_LT(static_cast<double>(scene::drawnPuffs(outcome.scene)), 1.5 * 80'000);
}

/// Power of the drawn cover along the rows at so many waves across.
double powerAt(const test::PaintedSky& sky, double waves) {
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
}

// Fields of cloud do not show the model's grid: along the rows, the spectrum of the drawn cover at the
// spacing of the cells is no higher than beside it.
TEST(Conservation, TheGridDoesNotShow) {
  for (const base::Genus genus : {base::Genus::Stratocumulus, base::Genus::Cumulus}) {
    test::MadeSource source(10, 44, 0.25, 32, 16);
    source.cover(layerOf(genus, 0.5f));
    const Outcome outcome = run(source, test::usualOptions(400'000), {});
    const double spacing = field::cellSidesMeters(source.grid(), source.grid().index(0, 8)).x;
    const test::PaintedSky sky(outcome.scene, spacing / 8);
    const double cells = sky.columns / 8.0;
    double beside = 0, there = 0;
    for (const double away : {-5.0, -4.0, -3.0, 3.0, 4.0, 5.0}) beside += powerAt(sky, cells + away) / 6;
    for (const double away : {-1.0, 0.0, 1.0}) there += powerAt(sky, cells + away) / 3;
    EXPECT_LT(there / beside, 1.5) << base::name(genus);
  }
}

}  // namespace
}  // namespace cloudgen::pipeline
