// SPDX-License-Identifier: Apache-2.0
#include "pipeline/location.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace cloudgen::pipeline {
namespace {

using field::CloudCell;
using field::Layer;

float gridMeanExtinction(const CloudCell& cell) {
  return cell.fraction * (cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter);
}

/// True if a new layer starts at cells[i]: a gap below it, or a waist between two thicker parts.
bool startsLayer(std::span<const CloudCell> cells, size_t i, float thickestBelow) {
  if (cells[i].level != cells[i - 1].level + 1) return true;
  const float here = gridMeanExtinction(cells[i - 1]);
  float above = 0;
  for (size_t k = i; k < cells.size() && cells[k].level == cells[k - 1].level + 1; ++k)
    above = std::max(above, gridMeanExtinction(cells[k]));
  return here < 0.1f * thickestBelow && here < 0.1f * above;
}

/// The height below which a share of the optical depth lies.
float heightOfShare(std::span<const CloudCell> cells, double share) {
  double owed = 0;
  for (const CloudCell& part : cells)
    owed += share * gridMeanExtinction(part) * (part.topMeters - part.baseMeters);
  for (const CloudCell& part : cells) {
    const double here = gridMeanExtinction(part) * (part.topMeters - part.baseMeters);
    if (owed <= here && here > 0)
      return static_cast<float>(part.baseMeters + owed / here * (part.topMeters - part.baseMeters));
    owed -= here;
  }
  return cells.back().topMeters;
}

Layer layerOf(std::span<const CloudCell> cells, const field::ColumnState& state, std::uint32_t cell,
              std::uint16_t ordinal) {
  Layer layer;
  layer.cell = cell;
  layer.ordinal = ordinal;
  layer.baseMeters = cells.front().baseMeters;
  layer.topMeters = cells.back().topMeters;
  layer.lowerMeters = heightOfShare(cells, field::kBorderShare);
  layer.upperMeters = heightOfShare(cells, 1 - field::kBorderShare);
  layer.middleMeters = heightOfShare(cells, 0.5);
  layer.surfaceMeters = state.surfaceHeightMeters;
  layer.baseTemperatureK = cells.front().temperatureK;
  layer.topTemperatureK = cells.back().temperatureK;
  layer.topPressurePa = cells.back().pressurePa;
  layer.kIndexC = state.kIndexC;
  float weight = 0;
  for (const CloudCell& part : cells) {
    layer.fraction = std::max(layer.fraction, part.fraction);
    const float depth = part.topMeters - part.baseMeters;
    layer.liquidOpticalDepth += part.fraction * part.liquidExtinctionPerMeter * depth;
    layer.iceOpticalDepth += part.fraction * part.iceExtinctionPerMeter * depth;
    layer.windEast += depth * part.windEast;
    layer.windNorth += depth * part.windNorth;
    weight += depth;
  }
  layer.liquidOpticalDepth /= layer.fraction;
  layer.iceOpticalDepth /= layer.fraction;
  layer.windEast /= weight;
  layer.windNorth /= weight;
  layer.shearEast = cells.back().windEast - cells.front().windEast;
  layer.shearNorth = cells.back().windNorth - cells.front().windNorth;
  return layer;
}

/// Disjoint sets with path halving.
struct Sets {
  std::vector<std::uint32_t> parent;
  explicit Sets(size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
};

}  // namespace

std::vector<Layer> locateLayers(const field::CloudColumns& columns) {
  constexpr float kLeastOpticalDepth = 0.03f;  // subvisible below (Sassen et al. 1989)
  std::vector<Layer> layers;
  for (size_t c = 0; c < columns.columns.size(); ++c) {
    const std::span<const CloudCell> all(columns.cells.data() + columns.start[c],
                                         columns.start[c + 1] - columns.start[c]);
    std::uint16_t ordinal = 0;
    for (size_t first = 0; first < all.size();) {
      size_t end = first + 1;
      float thickest = gridMeanExtinction(all[first]);
      while (end < all.size() && !startsLayer(all, end, thickest))
        thickest = std::max(thickest, gridMeanExtinction(all[end++]));
      const Layer layer =
          layerOf(all.subspan(first, end - first), columns.states[c], columns.columns[c], ordinal++);
      if (layer.opticalDepth() >= kLeastOpticalDepth) layers.push_back(layer);
      first = end;
    }
  }
  return layers;
}

Layer layerFrom(const field::StatedLayer& stated, std::uint16_t ordinal) {
  Layer layer;
  layer.cell = stated.cell;
  layer.ordinal = ordinal;
  layer.spreadEvenly(stated.baseMeters, stated.topMeters);
  layer.fraction = stated.coverFraction;
  layer.liquidOpticalDepth = (1 - stated.iceShare) * stated.opticalDepth;
  layer.iceOpticalDepth = stated.iceShare * stated.opticalDepth;
  layer.windEast = stated.windEast;
  layer.windNorth = stated.windNorth;
  layer.shearEast = stated.shearEast;
  layer.shearNorth = stated.shearNorth;
  layer.cloudCount = stated.cloudCount;
  layer.spacingMeters = stated.spacingMeters;
  if (stated.genus) {
    layer.genus = *stated.genus;
    layer.rule = "stated";
  }
  return layer;
}

std::vector<Layer> locateLayers(const field::Source& source, std::span<const std::uint32_t> cells) {
  const std::vector<float> surface = source.surface(cells).heightMeters;
  std::vector<Layer> layers;
  std::size_t column = 0;
  source.visitLayers(cells, [&](const field::StatedLayer& stated) {
    while (cells[column] != stated.cell) ++column;
    const bool another = !layers.empty() && layers.back().cell == stated.cell;
    const auto ordinal = static_cast<std::uint16_t>(another ? layers.back().ordinal + 1 : 0);
    layers.push_back(layerFrom(stated, ordinal));
    if (!surface.empty()) layers.back().surfaceMeters = surface[column];
  });
  return layers;
}

std::uint32_t joinPatches(const field::Grid& grid, std::vector<Layer>& layers) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> byCell;
  for (std::uint32_t i = 0; i < layers.size(); ++i) byCell[layers[i].cell].push_back(i);
  Sets sets(layers.size());
  for (const auto& [cell, here] : byCell)
    for (const std::uint32_t next : field::neighbours(grid, cell)) {
      if (next < cell) continue;  // seen from there
      const auto found = byCell.find(next);
      if (found == byCell.end()) continue;
      for (const std::uint32_t a : here)
        for (const std::uint32_t b : found->second)
          if (field::overlapMeters(layers[a], layers[b]) >
              0.5f * std::min(layers[a].depthMeters(), layers[b].depthMeters()))
            sets.join(a, b);
    }
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < layers.size(); ++i)
    layers[i].patch =
        numbers.try_emplace(sets.root(i), static_cast<std::uint32_t>(numbers.size())).first->second;
  return static_cast<std::uint32_t>(numbers.size());
}

}  // namespace cloudgen::pipeline
