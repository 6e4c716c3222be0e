// SPDX-License-Identifier: Apache-2.0
#include "pipeline/canvas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

namespace cloudgen::pipeline {
namespace {

constexpr double kMostPixels = 4e6, kMostValues = 2e7;
constexpr std::size_t kMostKept = std::size_t{1} << 22, kSamplesOfEntry = 8;  ///< tens of megabytes
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr float kCovering = static_cast<float>(kCoveringOpticalDepth);

glm::dvec3 onSphere(double longitudeDegrees, double latitudeDegrees) {
  const double lon = longitudeDegrees * kRadians, lat = latitudeDegrees * kRadians;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

/// Geographic places of a raster's pixels. A map projection is slow: every eighth pixel is asked for, and
/// those between lie between on the sphere.
class PixelPlaces {
 public:
  PixelPlaces(const base::LocalFrame& frame, const glm::dvec2& lower, double pixelMeters, int columns,
              int rows)
      : columns_((columns + kStep - 1) / kStep + 1) {
    const int nodeRows = (rows + kStep - 1) / kStep + 1;
    for (int row = 0; row < nodeRows; ++row)
      for (int column = 0; column < columns_; ++column) {
        const glm::dvec3 geo = frame.toGeographic(
            {lower.x + column * kStep * pixelMeters, 0, lower.y + row * kStep * pixelMeters});
        nodes_.push_back(std::isfinite(geo.x) && std::isfinite(geo.y) ? onSphere(geo.x, geo.y)
                                                                      : glm::dvec3(0));
      }
  }
  field::GeoPoint at(int column, int row) const {
    const int left = column / kStep, top = row / kStep;
    const double a = (column % kStep + 0.5) / kStep, b = (row % kStep + 0.5) / kStep;
    const auto node = [&](int i, int j) {
      return nodes_[static_cast<std::size_t>(top + j) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(left + i)];
    };
    const glm::dvec3 p =
        (1 - b) * ((1 - a) * node(0, 0) + a * node(1, 0)) + b * ((1 - a) * node(0, 1) + a * node(1, 1));
    return {std::atan2(p.y, p.x) / kRadians, std::atan2(p.z, std::hypot(p.x, p.y)) / kRadians};
  }

 private:
  static constexpr int kStep = 8;
  int columns_;
  std::vector<glm::dvec3> nodes_;
};

struct Span {
  double from = 0, to = 0;
};

/// Where slope t + start lies between two bounds.
Span lineWithin(double slope, double start, double lower, double upper) {
  constexpr double kFar = 1e9;
  if (std::abs(slope) < 1e-12) return start >= lower && start <= upper ? Span{-kFar, kFar} : Span{1, 0};
  const double a = (lower - start) / slope, b = (upper - start) / slope;
  return {std::min(a, b), std::max(a, b)};
}

Span both(const Span& a, const Span& b) { return {std::max(a.from, b.from), std::min(a.to, b.to)}; }

}  // namespace

Canvas::Canvas(const field::Grid& grid, const base::LocalFrame& frame, std::span<const std::uint32_t> cells,
               std::span<const field::Layer> layers, double pixelMeters)
    : lower_(frame.lowerCorner()) {
  for (const std::uint32_t cell : cells) cells_.push_back({cell});
  gatherLayers(layers);
  const glm::dvec2 size = glm::max(frame.upperCorner() - lower_, glm::dvec2(1));
  const double most = std::min(kMostPixels, kMostValues / static_cast<double>(planes_));
  pixelMeters_ = std::max(pixelMeters, std::sqrt(size.x * size.y / most));
  columns_ = static_cast<int>(size.x / pixelMeters_) + 1;
  rows_ = static_cast<int>(size.y / pixelMeters_) + 1;
  assignPixels(grid, frame);
  for (PaintedCell& cell : cells_)
    for (std::uint32_t i = cell.firstLayer; i < cell.firstLayer + cell.layerCount; ++i) {
      const field::Layer& layer = layers[layers_[i].layer];
      layers_[i].wantedCover = static_cast<double>(layer.fraction) * cell.pixels;
      layers_[i].wantedOpticalDepth = layers_[i].wantedCover * layer.opticalDepth();
      cell.wantedOpticalDepth += layers_[i].wantedOpticalDepth;
    }
  const std::size_t pixels = cellOf_.size();
  values_.assign(planes_ * pixels, 0);
  coveringPlanes_.assign(pixels, 0);
  touchedAs_.assign(cells_.size(), 0);
}

void Canvas::assignPixels(const field::Grid& grid, const base::LocalFrame& frame) {
  cellOf_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
  const PixelPlaces places(frame, lower_, pixelMeters_, columns_, rows_);
  const field::CellFinder finder(grid);
  std::size_t pixel = 0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column, ++pixel) {
      const field::GeoPoint place = places.at(column, row);
      if (!frame.box().contains(place.longitudeDegrees, place.latitudeDegrees)) continue;
      const auto cell = finder.at(place);
      if (!cell) continue;
      const std::uint32_t index = indexOf(*cell);
      if (index >= cells_.size() || cells_[index].cell != *cell) continue;
      cellOf_[pixel] = static_cast<std::int32_t>(index);
      ++cells_[index].pixels;
      cells_[index].middle += middleOf(static_cast<std::uint32_t>(pixel));
    }
  std::uint32_t first = 0;
  for (PaintedCell& one : cells_) {
    one.firstPixel = first;
    one.middle /= std::max(one.pixels, 1);
    first += static_cast<std::uint32_t>(one.pixels);
  }
  pixelsByCell_.resize(first);
  std::vector<std::uint32_t> next;
  for (const PaintedCell& one : cells_) next.push_back(one.firstPixel);
  for (std::uint32_t i = 0; i < cellOf_.size(); ++i)
    if (cellOf_[i] >= 0) pixelsByCell_[next[static_cast<std::size_t>(cellOf_[i])]++] = i;
}

void Canvas::gatherLayers(std::span<const field::Layer> layers) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < layers.size(); ++i) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(layers[a].cell, layers[a].lowerMeters, layers[a].ordinal) <
           std::tuple(layers[b].cell, layers[b].lowerMeters, layers[b].ordinal);
  });
  auto next = order.begin();
  for (PaintedCell& cell : cells_) {
    cell.firstLayer = static_cast<std::uint32_t>(layers_.size());
    while (next != order.end() && layers[*next].cell < cell.cell) ++next;
    for (; next != order.end() && layers[*next].cell == cell.cell; ++next) {
      const field::Layer& layer = layers[*next];
      layers_.push_back({.layer = *next,
                         .baseMeters = layer.lowerMeters,
                         .topMeters = layer.upperMeters,
                         .covers = layer.opticalDepth() >= kCovering});
      ++cell.layerCount;
    }
    layers_.emplace_back();
    divideHeights(cell);
    planes_ = std::max<std::size_t>(planes_, cell.layerCount + 1);
  }
}

