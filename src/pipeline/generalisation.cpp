// SPDX-License-Identifier: Apache-2.0
#include "pipeline/generalisation.hpp"

#include <algorithm>
#include <cmath>

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

Generalisation generalise(const field::Grid& grid, std::span<const field::Layer> layers,
                          const Options& options, const base::GeoBox& box) {
  Generalisation out;
  std::vector<double> areas;
  double cellArea = 0;
  for (const field::Layer& layer : layers) {
    const double area = field::cellAreaSquareMeters(grid, layer.cell);
    areas.push_back(layer.fraction * field::shareInside(grid, layer.cell, box) * area);
    cellArea = std::max(cellArea, area);
  }
  out.widestMeters = 0.5 * std::sqrt(cellArea);
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
  return out;
}

}  // namespace cloudgen::pipeline
