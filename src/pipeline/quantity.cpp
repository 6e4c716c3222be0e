// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "pipeline/archetype.hpp"
#include "pipeline/budget_search.hpp"
#include "pipeline/counted.hpp"
#include "pipeline/fitting.hpp"
#include "pipeline/measured_clouds.hpp"
#include "shape/generate.hpp"

namespace cloudgen::pipeline {
namespace {

field::Cloud cloudOf(const FittedCloud& fitted) {
  field::Cloud cloud;
  cloud.layer = fitted.layer;
  cloud.ordinal = fitted.candidate.number;
  cloud.longitudeDegrees = fitted.candidate.place.longitudeDegrees;
  cloud.latitudeDegrees = fitted.candidate.place.latitudeDegrees;
  cloud.widthMeters = static_cast<float>(fitted.widthMeters);
  cloud.baseMeters = fitted.candidate.baseMeters;
  cloud.depthMeters = static_cast<float>(fitted.depthMeters);
  cloud.opticalDepth =
      static_cast<float>(fitted.extinctionArea / shape::footprintSquareMeters(fitted.widthMeters));
  return cloud;
}

/// Counts what is drawn; the puffs of an archetype are counted once.
class PuffCount {
 public:
  PuffCount(const Options& options, const Generalisation& general) : options_(options), general_(general) {}

  /// Of all clouds of a table in full.
  double of(const field::CloudTable& table) {
    double puffs = 0;
    for (const field::Cloud& cloud : table.clouds) {
      const ArchetypeKey key = shapeKeyOf(keyOf(table.layers[cloud.layer], cloud, options_));
      const auto [found, isNew] = known_.try_emplace(key);
      if (isNew) found->second = static_cast<double>(shapeOf(key, options_, general_).cloud.puffs.size());
      puffs += found->second;
    }
    return puffs;
  }

 private:
  const Options& options_;
  const Generalisation& general_;
  std::map<ArchetypeKey, double> known_;
};

/// What is known of archetypes as long as clouds are made of as many puffs.
struct KnownArchetypes {
  KnownArchetypes(const Options& options, const Generalisation& general)
      : footprints(options, general), puffs(options, general) {}

  FootprintBook footprints;
  PuffCount puffs;
};

/// Clouds made for some budget.
struct Attempt {
  DrawnShare drawn;
  Generalisation general;
  std::vector<field::Cloud> clouds;
};

}  // namespace

void placeClouds(const field::Grid& grid, const base::LocalFrame& frame, std::span<const std::uint32_t> cells,
                 const Options& options, const Generalisation& general, FootprintBook& footprints,
                 field::CloudTable& table) {
  std::vector<field::Layer> byCover;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < table.layers.size(); ++i) {
    if (table.layers[i].cloudCount == 0) {
      byCover.push_back(table.layers[i]);
      numbers.push_back(i);
      continue;
    }
    for (const field::Cloud& cloud : countedClouds(grid, options, table.layers[i], i))
      if (frame.box().contains(cloud.longitudeDegrees, cloud.latitudeDegrees)) table.clouds.push_back(cloud);
  }
  const LayersByCell layersByCell(grid, byCover);
  for (const FittedCloud& fitted :
       fitClouds({grid, frame, options, general, layersByCell}, cells, byCover, footprints)) {
    field::Cloud cloud = cloudOf(fitted);
    cloud.layer = numbers[cloud.layer];
    table.clouds.push_back(cloud);
  }
  std::sort(table.clouds.begin(), table.clouds.end(), [&](const field::Cloud& a, const field::Cloud& b) {
    const auto address = [&](const field::Cloud& cloud) {
      const field::Layer& layer = table.layers[cloud.layer];
      return std::tuple(layer.cell, layer.ordinal, cloud.ordinal);
    };
    return address(a) < address(b);
  });
}

double puffsDrawn(const field::CloudTable& table, const Options& options, const Generalisation& general) {
  return PuffCount(options, general).of(table);
}

Generalisation placeWithinBudget(const field::Grid& grid, const base::LocalFrame& frame,
                                 std::span<const std::uint32_t> cells, const Options& options,
                                 field::CloudTable& table) {
  constexpr int kAttempts = 7;
  const auto maxPuffs = static_cast<double>(options.maxPuffs);
  BudgetSearch search(maxPuffs);
  MeasuredClouds measured;
  Generalisation general;
  std::optional<KnownArchetypes> archetypes;
  Attempt latest, best;
  for (int attempt = 1;; ++attempt) {
    const Generalisation before = std::exchange(
        general, generalise(grid, table.layers, options, frame.box(), search.budget(), measured));
    if (attempt == 1 || before.puffsPerCloud != general.puffsPerCloud) archetypes.emplace(options, general);
    // Where a budget cannot be met the next one is answered alike.
    if (attempt == 1 || before != general) {
      table.clouds.clear();
      placeClouds(grid, frame, cells, options, general, archetypes->footprints, table);
      latest = {{archetypes->puffs.of(table) / maxPuffs}, general, table.clouds};
      if (attempt == 1 || latest.drawn.isNearerThan(best.drawn)) best = latest;
    }
    const bool asNatural = general.narrowestMeters <= 0 && general.detail >= 1,
               asSimple = general.narrowestMeters >= general.widestMeters && general.detail <= 0,
               isAtItsEnd = latest.drawn.isTooMany() ? asSimple : asNatural;
    if (attempt == kAttempts || table.clouds.empty() || latest.drawn.isNear() || isAtItsEnd) {
      table.clouds = std::move(best.clouds);
      return best.general;
    }
    search.drew(latest.drawn);
  }
}

}  // namespace cloudgen::pipeline