std::uint32_t Canvas::indexOf(std::uint32_t cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell,
                                      [](const PaintedCell& a, std::uint32_t b) { return a.cell < b; });
  return static_cast<std::uint32_t>(found - cells_.begin());
}

void Canvas::divideHeights(const PaintedCell& cell) {
  constexpr float kDistanceMeters = 500;  // from a layer to what is astray, or half-way to the next
  const std::span<PaintedLayer> own(layers_.data() + cell.firstLayer, cell.layerCount);
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i].zoneLowerMeters = own[i].baseMeters - kDistanceMeters;
    own[i].zoneUpperMeters = own[i].topMeters + kDistanceMeters;
    if (i == 0) continue;
    const float between = 0.5f * (own[i - 1].topMeters + own[i].baseMeters);
    own[i - 1].zoneUpperMeters = std::min(own[i - 1].zoneUpperMeters, between);
    own[i].zoneLowerMeters = std::max(own[i].zoneLowerMeters, between);
  }
}

void Canvas::touch(std::uint32_t index, const Stamp& stamp, std::vector<Stroke::Touched>& touched) const {
  constexpr float kLeastPart = 0.1f;  // of a cloud: less at a layer's heights is not told from the rest
  const PaintedCell& cell = cells_[index];
  const std::size_t first = touched.size();
  const float depth = std::max(stamp.topMeters - stamp.baseMeters, 1.0f);
  float astray = 1;
  for (std::uint32_t i = cell.firstLayer; i < cell.firstLayer + cell.layerCount; ++i) {
    const float part = (std::min(layers_[i].zoneUpperMeters, stamp.topMeters) -
                        std::max(layers_[i].zoneLowerMeters, stamp.baseMeters)) /
                       depth;
    if (part < kLeastPart) continue;
    touched.push_back({index, i, 0, part, 0, 0, 0});
    astray -= part;
  }
  if (astray >= kLeastPart || touched.size() == first)
    touched.push_back({index, cell.firstLayer + cell.layerCount, 0, astray, 0, 0, 0});
  float whole = 0;
  for (std::size_t i = first; i < touched.size(); ++i) whole += touched[i].share;
  for (std::size_t i = first; i < touched.size(); ++i) touched[i].share /= whole;
}

