// SPDX-License-Identifier: Apache-2.0
#include "pipeline/generalisation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "pipeline/footprint.hpp"
#include "pipeline/quantity.hpp"
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
  const double times = recipe.sheet ? std::sqrt(general.enlargement) : general.enlargement;
  return std::min(natural * times, std::max(natural, general.widestMeters));
}

namespace {

/// Ground, in squares of the width, that a lone cloud covers with this optical depth.
double coveredAlone(base::Genus genus, double aspect, double opticalDepth, const Options& options) {
  Generalisation coarsest;
  coarsest.puffsPerCloud.fill(fewestPuffs(options.recipes.of(genus)));
  field::Layer layer;
  layer.genus = genus;
  return FootprintBook(options, coarsest)
      .of(shapeKeyOf(layer, 0, aspect, 1, options))
      .coveredAlone(opticalDepth, std::min(kCoveringOpticalDepth, opticalDepth / 3));
}

/// For each layer, the puffs that its clouds take at the coarsest level times the square of their width, at
/// the aspect that they have under this enlargement; for counted clouds the puffs.
std::vector<double> puffsOfUnitWidth(const field::Grid& grid, std::span<const field::Layer> layers,
                                     std::span<const double> areas, const Options& options,
                                     const base::GeoBox& box, const Generalisation& general) {
  std::map<std::tuple<base::Genus, int, int>, double> alone;
  std::vector<double> costs;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const field::Layer& layer = layers[i];
    const shape::Recipe& recipe = options.recipes.of(layer.genus);
    if (layer.cloudCount > 0 || areas[i] <= 0) {
      costs.push_back(fewestPuffs(recipe) * layer.cloudCount * field::shareInside(grid, layer.cell, box));
      continue;
    }
    const int depthClass = static_cast<int>(std::lround(std::log2(std::max(0.03f, layer.opticalDepth()))));
    const double aspect = layer.depthMeters() / meanWidthMeters(general, recipe, layer.depthMeters());
    const int aspectClass = static_cast<int>(std::lround(std::log2(aspect)));
    const auto [found, isNew] = alone.try_emplace({layer.genus, depthClass, aspectClass});
    // Threads cover next to nothing; a budget must not be spent on them alone.
    if (isNew)
      found->second =
          std::max(0.08, coveredAlone(layer.genus, std::exp2(aspectClass), std::exp2(depthClass), options));
    // Clouds overlap by chance, the more of them the higher the cover; those of sheets, in clumps of the
    // lattice, about half as much as they would without gaps.
    const double fraction = std::min(layer.fraction, 1.0f);
    const double apart = -std::log(1 - 0.95 * fraction) / (0.95 * fraction) / found->second;
    const double dense = 1 / coveredSquareMeters(recipe, 1);
    costs.push_back(fewestPuffs(recipe) * areas[i] *
                    (!recipe.sheet ? apart : (apart < dense ? std::sqrt(apart * dense) : dense)));
  }
  return costs;
}

/// Finds the enlargement; returns the puffs that it takes at the coarsest level.
double enlarge(Generalisation& out, std::span<const field::Layer> layers, const std::vector<double>& costs,
               const Options& options, double widestOfAll) {
  const auto coarsestPuffs = [&](double enlargement) {
    out.enlargement = enlargement;
    double puffs = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (layers[i].cloudCount > 0) {
        puffs += costs[i];
        continue;
      }
      const double width = meanWidthMeters(out, options.recipes.of(layers[i].genus), layers[i].depthMeters());
      puffs += costs[i] / (width * width);
    }
    return puffs;
  };
  constexpr double kMost = 1e5;
  // Wider than half a cell only where the budget wants it; and even then not all of the sky in one cloud.
  const auto maxPuffs = static_cast<double>(options.maxPuffs);
  while (out.widestMeters < widestOfAll && coarsestPuffs(kMost) > maxPuffs)
    out.widestMeters = std::min(widestOfAll, 1.2 * out.widestMeters);
  // Where clouds as wide as they may be still take more than the budget, they need not be wider than that
  // takes.
  const double budget = std::max(maxPuffs, 1.02 * coarsestPuffs(kMost));
  double enough = 1;
  if (coarsestPuffs(1) > budget) {
    double tooFew = 1;
    enough = kMost;
    for (int i = 0; i < 40; ++i) {
      const double middle = std::sqrt(tooFew * enough);
      (coarsestPuffs(middle) > budget ? tooFew : enough) = middle;
    }
  }
  return coarsestPuffs(enough);
}

/// Blocks of about four clouds across and more, in powers of 2.
std::array<int, base::kGenusCount> blockCellsOf(const field::Grid& grid, std::span<const field::Layer> layers,
                                                std::span<const double> areas, const Options& options,
                                                const Generalisation& general) {
  constexpr double kCloudsAcross = 4;
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
  out.widestMeters = 0.5 * std::sqrt(cellArea);
  // Twice, because what a cloud covers depends on its aspect, and this on the enlargement.
  double puffs = 0;
  for (int pass = 0; pass < 2; ++pass)
    puffs = enlarge(out, layers, puffsOfUnitWidth(grid, layers, areas, options, box, out), options,
                    std::sqrt(boxArea) / 12);
  // Below 1 only where enlargement has reached its limit: clouds are then told by fewer puffs than they
  // should have.
  const double richness =
      std::clamp(static_cast<double>(options.maxPuffs) / std::max(puffs, 1.0), 0.1, 400.0);
  for (const base::Genus genus : base::allGenera())
    out.puffsPerCloud[static_cast<size_t>(genus)] =
        static_cast<int>(fewestPuffs(options.recipes.of(genus)) * richness);
  double natural = 0, drawn = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].cloudCount > 0) continue;
    const shape::Recipe& recipe = options.recipes.of(layers[i].genus);
    natural += areas[i];
    drawn += areas[i] * meanWidthMeters(out, recipe, layers[i].depthMeters()) /
             naturalWidthMeters(recipe, layers[i].depthMeters());
  }
  if (natural > 0) out.meanEnlargement = drawn / natural;
  out.blockCells = blockCellsOf(grid, layers, areas, options, out);
  return out;
}

}  // namespace cloudgen::pipeline
