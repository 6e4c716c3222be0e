// SPDX-License-Identifier: Apache-2.0
#include "pipeline/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace cloudgen::pipeline {
namespace {

constexpr int kMostPoints = 129;
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Quadratic B-spline; offset in units of the knots.
double spline(double offset) {
  const double t = std::abs(offset);
  if (t < 0.5) return 0.75 - t * t;
  return t < 1.5 ? 0.5 * (1.5 - t) * (1.5 - t) : 0.0;
}

/// A point of the lattice: the cell it lies in and that cell's neighbours.
struct Support {
  field::GeoPoint place;
  std::optional<std::uint32_t> cell;
  std::vector<std::uint32_t> cells;
};

/// Heights of cells, looked up by grid index.
struct Orography {
  std::vector<std::uint32_t> cells;  ///< ascending
  std::vector<float> heights;

  float at(std::uint32_t cell) const {
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    return found != cells.end() && *found == cell ? heights[static_cast<std::size_t>(found - cells.begin())]
                                                  : kMissing;
  }
};

/// Offset of a cell's centre from a place along the axes of the grid at `axesOf`, in sides of that cell.
glm::dvec2 offsetInCells(const field::Grid& grid, const Support& point, std::uint32_t cell) {
  constexpr double kMetersPerDegree = std::numbers::pi / 180 * field::kEarthRadiusMeters;
  const field::GeoPoint center = field::centerOf(grid, cell);
  const double east = base::wrappedLongitude(center.longitudeDegrees - point.place.longitudeDegrees) *
                      std::cos(point.place.latitudeDegrees * std::numbers::pi / 180) * kMetersPerDegree;
  const double north = (center.latitudeDegrees - point.place.latitudeDegrees) * kMetersPerDegree;
  const double angle = field::axisAngle(grid, *point.cell);
  const glm::dvec2 sides = field::cellSidesMeters(grid, *point.cell);
  return {(east * std::cos(angle) + north * std::sin(angle)) / sides.x,
          (north * std::cos(angle) - east * std::sin(angle)) / sides.y};
}

/// Nothing known about: NaN.
float heightOf(const field::Grid& grid, const Orography& orography, const Support& point) {
  double sum = 0, weights = 0;
  for (const std::uint32_t cell : point.cells) {
    const float height = orography.at(cell);
    if (!(height > -1000 && height < 10000)) continue;
    const glm::dvec2 offset = offsetInCells(grid, point, cell);
    const double weight = spline(offset.x) * spline(offset.y);
    sum += weight * height;
    weights += weight;
  }
  return weights > 1e-6 ? static_cast<float>(sum / weights) : kMissing;
}

/// Points without a height take that of the neighbours that have one, step by step.
void fillFromNeighbours(base::HeightField& field) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<float> next = field.heights;
    for (int row = 0; row < field.rows; ++row)
      for (int column = 0; column < field.columns; ++column) {
        if (std::isfinite(field.at(column, row))) continue;
        double sum = 0, count = 0;
        for (const auto& [x, z] :
             {std::pair{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}})
          if (x >= 0 && z >= 0 && x < field.columns && z < field.rows && std::isfinite(field.at(x, z)))
            sum += field.at(x, z), ++count;
        if (count == 0) continue;
        next[static_cast<std::size_t>(row * field.columns + column)] = static_cast<float>(sum / count);
        changed = true;
      }
    field.heights = std::move(next);
  }
}

/// The lattice over the scene's rectangle without heights, and with room for the ring about it.
base::HeightField latticeOver(const base::LocalFrame& frame, glm::dvec2 cellSides) {
  const glm::dvec2 lower = frame.lowerCorner(), size = frame.upperCorner() - lower;
  const double side = std::max(1.0, 0.5 * std::min(cellSides.x, cellSides.y));
  const auto points = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / side)) + 1, 5, kMostPoints - 2);
  };
  base::HeightField field;
  field.columns = points(size.x) + 2;
  field.rows = points(size.y) + 2;
  field.step = {size.x / (field.columns - 3), size.y / (field.rows - 3)};
  field.origin = lower - field.step;
  return field;
}

bool isRing(const base::HeightField& field, int column, int row) {
  return column == 0 || row == 0 || column == field.columns - 1 || row == field.rows - 1;
}

std::vector<Support> supportsOf(const base::HeightField& field, const field::Grid& grid,
                                const base::LocalFrame& frame) {
  const field::CellFinder finder(grid);
  std::vector<Support> points;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      Support& point = points.emplace_back();
      if (isRing(field, column, row)) continue;
      const glm::dvec3 place = frame.toGeographic(
          {field.origin.x + column * field.step.x, 0, field.origin.y + row * field.step.y});
      point.place = {place.x, place.y};
      if (!std::isfinite(place.x + place.y)) continue;
      point.cell = finder.at(point.place);
      if (!point.cell) continue;
      point.cells = field::neighbours(grid, *point.cell);
      point.cells.push_back(*point.cell);
    }
  return points;
}

Orography orographyAt(const field::Source& source, const std::vector<Support>& points) {
  std::set<std::uint32_t> cells;
  for (const Support& point : points) cells.insert(point.cells.begin(), point.cells.end());
  Orography orography{{cells.begin(), cells.end()}, {}};
  orography.heights = source.surface(orography.cells).heightMeters;
  return orography;
}

}  // namespace

Ground groundOf(const field::Source& source, const base::LocalFrame& frame,
                const std::vector<std::uint32_t>& cells) {
  const std::vector<float> own = source.surface(cells).heightMeters;
  float lowest = std::numeric_limits<float>::max(), highest = -lowest;
  for (const float height : own)
    if (height > -1000 && height < 10000)
      lowest = std::min(lowest, height), highest = std::max(highest, height);
  if (lowest > highest) return {};
  if (highest - lowest < 1) return {lowest, {}};

  Ground ground;
  const field::Grid& grid = source.grid();
  base::HeightField& terrain = ground.terrain;
  terrain = latticeOver(frame, field::cellSidesMeters(grid, cells[cells.size() / 2]));
  const std::vector<Support> points = supportsOf(terrain, grid, frame);
  const Orography orography = orographyAt(source, points);
  for (const Support& point : points)
    terrain.heights.push_back(point.cell ? heightOf(grid, orography, point) : kMissing);
  fillFromNeighbours(terrain);
  ground.lowestMeters = std::floor(*std::min_element(terrain.heights.begin(), terrain.heights.end()));
  if (!std::isfinite(ground.lowestMeters)) return {lowest, {}};
  for (int row = 0; row < terrain.rows; ++row)
    for (int column = 0; column < terrain.columns; ++column) {
      float& height = terrain.heights[static_cast<std::size_t>(row * terrain.columns + column)];
      height = isRing(terrain, column, row) ? ground.lowestMeters : std::round(height);
    }
  return ground;
}

void standOnTerrain(const Ground& ground, const base::LocalFrame& frame, field::CloudTable& table) {
  for (field::Cloud& cloud : table.clouds) {
    const field::Layer& layer = table.layers[cloud.layer];
    float height = ground.lowestMeters;
    if (!ground.terrain.empty()) {
      const glm::dvec3 place = frame.toScene(cloud.longitudeDegrees, cloud.latitudeDegrees, 0);
      height = static_cast<float>(ground.terrain.heightAt(place.x, place.z));
    }
    if (layer.genus == base::Genus::Fog && !ground.terrain.empty())
      cloud.baseMeters = height + std::max(0.0f, cloud.baseMeters - layer.surfaceMeters);
    cloud.baseMeters = std::max(cloud.baseMeters, height);
  }
}

}  // namespace cloudgen::pipeline
