// SPDX-License-Identifier: Apache-2.0
#include "pipeline/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cloudgen::pipeline {
namespace {

using field::Layer;

/// How far two layers are the same one, 0..1.
float togetherness(const Layer& a, const Layer& b) {
  const float thinner = std::min(a.depthMeters(), b.depthMeters());
  return thinner > 0 ? std::clamp(field::overlapMeters(a, b) / thinner, 0.0f, 1.0f) : 0.0f;
}

/// Layers and what goes on from them: layer i counts itself and others by links[start[i]] up to
/// links[start[i + 1]].
class Neighbourhood {
 public:
  Neighbourhood(const field::Grid& grid, const std::vector<Layer>& layers,
                const std::vector<Surroundings>& surroundings) {
    std::vector<std::uint32_t> byCell(layers.size());
    std::iota(byCell.begin(), byCell.end(), 0u);
    std::stable_sort(byCell.begin(), byCell.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return layers[a].cell < layers[b].cell; });
    const auto firstOf = [&](std::uint32_t cell) {
      return std::partition_point(byCell.begin(), byCell.end(),
                                  [&](std::uint32_t i) { return layers[i].cell < cell; });
    };
    for (std::uint32_t i = 0; i < layers.size(); ++i) {
      start_.push_back(links_.size());
      // Stations and the like have cells without area: they stand alone.
      links_.push_back({i, std::max(surroundings[i].cellSquareKilometers, 1e-6f)});
      for (const std::uint32_t cell : field::neighbours(grid, layers[i].cell))
        for (auto k = firstOf(cell); k != byCell.end() && layers[*k].cell == cell; ++k) {
          const float weight = togetherness(layers[i], layers[*k]) * surroundings[*k].cellSquareKilometers;
          if (weight > 0) links_.push_back({*k, weight});
        }
    }
    start_.push_back(links_.size());
  }

  /// Means over each layer and what goes on from it, of those values that are known.
  std::vector<float> averaged(const std::vector<float>& values) const {
    std::vector<float> means;
    for (std::size_t i = 0; i + 1 < start_.size(); ++i) {
      double sum = 0, weights = 0;
      for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
        const float value = values[links_[k].layer];
        if (!std::isfinite(value)) continue;
        sum += double{links_[k].weight} * value;
        weights += links_[k].weight;
      }
      means.push_back(weights > 0 ? static_cast<float>(sum / weights)
                                  : std::numeric_limits<float>::quiet_NaN());
    }
    return means;
  }

 private:
  struct Link {
    std::uint32_t layer;
    float weight;
  };
  std::vector<std::size_t> start_;
  std::vector<Link> links_;
};

std::vector<Surroundings> placesOf(const field::Grid& grid, const std::vector<Layer>& layers) {
  std::vector<Surroundings> all(layers.size());
  std::vector<double> patchArea;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const field::GeoPoint center = field::centerOf(grid, layers[i].cell);
    const double area = 1e-6 * field::cellAreaSquareMeters(grid, layers[i].cell);
    all[i].longitudeDegrees = center.longitudeDegrees;
    all[i].latitudeDegrees = center.latitudeDegrees;
    all[i].cellSquareKilometers = static_cast<float>(area);
    if (patchArea.size() <= layers[i].patch) patchArea.resize(layers[i].patch + 1, 0.0);
    patchArea[layers[i].patch] += layers[i].fraction * area;
  }
  for (std::size_t i = 0; i < layers.size(); ++i)
    all[i].patchSquareKilometers = static_cast<float>(patchArea[layers[i].patch]);
  return all;
}

}  // namespace

std::vector<Surroundings> surroundingsOf(const field::Grid& grid, const std::vector<Layer>& layers) {
  std::vector<Surroundings> all = placesOf(grid, layers);
  const Neighbourhood neighbourhood(grid, layers, all);
  const auto around = [&](auto valueOf, float Surroundings::*mean) {
    std::vector<float> values;
    for (const Layer& layer : layers) values.push_back(valueOf(layer));
    values = neighbourhood.averaged(neighbourhood.averaged(values));
    for (std::size_t i = 0; i < all.size(); ++i) all[i].*mean = values[i];
  };
  around([](const Layer& layer) { return layer.fraction; }, &Surroundings::coverAround);
  around([](const Layer& layer) { return layer.opticalDepth(); }, &Surroundings::opticalDepthAround);
  around([](const Layer& layer) { return layer.kIndexC; }, &Surroundings::kIndexAroundC);
  return all;
}

}  // namespace cloudgen::pipeline
