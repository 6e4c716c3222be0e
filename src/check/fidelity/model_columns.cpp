// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/model_columns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "check/fidelity/height_profile.hpp"
#include "field/collect.hpp"
#include "field/overlap.hpp"

namespace cloudgen::check {
namespace {

/// A part of a layer with its share of the layer's grid-mean optical depth.
struct Slice {
  double baseMeters = 0, topMeters = 0, opticalDepth = 0;
};

struct ModelLayer {
  double baseMeters = 0, topMeters = 0, cover = 0;
  double opticalDepth = 0;  ///< grid mean: times the cover
  std::vector<Slice> slices;

  bool isCloud() const { return cover > 0 && opticalDepth >= kCloudyOpticalDepth * cover; }
  int range() const { return baseMeters < kRangeBorders[0] ? 0 : baseMeters < kRangeBorders[1] ? 1 : 2; }
};

using LayersOfCell = std::map<std::uint32_t, std::vector<ModelLayer>>;

double waterOf(const field::CloudCell& cell) {
  return static_cast<double>(cell.fraction) * (cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter);
}

/// The level of least water between two of ten times as much, if the run has one; else its end.
std::size_t endOfLayer(std::span<const field::CloudCell> run) {
  double thickest = waterOf(run.front());
  for (std::size_t i = 1; i < run.size(); ++i) {
    double above = 0;
    for (const field::CloudCell& cell : run.subspan(i)) above = std::max(above, waterOf(cell));
    if (waterOf(run[i - 1]) < 0.1 * thickest && waterOf(run[i - 1]) < 0.1 * above) return i;
    thickest = std::max(thickest, waterOf(run[i]));
  }
  return run.size();
}

ModelLayer layerOf(std::span<const field::CloudCell> cells) {
  ModelLayer layer{cells.front().baseMeters, cells.back().topMeters, 0, 0, {}};
  for (const field::CloudCell& cell : cells) {
    const double depth = waterOf(cell) * (cell.topMeters - cell.baseMeters);
    layer.cover = std::max(layer.cover, static_cast<double>(cell.fraction));
    layer.opticalDepth += depth;
    layer.slices.push_back({cell.baseMeters, cell.topMeters, depth});
  }
  return layer;
}

LayersOfCell layersFromLevels(const field::CloudColumns& columns) {
  LayersOfCell layers;
  for (std::size_t c = 0; c < columns.columns.size(); ++c) {
    const std::span<const field::CloudCell> all(columns.cells.data() + columns.start[c],
                                                columns.start[c + 1] - columns.start[c]);
    for (std::size_t first = 0; first < all.size();) {
      std::size_t end = first + 1;
      while (end < all.size() && all[end].level == all[end - 1].level + 1) ++end;
      end = first + endOfLayer(all.subspan(first, end - first));
      layers[columns.columns[c]].push_back(layerOf(all.subspan(first, end - first)));
      first = end;
    }
  }
  return layers;
}

LayersOfCell layersAsStated(const field::Source& source, std::span<const std::uint32_t> cells) {
  LayersOfCell layers;
  source.visitLayers(cells, [&](const field::StatedLayer& stated) {
    const double mean = static_cast<double>(stated.coverFraction) * stated.opticalDepth;
    layers[stated.cell].push_back({stated.baseMeters,
                                   stated.topMeters,
                                   stated.coverFraction,
                                   mean,
                                   {{stated.baseMeters, stated.topMeters, mean}}});
  });
  return layers;
}

/// Between the clouds of two neighbouring ranges, half-way; above or below all of one that has no
/// neighbour, in some distance.
double borderBetween(const std::vector<ModelLayer>& layers, int lower) {
  constexpr double kDistance = 500;
  double top = -1e9, base = 1e9;
  for (const ModelLayer& layer : layers) {
    if (!layer.isCloud()) continue;
    if (layer.range() <= lower)
      top = std::max(top, layer.topMeters);
    else
      base = std::min(base, layer.baseMeters);
  }
  const double usual = kRangeBorders[static_cast<std::size_t>(lower)];
  if (top > -1e9 && base < 1e9) return 0.5 * (top + base);
  if (top > -1e9) return std::max(usual, top + kDistance);
  return base < 1e9 ? std::min(usual, base - kDistance) : usual;
}

double levelThickness(const std::vector<ModelLayer>& layers) {
  double sum = 0;
  int count = 0;
  for (const ModelLayer& layer : layers)
    for (const Slice* slice : {&layer.slices.front(), &layer.slices.back()})
      sum += slice->topMeters - slice->baseMeters, ++count;
  return count > 0 ? sum / count : 0;
}

void describe(const std::vector<ModelLayer>& layers, ModelColumn& column) {
  constexpr double kGround = -500, kSpace = 22000;
  HeightProfile profile;
  std::vector<field::CoverLayer> all;
  std::array<std::vector<field::CoverLayer>, kRanges> in;
  column.lowestRange = kRanges;
  column.highestRange = -1;
  for (const ModelLayer& layer : layers) {
    column.view.opticalDepth += layer.opticalDepth;
    if (!layer.isCloud()) continue;
    all.push_back({layer.cover, layer.baseMeters, layer.topMeters});
    in[static_cast<std::size_t>(layer.range())].push_back(all.back());
    column.lowestRange = std::min(column.lowestRange, layer.range());
    column.highestRange = std::max(column.highestRange, layer.range());
    for (const Slice& slice : layer.slices)
      profile.addUniform(slice.baseMeters, slice.topMeters, slice.opticalDepth);
  }
  column.view.cover = field::overlappedCover(all, column.latitudeDegrees);
  for (std::size_t range = 0; range < kRanges; ++range)
    column.view.coverIn[range] = field::overlappedCover(in[range], column.latitudeDegrees);
  column.borders = {borderBetween(layers, 0), borderBetween(layers, 1)};
  column.borders[1] = std::max(column.borders[0], column.borders[1]);
  if (column.highestRange < 0) {
    column.lowestRange = column.highestRange = 0;
    return;
  }
  const std::array<double, 4> edges{kGround, column.borders[0], column.borders[1], kSpace};
  const auto lowest = static_cast<std::size_t>(column.lowestRange),
             highest = static_cast<std::size_t>(column.highestRange);
  column.view.baseMeters = profile.heightAt(kBorderShare, edges[lowest], edges[lowest + 1]);
  column.view.topMeters = profile.heightAt(1 - kBorderShare, edges[highest], edges[highest + 1]);
}

}  // namespace

std::vector<ModelColumn> modelColumns(const field::Source& source, const base::GeoBox& box) {
  const std::vector<std::uint32_t> cells = field::cellsTouching(source.grid(), box);
  const bool stated = source.telling() == field::Telling::Layers;
  const LayersOfCell layers =
      stated ? layersAsStated(source, cells) : layersFromLevels(field::collectColumns(source, cells));
  std::vector<ModelColumn> columns;
  columns.reserve(cells.size());
  for (const std::uint32_t cell : cells) {
    ModelColumn column;
    column.cell = cell;
    const field::GeoPoint center = field::centerOf(source.grid(), cell);
    column.longitudeDegrees = center.longitudeDegrees;
    column.latitudeDegrees = center.latitudeDegrees;
    column.shareInside = field::shareInside(source.grid(), cell, box);
    column.squareMeters = column.shareInside * field::cellAreaSquareMeters(source.grid(), cell);
    if (const auto found = layers.find(cell); found != layers.end()) {
      describe(found->second, column);
      if (!stated) column.levelMeters = levelThickness(found->second);
    }
    columns.push_back(column);
  }
  return columns;
}

}  // namespace cloudgen::check
