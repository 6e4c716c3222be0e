// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/mesh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace cloudgen::input::cdfs {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Distance of the equator from the pole on a plane that is true at 60 degrees.
double equatorRadius(double radiusMeters) { return radiusMeters * (1 + std::sin(60 * kDegree)); }

double squared(double value) { return value * value; }

/// The spacing of the mesh that a header means, if it is one of the Air Force's.
std::optional<double> meshSpacing(double stepMeters) {
  for (double spacing = kWholeMeshMeters; spacing > 1000; spacing /= 2)
    if (std::abs(spacing - stepMeters) <= 1) return spacing;
  return std::nullopt;
}

/// Rounded headers put the pole some hundred metres off its grid point.
double snapped(double position) {
  return std::abs(position - std::round(position)) < 0.05 ? std::round(position) : position;
}

std::string definition(const Mesh& mesh, Hemisphere half) {
  return fmt::format("+proj=stere +lat_0={0}90 +lat_ts={0}60 +lon_0={1} +R={2}",
                     half == Hemisphere::North ? "" : "-", mesh.longitudeDown, mesh.radiusMeters);
}

}  // namespace

Mesh standardMesh(int size) {
  Mesh mesh;
  mesh.columns = mesh.rows = size;
  mesh.stepX = kWholeMeshMeters / 16 * kSixteenthMesh / size;
  mesh.stepY = -mesh.stepX;
  mesh.firstX = -0.5 * size * mesh.stepX;
  mesh.firstY = 0.5 * size * mesh.stepX;
  return mesh;
}

std::optional<Mesh> meshOf(const MeshHeader& header) {
  if (!(header.stepMeters > 0) || !(std::abs(header.firstLatitude) < 90)) return std::nullopt;
  Mesh mesh;
  mesh.columns = header.columns, mesh.rows = header.rows;
  const auto spacing = meshSpacing(header.stepMeters);
  mesh.stepX = spacing.value_or(header.stepMeters);
  if (!spacing) mesh.radiusMeters = header.radiusMeters;
  const double outward = header.south ? header.firstLatitude : -header.firstLatitude;
  const double distance = equatorRadius(mesh.radiusMeters) * std::tan((45 + 0.5 * outward) * kDegree);
  for (const double opposite : {180.0, 0.0})
    for (const bool rise : {header.rowsRise, !header.rowsRise}) {
      const double meridian = header.orientation + opposite;
      const double angle = (header.firstLongitude - meridian) * kDegree;
      const double x = distance * std::sin(angle), y = distance * std::cos(angle) * (header.south ? 1 : -1);
      mesh.stepY = rise ? mesh.stepX : -mesh.stepX;
      const double column = snapped(-x / mesh.stepX), row = snapped(-y / mesh.stepY);
      if (!(column >= 0 && column < mesh.columns && row >= 0 && row < mesh.rows)) continue;
      mesh.firstX = -column * mesh.stepX;
      mesh.firstY = -row * mesh.stepY;
      mesh.longitudeDown = meridian - 360 * std::floor((meridian + 180) / 360);
      return mesh;
    }
  return std::nullopt;
}

double squaredRadiusAt(const Mesh& mesh, double latitudeDegrees) {
  return squared(equatorRadius(mesh.radiusMeters) * std::tan((45 - 0.5 * latitudeDegrees) * kDegree));
}

double squaredRadius(const Mesh& mesh, int column, int row) {
  return squared(mesh.firstX + column * mesh.stepX) + squared(mesh.firstY + row * mesh.stepY);
}

field::Grid gridOf(const Mesh& mesh, const std::vector<Hemisphere>& halves) {
  field::Grid grid;
  grid.crs = definition(mesh, halves.front());
  grid.columns = mesh.columns;
  grid.rows = mesh.rows * static_cast<int>(halves.size());
  grid.firstX = mesh.firstX, grid.firstY = mesh.firstY;
  grid.stepX = mesh.stepX, grid.stepY = mesh.stepY;
  if (halves.size() == 2) grid.southCrs = definition(mesh, halves.back());
  return grid;
}

}  // namespace cloudgen::input::cdfs
