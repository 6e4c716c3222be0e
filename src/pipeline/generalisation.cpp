// SPDX-License-Identifier: Apache-2.0
#include "pipeline/generalisation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "pipeline/archetype.hpp"
#include "pipeline/canvas.hpp"
#include "pipeline/measured_clouds.hpp"
#include "shape/file_shape.hpp"
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
    case shape::Form::File:
      return 300;
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
      return within(1.5 * depthMeters);
    case shape::Form::Tower:
      return within(2.3 * depthMeters);
    case shape::Form::Cells:
      return within(22.0 * depthMeters);
    case shape::Form::Veil:
      return within(25.0 * depthMeters);
    case shape::Form::File:
      return within(recipe.fileShape->widthOverDepth * depthMeters);
    case shape::Form::Filaments:
      break;
  }
  return within(10.0 * depthMeters);
}

double coveredSquareMeters(const shape::Recipe& recipe, double widthMeters) {
  if (!recipe.sheet) return shape::footprintSquareMeters(widthMeters);
  const double spacing = (recipe.form == shape::Form::Cells ? 0.7 : 0.5) * widthMeters;
  return spacing * spacing;
}

double countedWidthMeters(const shape::Recipe& recipe, double coversSquareMeters) {
  const double one = coveredSquareMeters(recipe, 1.0);
  return std::clamp<double>(std::sqrt(coversSquareMeters / one), 0.75 * recipe.widthMeters.low,
                            2.0 * recipe.widthMeters.high);
}

double meanWidthMeters(const Generalisation& general, const shape::Recipe& recipe, double depthMeters,
                       double fraction) {
  const double natural = naturalWidthMeters(recipe, depthMeters);
  const double narrowest = general.narrowestMeters * std::pow(std::clamp(fraction, 1e-3, 1.0), 0.25);
  return std::max(recipe.sheet ? std::min(natural, general.elementMeters) : natural, narrowest);
}

