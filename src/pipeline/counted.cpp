// SPDX-License-Identifier: Apache-2.0
#include "pipeline/counted.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/archetype.hpp"
#include "pipeline/size.hpp"
#include "pipeline/structure.hpp"

namespace cloudgen::pipeline {
namespace {

using field::Layer;

struct Candidate {
  field::GeoPoint place;
  double rank = 0;
  std::uint32_t number = 0;
};

/// Noise that knows no cells, for clouds of a width.
Structure structureFor(double widthMeters, const Layer& layer, std::uint64_t seed) {
  return {6 * widthMeters, 0.75 * widthMeters, seed * 41 + static_cast<std::uint64_t>(layer.genus)};
}

/// How strongly separate clouds follow the unevenness: places thrown for one that is taken, and how much
/// chance softens their rank.
struct Clustering {
  int places = 2;
  double chance = 1;
};

/// More places by chance than clouds; those where the unevenness is highest (softened by chance) are taken.
std::vector<Candidate> scattered(const field::Grid& grid, const Layer& layer, int count, double widthMeters,
                                 std::uint64_t seed, const Clustering& clustering = {}) {
  const Structure structure = structureFor(4 * widthMeters, layer, seed);
  std::vector<Candidate> candidates;
  for (int i = 0; i < clustering.places * count; ++i) {
    base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace,
                              itemOf(layer, static_cast<std::uint32_t>(i) + 1));
    Candidate candidate;
    const double u = stream.uniform(), v = stream.uniform();
    candidate.place = field::pointIn(grid, layer.cell, u, v);
    candidate.rank = structure.at(candidate.place) + clustering.chance * stream.gaussian();
    candidate.number = static_cast<std::uint32_t>(i);
    candidates.push_back(candidate);
  }
  return candidates;
}

/// Places by chance that keep `spacingMeters` from each other (dart throwing), as many of `count` as 100
/// throws a cloud find room for.
std::vector<Candidate> spaced(const field::Grid& grid, const Layer& layer, int count, double spacingMeters,
                              std::uint64_t seed) {
  const glm::dvec2 sides = field::cellSidesMeters(grid, layer.cell);
  std::vector<Candidate> candidates;
  std::vector<glm::dvec2> taken;
  for (int i = 0; i < 100 * count && static_cast<int>(candidates.size()) < count; ++i) {
    base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace,
                              itemOf(layer, static_cast<std::uint32_t>(i) + 1));
    const double u = stream.uniform(), v = stream.uniform();
    const glm::dvec2 place(u * sides.x, v * sides.y);
    const auto tooNear = [&](const glm::dvec2& other) {
      return std::hypot(place.x - other.x, place.y - other.y) < spacingMeters;
    };
    if (std::any_of(taken.begin(), taken.end(), tooNear)) continue;
    taken.push_back(place);
    candidates.push_back({field::pointIn(grid, layer.cell, u, v), 0, static_cast<std::uint32_t>(i)});
  }
  return candidates;
}

/// A jittered lattice of exactly count / fraction places: rows may differ by one place.
std::vector<Candidate> exactLattice(const field::Grid& grid, const Layer& layer, double widthMeters,
                                    std::uint64_t seed) {
  const glm::dvec2 sides = field::cellSidesMeters(grid, layer.cell);
  const auto places =
      std::max<long>(layer.cloudCount, std::lround(layer.cloudCount / std::max(layer.fraction, 0.01f)));
  const double aspect = std::clamp(sides.x / sides.y, 0.05, 20.0);
  const auto rows = std::clamp<long>(std::lround(std::sqrt(static_cast<double>(places) / aspect)), 1, places);
  const Structure structure = structureFor(widthMeters, layer, seed);
  std::vector<Candidate> candidates;
  for (long row = 0; row < rows; ++row) {
    const long first = row * places / rows, end = (row + 1) * places / rows;
    for (long number = first; number < end; ++number) {
      base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace,
                                itemOf(layer, static_cast<std::uint32_t>(number) + 1));
      const double u = (static_cast<double>(number - first) + 0.5 + 0.55 * (stream.uniform() - 0.5)) /
                       static_cast<double>(end - first),
                   v = (static_cast<double>(row) + 0.5 + 0.55 * (stream.uniform() - 0.5)) /
                       static_cast<double>(rows);
      Candidate candidate{field::pointIn(grid, layer.cell, u, v), 0, static_cast<std::uint32_t>(number)};
      candidate.rank = structure.at(candidate.place) + 0.1 * stream.gaussian();
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

/// Keeps the `count` candidates of the highest rank, in the order of their numbers.
void keepHighest(std::vector<Candidate>& candidates, size_t count) {
  if (candidates.size() <= count) return;
  const auto higher = [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank > b.rank : a.number < b.number;
  };
  std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
                   candidates.end(), higher);
  candidates.resize(count);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.number < b.number; });
}

/// The places of a layer whose source counts its clouds. Without a least distance separate clouds stand in
/// clusters a few widths across.
std::vector<Candidate> countedPlaces(const field::Grid& grid, const Layer& layer, const shape::Recipe& recipe,
                                     double area, std::uint64_t seed) {
  const double width = countedWidthMeters(recipe, area / layer.cloudCount);
  std::vector<Candidate> candidates;
  if (recipe.sheet)
    candidates = exactLattice(grid, layer, width, seed);
  else if (layer.spacingMeters > 0)
    candidates = spaced(grid, layer, layer.cloudCount, layer.spacingMeters, seed);
  else
    candidates = scattered(grid, layer, layer.cloudCount, 0.4 * width, seed, {4, 0.2});
  keepHighest(candidates, static_cast<std::size_t>(layer.cloudCount));
  return candidates;
}

}  // namespace

std::vector<field::Cloud> countedClouds(const field::Grid& grid, const Options& options, const Layer& layer,
                                        std::uint32_t index) {
  const shape::Recipe& recipe = options.recipes.of(layer);
  const double area = layer.fraction * field::cellAreaSquareMeters(grid, layer.cell);
  const std::vector<Candidate> places = countedPlaces(grid, layer, recipe, area, options.seed);
  const double covers = area / static_cast<double>(std::max<std::size_t>(places.size(), 1));
  const double meanWidth = countedWidthMeters(recipe, covers);
  std::vector<field::Cloud> clouds;
  double footprints = 0;
  for (const Candidate& candidate : places) {
    const CloudSize size = sizeOf(layer, candidate.number, layer.depthMeters(), meanWidth, options);
    field::Cloud cloud;
    cloud.layer = index;
    cloud.ordinal = candidate.number;
    cloud.longitudeDegrees = candidate.place.longitudeDegrees;
    cloud.latitudeDegrees = candidate.place.latitudeDegrees;
    cloud.widthMeters = static_cast<float>(size.widthMeters);
    cloud.depthMeters = static_cast<float>(size.depthMeters);
    cloud.baseMeters = layer.baseMeters;
    footprints += shape::footprintSquareMeters(cloud.widthMeters);
    clouds.push_back(cloud);
  }
  for (field::Cloud& cloud : clouds)
    cloud.opticalDepth = static_cast<float>(layer.opticalDepth() * area / footprints);
  return clouds;
}

}  // namespace cloudgen::pipeline
