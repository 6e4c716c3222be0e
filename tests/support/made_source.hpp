// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "base/data_dir.hpp"
#include "field/source.hpp"
#include "pipeline/options.hpp"
#include "pipeline/recipes.hpp"

namespace cloudgen::test {

/// A model made by hand: layers stated outright over a latitude-longitude grid.
class MadeSource : public field::Source {
 public:
  MadeSource(double west, double south, double stepDegrees, int columns, int rows) {
    grid_.columns = columns, grid_.rows = rows;
    grid_.stepX = grid_.stepY = stepDegrees;
    grid_.firstX = west + 0.5 * stepDegrees, grid_.firstY = south + 0.5 * stepDegrees;
    info_.files = {"/somewhere/made.grib2"};
    info_.format = "made";
    info_.validTime = base::utcFromCivil(2026, 6, 21, 11);
  }
  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return grid_; }
  field::Telling telling() const override { return field::Telling::Layers; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const field::Level&)>&) const override {}
  void visitLayers(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::StatedLayer&)>& visit) const override {
    for (const std::uint32_t cell : cells)
      for (const field::StatedLayer& layer : layers)
        if (layer.cell == cell) visit(layer);
  }

  /// The same layer over every cell.
  void cover(field::StatedLayer layer) {
    for (std::uint32_t cell = 0; cell < grid_.size(); ++cell) {
      layer.cell = cell;
      layers.push_back(layer);
    }
  }
  void setTime(base::UtcTime time) { info_.validTime = time; }

  std::vector<field::StatedLayer> layers;

 private:
  field::SourceInfo info_;
  field::Grid grid_;
};

inline field::StatedLayer cumulusLayer(float cover = 0.3f) {
  return {.genus = base::Genus::Cumulus,
          .coverFraction = cover,
          .baseMeters = 1200,
          .topMeters = 2200,
          .opticalDepth = 15};
}

inline field::StatedLayer stratocumulusLayer(float cover = 0.8f) {
  return {.genus = base::Genus::Stratocumulus,
          .coverFraction = cover,
          .baseMeters = 900,
          .topMeters = 1400,
          .opticalDepth = 8,
          .windEast = 10};
}

/// What users get: every genus by its recipe.
inline pipeline::Options usualOptions(std::uint64_t maxPuffs = 200'000) {
  static const pipeline::RecipeBook kBook = pipeline::readRecipes(base::dataDir() / "templates" / "types");
  pipeline::Options options;
  options.maxPuffs = maxPuffs;
  options.recipes = kBook;
  return options;
}

}  // namespace cloudgen::test
