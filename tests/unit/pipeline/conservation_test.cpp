// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iomanip>
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
             << d.opticalDepthBias << ", cells " << d.cells << ", clouds " << d.clouds << ", puffs " << d.puffs;
}

/// `inner`: rings of cells at the border that are left out, because clouds beyond it are missing there.
Difference differenceOf(const test::MadeSource& source, const Options& options, double pixel, int inner) {
  const Outcome outcome = run(source, options, {});
  const field::Grid& grid = source.grid();
  std::map<std::uint32_t, const field::StatedLayer*> layers;
  for (const field::StatedLayer& layer : source.layers) layers[layer.cell] = &layer;
  const auto seen = test::PaintedSky(outcome.scene, pixel).byCell(outcome.scene, grid);
  Difference d;
  std::cout << std::setprecision(3);
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
  for (const std::uint64_t budget : {20'000u, 200'000u, 2'000'000u}) {
    Options options = test::usualOptions(budget);
    options.box = base::GeoBox{-100, 25, -60, 50};
    const Outcome outcome = run(*source, options, {});
    auto layers = locateLayers(field::collectColumns(
        *source, field::cellsTouching(source->grid(), field::extent(source->grid()))));
    typeLayers(source->grid(), layers);
    std::map<std::uint32_t, double> error;
    double bias = 0, square = 0, water = 0, wanted = 0, cells = 0, away = 0;
    for (const base::Genus genus : base::allGenera()) {
      std::map<std::uint32_t, double> clear, depth;
      for (const field::Layer& layer : layers)
        if (layer.genus == genus) {
          clear.try_emplace(layer.cell, 1).first->second *= 1 - layer.fraction;
          depth[layer.cell] += layer.fraction * layer.opticalDepth();
        }
      const auto seen = test::PaintedSky(outcome.scene, 4000, genus).byCell(outcome.scene, source->grid());
      for (const auto& [cell, sky] : seen) {
        const double cover = clear.contains(cell) ? 1 - clear.at(cell) : 0;
        const double difference = sky.cover() - cover;
        bias += difference, square += difference * difference, away += std::abs(difference), cells += 1;
        water += sky.meanOpticalDepth() * sky.pixels, wanted += (depth.contains(cell) ? depth.at(cell) : 0) * sky.pixels;
      }
    }
    std::cout << "MEASURE GFS " << budget << ": cover bias " << bias / cells << " rmse "
              << std::sqrt(square / cells) << " abs " << away / cells << " tau " << water / wanted - 1
              << " puffs " << scene::drawnPuffs(outcome.scene) << std::endl;
  }
}

TEST(Conservation, Measure) {
  for (const bool fine : {false, true})
    for (const base::Genus genus : base::allGenera())
      for (const float cover : {0.1f, 0.5f, 0.9f, 1.0f}) {
        const int cells = fine ? 40 : 4;
        test::MadeSource source(10, 44, fine ? 0.2 : 1.5, cells, cells);
        source.cover(layerOf(genus, cover));
        std::cout << "MEASURE " << fine << ' ' << base::abbreviation(genus) << ' ' << cover << ": "
                  << differenceOf(source, test::usualOptions(200'000), fine ? 1500 : 1000, fine ? 3 : 1)
                  << std::endl;
      }
}

}  // namespace
}  // namespace cloudgen::pipeline