void Canvas::sample(const Stamp& stamp) {
  samples_.clear();
  const glm::dvec2 at = (stamp.place - lower_) / pixelMeters_;
  const double reach = stamp.footprint->reach() * stamp.widthMeters / pixelMeters_;
  const double cosine = std::cos(stamp.yawRadians) * pixelMeters_ / stamp.widthMeters,
               sine = std::sin(stamp.yawRadians) * pixelMeters_ / stamp.widthMeters;
  double sum = 0;
  const auto add = [&](int column, int row, float value, const HeightMoments& heights) {
    sum += value;
    if (row >= 0 && row < rows_ && column >= 0 && column < columns_)
      samples_.push_back({static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) +
                              static_cast<std::uint32_t>(column),
                          value, heights});
  };
  const auto pixelBelow = [](double value) { return static_cast<int>(std::floor(value)); };
  const glm::dvec2 &lower = stamp.footprint->lower(), &upper = stamp.footprint->upper();
  for (int row = pixelBelow(at.y - reach); row <= pixelBelow(at.y + reach); ++row) {
    const double dz = row + 0.5 - at.y;
    const Span span = both(lineWithin(cosine, -sine * dz, lower.x, upper.x),
                           both(lineWithin(sine, cosine * dz, lower.y, upper.y), {-reach, reach}));
    if (!(span.from <= span.to)) continue;
    for (int column = pixelBelow(at.x + span.from); column <= pixelBelow(at.x + span.to); ++column) {
      const double dx = column + 0.5 - at.x;
      const double x = cosine * dx - sine * dz, z = sine * dx + cosine * dz;
      const float value = stamp.footprint->at(x, z);
      if (value != 0) add(column, row, value, stamp.footprint->heightsAt(x, z));
    }
  }
  // So small that it falls between the middles of pixels.
  if (sum == 0) add(pixelBelow(at.x), pixelBelow(at.y), 1, stamp.footprint->heightsAt(0, 0));
  for (Sample& one : samples_) one.share = static_cast<float>(one.share / sum);
}

