// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/noise.hpp"

namespace cloudgen::pipeline {
namespace {

using field::Layer;

constexpr double kEarthRadiusMeters = 6371000.0;

/// Unevenness of cover that knows no cells: noise on the sphere, about eight cloud widths across.
double unevenness(const field::GeoPoint& place, double widthMeters, const Layer& layer, std::uint64_t seed) {
  const double lon = place.longitudeDegrees * std::numbers::pi / 180.0,
               lat = place.latitudeDegrees * std::numbers::pi / 180.0;
  const double scale = kEarthRadiusMeters / (6.0 * widthMeters);
  const glm::dvec3 point(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  return base::fractalNoise(point * scale, 4, seed * 1000003u + static_cast<std::uint64_t>(layer.genus));
}

std::uint64_t layerItem(const Layer& layer, std::uint64_t number) {
  return (static_cast<std::uint64_t>(layer.ordinal) << 40) | number;
}

/// The number of clouds whose expectation is `expected`, rounded up or down by the cell's own chance.
int wholeCount(double expected, std::uint64_t seed, const Layer& layer) {
  base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace, layerItem(layer, 0));
  return static_cast<int>(std::floor(expected + stream.uniform()));
}

struct Candidate {
  field::GeoPoint place;
  double rank = 0;
  std::uint32_t number = 0;
};

/// How strongly separate clouds follow the unevenness: places thrown for one that is taken, and how much
/// chance softens their rank.
struct Clustering {
  int places = 2;
  double chance = 0.25;
};

/// More places by chance than clouds; those where the unevenness is highest (softened by chance) are taken.
std::vector<Candidate> scattered(const field::Grid& grid, const Layer& layer, int count, double widthMeters,
                                 std::uint64_t seed, const Clustering& clustering = {}) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < clustering.places * count; ++i) {
    base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace,
                              layerItem(layer, static_cast<std::uint64_t>(i) + 1));
    Candidate candidate;
    const double u = stream.uniform(), v = stream.uniform();
    candidate.place = field::pointIn(grid, layer.cell, u, v);
    candidate.rank =
        unevenness(candidate.place, 4 * widthMeters, layer, seed) + clustering.chance * stream.gaussian();
    candidate.number = static_cast<std::uint32_t>(i);
    candidates.push_back(candidate);
  }
  return candidates;
}

/// A jittered lattice of about `count` / fraction places.
std::vector<Candidate> lattice(const field::Grid& grid, const Layer& layer, double count, double widthMeters,
                               std::uint64_t seed) {
  const double places = std::max(1.0, count / layer.fraction);
  const glm::dvec2 sides = field::cellSidesMeters(grid, layer.cell);
  const double aspect = std::max(0.05, sides.x / sides.y);
  const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(places * aspect))));
  const int rows = std::max(1, static_cast<int>(std::lround(places / columns)));
  std::vector<Candidate> candidates;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto number = static_cast<std::uint32_t>(row * columns + column);
      base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace, layerItem(layer, number + 1ull));
      Candidate candidate;
      const double u = (column + 0.5 + 0.55 * (stream.uniform() - 0.5)) / columns,
                   v = (row + 0.5 + 0.55 * (stream.uniform() - 0.5)) / rows;
      candidate.place = field::pointIn(grid, layer.cell, u, v);
      candidate.rank = unevenness(candidate.place, widthMeters, layer, seed) + 0.03 * stream.gaussian();
      candidate.number = number;
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
                              layerItem(layer, static_cast<std::uint64_t>(i) + 1));
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
  std::vector<Candidate> candidates;
  for (long row = 0; row < rows; ++row) {
    const long first = row * places / rows, end = (row + 1) * places / rows;
    for (long number = first; number < end; ++number) {
      base::RandomStream stream(seed, layer.cell, base::Purpose::CloudPlace,
                                layerItem(layer, static_cast<std::uint64_t>(number) + 1));
      const double u = (static_cast<double>(number - first) + 0.5 + 0.55 * (stream.uniform() - 0.5)) /
                       static_cast<double>(end - first),
                   v = (static_cast<double>(row) + 0.5 + 0.55 * (stream.uniform() - 0.5)) /
                       static_cast<double>(rows);
      Candidate candidate{field::pointIn(grid, layer.cell, u, v), 0, static_cast<std::uint32_t>(number)};
      candidate.rank = unevenness(candidate.place, widthMeters, layer, seed) + 0.03 * stream.gaussian();
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
    candidates = scattered(grid, layer, layer.cloudCount, 0.4 * width, seed, {4, 0.05});
  keepHighest(candidates, static_cast<std::size_t>(layer.cloudCount));
  return candidates;
}

}  // namespace

void placeClouds(const field::Grid& grid, const Options& options, const Generalisation& general,
                 const base::GeoBox& box, field::CloudTable& table) {
  for (std::uint32_t index = 0; index < table.layers.size(); ++index) {
    const Layer& layer = table.layers[index];
    const shape::Recipe& recipe = options.recipes.of(layer.genus);
    const double width = meanWidthMeters(general, recipe, layer.depthMeters());
    const double area = layer.fraction * field::cellAreaSquareMeters(grid, layer.cell);
    const double expected = area / coveredSquareMeters(recipe, width);
    std::vector<Candidate> candidates;
    // What one cloud must cover so that all of them cover fraction times area; where a cell has a cloud only
    // now and then, those of many cells do.
    double covers = 0;
    if (layer.cloudCount > 0) {
      candidates = countedPlaces(grid, layer, recipe, area, options.seed);
      covers = area / static_cast<double>(std::max<std::size_t>(candidates.size(), 1));
    } else {
      double mean = expected;
      if (recipe.sheet) {
        candidates = lattice(grid, layer, expected, width, options.seed);
        mean = layer.fraction * static_cast<double>(candidates.size());
      }
      const int count = wholeCount(mean, options.seed, layer);
      if (!recipe.sheet) candidates = scattered(grid, layer, count, width, options.seed);
      keepHighest(candidates, static_cast<size_t>(count));
      covers = mean < 1 ? area / mean : area / count;
    }
    for (const Candidate& candidate : candidates) {
      if (!box.contains(candidate.place.longitudeDegrees, candidate.place.latitudeDegrees)) continue;
      field::Cloud cloud;
      cloud.layer = index;
      cloud.ordinal = candidate.number;
      cloud.longitudeDegrees = candidate.place.longitudeDegrees;
      cloud.latitudeDegrees = candidate.place.latitudeDegrees;
      cloud.coversSquareMeters = covers;
      table.clouds.push_back(cloud);
    }
  }
}

}  // namespace cloudgen::pipeline
