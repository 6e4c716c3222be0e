// SPDX-License-Identifier: Apache-2.0
#include "pipeline/generalisation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shape/generate.hpp"

namespace cloudgen::pipeline {
int fewestPuffs(const shape::Recipe& recipe) {
  switch (recipe.form) {
    case shape::Form::Heap:
      return 5 * recipe.billboards;
    case shape::Form::Tower:
      return 8 * recipe.sections * recipe.billboards;
    case shape::Form::Cells:
      return 110;
    case shape::Form::Veil:
      return 70;
    case shape::Form::Filaments:
      break;
  }
  return recipe.sections * recipe.billboards;
}

double naturalWidthMeters(const shape::Recipe& recipe, double depthMeters) {
  const auto within = [&](double width) {
    return std::clamp<double>(width, recipe.widthMeters.low, recipe.widthMeters.high);
  };
  switch (recipe.form) {
    case shape::Form::Heap:
      return within(1.1 * depthMeters);
    case shape::Form::Tower:
      return within(1.9 * depthMeters);
    case shape::Form::Cells:
      return within(22.0 * depthMeters);
    case shape::Form::Veil:
      return within(25.0 * depthMeters);
    case shape::Form::Filaments:
      break;
  }
  return within(10.0 * depthMeters);
}

double coveredSquareMeters(const shape::Recipe& recipe, double widthMeters) {
  if (!recipe.sheet) return shape::footprintSquareMeters(widthMeters);
  const double spacing = (recipe.form == shape::Form::Veil ? 0.5 : 0.7) * widthMeters;
  return spacing * spacing;
}

double countedWidthMeters(const shape::Recipe& recipe, double coversSquareMeters) {
  const double one = coveredSquareMeters(recipe, 1.0);
  return std::clamp<double>(std::sqrt(coversSquareMeters / one), 0.75 * recipe.widthMeters.low,
                            2.0 * recipe.widthMeters.high);
}

double meanWidthMeters(const Generalisation& general, const shape::Recipe& recipe, double depthMeters) {
  const double natural = naturalWidthMeters(recipe, depthMeters);
  return std::min(natural * general.enlargement, std::max(natural, general.widestMeters));
}

namespace {

/// Blocks of about five clouds across and more, in powers of 2.
std::array<int, base::kGenusCount> blockCellsOf(const field::Grid& grid, std::span<const field::Layer> layers,
                                                std::span<const double> areas, const Options& options,
                                                const Generalisation& general) {
  constexpr double kCloudsAcross = 5;
  constexpr int kMostCells = 4096;
  std::array<double, base::kGenusCount> weight{}, spacing{}, side{};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto genus = static_cast<std::size_t>(layers[i].genus);
    const shape::Recipe& recipe = options.recipes.of(layers[i].genus);
    const double width = meanWidthMeters(general, recipe, layers[i].depthMeters());
    weight[genus] += areas[i];
    spacing[genus] += areas[i] * std::sqrt(coveredSquareMeters(recipe, width));
    side[genus] += areas[i] * field::cellSidesMeters(grid, layers[i].cell).y;
  }
  std::array<int, base::kGenusCount> cells;
  cells.fill(1);
  for (std::size_t genus = 0; genus < cells.size(); ++genus)
    while (weight[genus] > 0 && cells[genus] < std::min(kMostCells, grid.rows) &&
           cells[genus] * side[genus] < kCloudsAcross * spacing[genus])
      cells[genus] *= 2;
  return cells;
}

}  // namespace

Generalisation generalise(const field::Grid& grid, std::span<const field::Layer> layers,
                          const Options& options, const base::GeoBox& box) {
  Generalisation out;
  std::vector<double> areas;
  double cellArea = 0, boxArea = 0;
  std::optional<std::uint32_t> last;
  for (const field::Layer& layer : layers) {
    const double area = field::cellAreaSquareMeters(grid, layer.cell);
    const double inside = field::shareInside(grid, layer.cell, box) * area;
    areas.push_back(layer.fraction * inside);
    if (last != layer.cell) boxArea += inside;
    last = layer.cell;
    cellArea = std::max(cellArea, area);
  }
  out.widestMeters = std::max(0.5 * std::sqrt(cellArea), 0.25 * std::sqrt(boxArea));
  const auto coarsestPuffs = [&](double enlargement) {
    out.enlargement = enlargement;
    double puffs = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const shape::Recipe& recipe = options.recipes.of(layers[i].genus);
      if (layers[i].cloudCount > 0) {
        puffs += fewestPuffs(recipe) * layers[i].cloudCount * field::shareInside(grid, layers[i].cell, box);
        continue;
      }
      puffs += fewestPuffs(recipe) * areas[i] /
               coveredSquareMeters(recipe, meanWidthMeters(out, recipe, layers[i].depthMeters()));
    }
    return puffs;
  };
  // Where clouds as wide as they may be still take more than the budget, they need not be wider than that
  // takes.
  const double budget = std::max(static_cast<double>(options.maxPuffs), 1.001 * coarsestPuffs(1000));
  double enough = 1;
  if (coarsestPuffs(1) > budget) {
    double tooFew = 1;
    enough = 1000;
    for (int i = 0; i < 40; ++i) {
      const double middle = std::sqrt(tooFew * enough);
      (coarsestPuffs(middle) > budget ? tooFew : enough) = middle;
    }
  }
  // Below 1 only where enlargement has reached its limit: clouds are then told by fewer puffs than they
  // should have.
  const double richness =
      std::clamp(static_cast<double>(options.maxPuffs) / std::max(coarsestPuffs(enough), 1.0), 0.1, 400.0);
  for (const base::Genus genus : base::allGenera())
    out.puffsPerCloud[static_cast<size_t>(genus)] =
        static_cast<int>(fewestPuffs(options.recipes.of(genus)) * richness);
  out.enlargement = enough;
  out.blockCells = blockCellsOf(grid, layers, areas, options, out);
  return out;
}

}  // namespace cloudgen::pipeline