std::size_t Canvas::HashOfLie::operator()(const Lie& lie) const {
  std::uint64_t hash = reinterpret_cast<std::uintptr_t>(lie.footprint);
  for (const double value : {lie.x, lie.z, lie.widthMeters, lie.yawRadians}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

std::span<const Canvas::Sample> Canvas::samplesOf(const Stamp& stamp) {
  const Lie lie{stamp.place.x, stamp.place.y, stamp.widthMeters, stamp.yawRadians, stamp.footprint};
  if (const auto found = keptOf_.find(lie); found != keptOf_.end())
    return std::span(kept_).subspan(found->second.first, found->second.count);
  sample(stamp);
  if (kept_.size() + samples_.size() + kSamplesOfEntry * keptOf_.size() <= kMostKept) {
    keptOf_.emplace(lie, Kept{kept_.size(), samples_.size()});
    kept_.insert(kept_.end(), samples_.begin(), samples_.end());
  }
  return samples_;
}

void Canvas::brush(const Stamp& stamp, float sign, Stroke& stroke) {
  stroke.genus = stamp.key.genus;
  stroke.baseMeters = stamp.baseMeters;
  stroke.widthMeters = stamp.widthMeters;
  stroke.dabs.clear();
  stroke.touched.clear();
  stroke.parts.clear();
  const double whole = sign * stamp.extinctionArea / pixelSquareMeters(),
               drawn = stamp.footprint->drawnShare();
  std::int32_t lastCell = -1;
  std::size_t first = 0;
  for (const auto& [pixel, share, heights] : samplesOf(stamp)) {
    const std::int32_t cell = cellOf_[pixel];
    if (cell < 0) continue;
    const double depth = whole * share;
    if (depth == 0) continue;
    const auto index = static_cast<std::uint32_t>(cell);
    if (cell != lastCell) {
      lastCell = cell;
      first = touchedAs_[index];
      if (first >= stroke.touched.size() || stroke.touched[first].cell != index) {
        first = touchedAs_[index] = static_cast<std::uint32_t>(stroke.touched.size());
        touch(index, stamp, stroke.touched);
        stroke.touched[first].part = static_cast<std::uint32_t>(stroke.parts.size());
        stroke.parts.push_back({index});
      }
    }
    Stroke::Part& part = stroke.parts[stroke.touched[first].part];
    part.opticalDepth += depth;
    part.mean += depth * heights.mean, part.square += depth * heights.square;
    int planesChange = 0;
    for (std::size_t i = first; i < stroke.touched.size() && stroke.touched[i].cell == index; ++i) {
      Stroke::Touched& change = stroke.touched[i];
      const std::size_t value = (change.layer - cells_[index].firstLayer) * cellOf_.size() + pixel;
      change.opticalDepth += change.share * depth;
      const auto dab = static_cast<float>(drawn * change.share * depth);
      const bool before = values_[value] > kCovering, after = values_[value] + dab > kCovering;
      if (before != after) {
        change.coveredChange += after ? 1 : -1;
        planesChange += after ? 1 : -1;
      }
      stroke.dabs.push_back({value, pixel, dab});
    }
    const int planes = coveringPlanes_[pixel];
    if (planes == 0 && planesChange > 0) ++stroke.touched[first].coveredByAnyChange;
    if (planes > 0 && planes + planesChange == 0) --stroke.touched[first].coveredByAnyChange;
  }
  for (Stroke::Part& part : stroke.parts) part.mean /= part.opticalDepth, part.square /= part.opticalDepth;
}

void Canvas::paint(const Stroke& stroke) {
  for (const Stroke::Dab& dab : stroke.dabs) {
    const bool before = values_[dab.value] > kCovering;
    values_[dab.value] += dab.opticalDepth;
    const bool after = values_[dab.value] > kCovering;
    if (before == after) continue;
    coveringPlanes_[dab.pixel] = static_cast<std::uint16_t>(coveringPlanes_[dab.pixel] + (after ? 1 : -1));
  }
  for (const Stroke::Touched& change : stroke.touched) {
    cells_[change.cell].covered += change.coveredByAnyChange;
    layers_[change.layer].covered += change.coveredChange;
    layers_[change.layer].opticalDepth += change.opticalDepth;
  }
}

void Canvas::clear() {
  std::fill(values_.begin(), values_.end(), 0.0f);
  std::fill(coveringPlanes_.begin(), coveringPlanes_.end(), std::uint16_t{0});
  for (PaintedCell& cell : cells_) cell.covered = 0;
  for (PaintedLayer& layer : layers_) layer.covered = 0, layer.opticalDepth = 0;
}

glm::dvec2 Canvas::middleOf(std::uint32_t pixel) const {
  const auto columns = static_cast<std::uint32_t>(columns_);
  return lower_ + pixelMeters_ * glm::dvec2(pixel % columns + 0.5, pixel / columns + 0.5);
}

std::vector<glm::dvec2> Canvas::placesIn(const PaintedCell& cell) const {
  std::vector<glm::dvec2> places;
  for (const std::uint32_t pixel : pixelsOf(cell)) places.push_back(middleOf(pixel));
  return places;
}

std::vector<glm::dvec2> Canvas::gapsOf(const PaintedCell& cell, const PaintedLayer& layer) const {
  const std::size_t plane =
      (static_cast<std::size_t>(&layer - layers_.data()) - cell.firstLayer) * cellOf_.size();
  std::vector<glm::dvec2> gaps;
  for (const std::uint32_t pixel : pixelsOf(cell))
    if (!(values_[plane + pixel] > kCovering)) gaps.push_back(middleOf(pixel));
  return gaps;
}

bool Canvas::coveredByOthers(const glm::dvec2& place, const PaintedLayer& layer) const {
  const glm::dvec2 at = (place - lower_) / pixelMeters_;
  const int column = std::clamp(static_cast<int>(at.x), 0, columns_ - 1),
            row = std::clamp(static_cast<int>(at.y), 0, rows_ - 1);
  const std::size_t pixel =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  const std::int32_t cell = cellOf_[pixel];
  if (cell < 0) return false;
  const std::size_t own =
      static_cast<std::size_t>(&layer - layers_.data()) - cells_[static_cast<std::size_t>(cell)].firstLayer;
  const bool byOwn = own < planes_ && values_[own * cellOf_.size() + pixel] > kCovering;
  return coveringPlanes_[pixel] > (byOwn ? 1 : 0);
}

}  // namespace cloudgen::pipeline