namespace {

/// Puffs that still show what a genus is from far away.
int leastPuffs(const shape::Recipe& recipe) {
  switch (recipe.form) {
    case shape::Form::Heap:
      return 7;
    case shape::Form::Veil:
      return 3;
    case shape::Form::Tower:
      return 18;
    case shape::Form::File:
      return 40;
    case shape::Form::Cells:
    case shape::Form::Filaments:
      break;
  }
  return 7;
}

/// Clouds twice as wide as natural are told by six tenths of the puffs: half of what a budget lacks is saved
/// on either; narrower elements take fewer, too.
int puffsAt(const shape::Recipe& recipe, double enlargement, double detail) {
  const int fewest = fewestPuffs(recipe);
  return std::max(std::min(fewest, leastPuffs(recipe)),
                  static_cast<int>(detail * fewest * std::pow(enlargement, enlargement > 1 ? -0.7 : 1.0)));
}

/// What the clouds of a layer cover one by one: clouds by chance overlap, the more the higher the cover.
double coveredOneByOne(const field::Layer& layer, const shape::Recipe& recipe, double coveredSquareMeters) {
  if (recipe.sheet) return coveredSquareMeters;
  const double fraction = 0.95 * std::min(layer.fraction, 1.0f);
  return coveredSquareMeters * -std::log(1 - fraction) / std::max(fraction, 1e-6);
}

/// A layer, as far as it costs puffs.
struct Share {
  const shape::Recipe* recipe = nullptr;
  double depthMeters = 0, fraction = 0, coveredSquareMeters = 0, opticalDepth = 0;
  double parts = 1;  ///< puffs that come of one: dense ones are divided
  double wider = 1;  ///< what a separate cloud covers over its nominal footprint: its soft edges reach out
};

struct Demand {
  std::vector<Share> shares;
  std::array<double, base::kGenusCount> counted{};  ///< clouds that the source counts
};

/// What a generalisation takes; sets its puffs a cloud.
double puffsOf(Generalisation& general, const Demand& demand, const RecipeBook& recipes) {
  std::array<double, base::kGenusCount> covered{}, enlargement{};
  for (const Share& share : demand.shares) {
    const auto genus = static_cast<std::size_t>(share.recipe->genus);
    const double ratio = meanWidthMeters(general, *share.recipe, share.depthMeters, share.fraction) /
                         naturalWidthMeters(*share.recipe, share.depthMeters);
    covered[genus] += share.coveredSquareMeters;
    enlargement[genus] += share.coveredSquareMeters * std::log(ratio);
  }
  double puffs = 0;
  for (const base::Genus genus : base::allGenera()) {
    const auto g = static_cast<std::size_t>(genus);
    const double ratio = covered[g] > 0 ? std::exp(enlargement[g] / covered[g]) : 1;
    general.puffsPerCloud[g] = puffsAt(recipes.of(genus), ratio, general.detail);
    puffs += general.puffsPerCloud[g] * demand.counted[g];
  }
  for (const Share& share : demand.shares)
    puffs += share.parts * general.puffsPerCloud[static_cast<std::size_t>(share.recipe->genus)] *
             share.coveredSquareMeters /
             (share.wider *
              coveredSquareMeters(
                  *share.recipe, meanWidthMeters(general, *share.recipe, share.depthMeters, share.fraction)));
  return puffs;
}

MeasuredCloud measuredOf(ArchetypeKey key, const Share& share, const Generalisation& general,
                         const Options& options) {
  double parts = 0, wider = 0;
  for (key.variant = 0; key.variant < kVariants; ++key.variant) {
    const ArchetypeShape shape = shapeOf(key, options, general);
    parts += static_cast<double>(shape.cloud.puffs.size()) /
             general.puffsPerCloud[static_cast<std::size_t>(key.genus)] / kVariants;
    wider += (share.recipe->sheet ? 1
                                  : Footprint(shape.cloud.puffs, shape.widthMeters)
                                            .coveredAlone(share.opticalDepth, kCoveringOpticalDepth) /
                                        coveredSquareMeters(*share.recipe, 1)) /
             kVariants;
  }
  return {parts, wider};
}

/// What clouds of each share are drawn with and what they cover, genus by genus and class by class.
void measureClouds(const Generalisation& general, Demand& demand, const Options& options,
                   MeasuredClouds& measured) {
  std::map<ArchetypeKey, MeasuredCloud> known;
  for (Share& share : demand.shares) {
    const double width = meanWidthMeters(general, *share.recipe, share.depthMeters, share.fraction);
    field::Layer layer;
    layer.genus = share.recipe->genus;
    layer.liquidOpticalDepth = static_cast<float>(share.opticalDepth);
    field::Cloud cloud;
    cloud.widthMeters = static_cast<float>(width), cloud.depthMeters = static_cast<float>(share.depthMeters);
    cloud.opticalDepth = static_cast<float>(share.opticalDepth * coveredSquareMeters(*share.recipe, width) /
                                            shape::footprintSquareMeters(width));
    ArchetypeKey key = keyOf(layer, cloud, options);
    key.variant = 0;
    const auto [found, isNew] = known.try_emplace(key);
    if (isNew) {
      const int puffs = general.puffsPerCloud[static_cast<std::size_t>(key.genus)];
      const auto [before, isFirst] = measured.known.try_emplace({key, puffs, share.opticalDepth});
      if (isFirst) before->second = measuredOf(key, share, general, options);
      found->second = before->second;
    }
    share.parts = found->second.parts, share.wider = found->second.wider;
  }
}

/// The least of low..high, by geometric halving, from which on `enough` holds; it holds at high.
double bisected(double low, double high, const std::function<bool(double)>& enough) {
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

double enlargementOf(const Generalisation& general, std::span<const field::Layer> layers,
                     const Options& options) {
  double natural = 0, drawn = 0;
  for (const field::Layer& layer : layers) {
    const shape::Recipe& recipe = options.recipes.of(layer);
    const double width = meanWidthMeters(general, recipe, layer.depthMeters(), layer.fraction);
    natural += layer.fraction;
    drawn += layer.fraction * std::max(1.0, width / naturalWidthMeters(recipe, layer.depthMeters()));
  }
  return natural > 0 ? drawn / natural : 1;
}

Generalisation generalise(const field::Grid& grid, std::span<const field::Layer> layers,
                          const Options& options, const base::GeoBox& box, double maxPuffs,
                          MeasuredClouds& measured) {
  Generalisation out;
  Demand demand;
  double boxArea = 0, cellArea = 0;
  std::uint32_t last = grid.size();
  for (const field::Layer& layer : layers) {
    const shape::Recipe& recipe = options.recipes.of(layer);
    const double share = field::shareInside(grid, layer.cell, box),
                 area = field::cellAreaSquareMeters(grid, layer.cell);
    if (last != layer.cell) boxArea += share * area;
    last = layer.cell;
    cellArea = std::max(cellArea, area);
    if (layer.cloudCount > 0)
      demand.counted[static_cast<std::size_t>(layer.genus)] += share * layer.cloudCount;
    else
      demand.shares.push_back({&recipe, layer.depthMeters(), layer.fraction,
                               coveredOneByOne(layer, recipe, layer.fraction * share * area),
                               layer.opticalDepth()});
  }
  constexpr double kElementsAcross = 6, kResolving = 0.6;
  const double cellMeters = std::sqrt(cellArea);
  out.elementMeters = cellMeters / kElementsAcross;
  out.widestMeters = std::max(100.0, std::sqrt(boxArea) / 8);
  const auto puffsAs = [&](double narrowestMeters, double detail) {
    out.narrowestMeters = narrowestMeters, out.detail = detail;
    return puffsOf(out, demand, options.recipes);
  };
  // Clouds are made wider and simpler together as far as they still tell one cell from the next; then simpler
  // alone; and wider than cells only when they are as simple as they may be.
  const auto spend = [&] {
    const double resolving = std::min(kResolving * cellMeters, out.widestMeters);
    if (puffsAs(0, 1) <= maxPuffs) return;
    if (puffsAs(resolving, 1) <= maxPuffs) {
      puffsAs(bisected(10, resolving, [&](double width) { return puffsAs(width, 1) <= maxPuffs; }), 1);
    } else if (puffsAs(resolving, 0) <= maxPuffs) {
      puffsAs(resolving,
              1 - bisected(1e-3, 1, [&](double lost) { return puffsAs(resolving, 1 - lost) <= maxPuffs; }));
    } else {
      // Where clouds as wide as they may be still take more than the budget, they need not be wider than that
      // takes.
      const double budget = std::max(maxPuffs, 1.001 * puffsAs(out.widestMeters, 0));
      puffsAs(
          bisected(resolving, out.widestMeters, [&](double width) { return puffsAs(width, 0) <= budget; }),
          0);
    }
  };
  spend();
  measureClouds(out, demand, options, measured);
  spend();
  // What the budget leaves over makes clouds richer.
  const double richness =
      std::clamp(maxPuffs / std::max(puffsAs(out.narrowestMeters, out.detail), 1.0), 1.0, 400.0);
  for (int& count : out.puffsPerCloud) count = static_cast<int>(count * richness);
  return out;
}

}  // namespace cloudgen::pipeline
