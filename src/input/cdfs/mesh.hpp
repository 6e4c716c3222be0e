// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "field/grid.hpp"

namespace cloudgen::input::cdfs {

enum class Hemisphere : unsigned char { North, South };

/// Radius of the Air Force's mesh reference grids, and the spacing of their coarsest, true at 60 degrees; the
/// n-th mesh is n times as fine (Hoke et al. 1981, AFGWC/TN-79/003; LISF pstoll).
inline constexpr double kMeshRadiusMeters = 6371221.3;
inline constexpr double kWholeMeshMeters = 381000;
inline constexpr int kSixteenthMesh = 1024;

/// The polar stereographic lattice of one hemisphere; the other has the same one, seen from its own pole.
/// Cell (column, row), both from 0, has its centre at (firstX + column * stepX, firstY + row * stepY) metres,
/// with the pole at (0, 0) and the meridian `longitudeDown` along -y (north) or +y (south).
struct Mesh {
  int columns = 0, rows = 0;
  double firstX = 0, firstY = 0, stepX = 0, stepY = 0;
  double longitudeDown = -80;
  double radiusMeters = kMeshRadiusMeters;

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  bool operator==(const Mesh&) const = default;
};

/// The mesh of `size` x `size` cells (a power of two; 1024 is WWMCA's) that covers a hemisphere, with the
/// pole at the 1-based point (size / 2 + 1, size / 2 + 1) and 10 E along the first axis.
Mesh standardMesh(int size = kSixteenthMesh);

/// What the grid section of a GRIB message says.
struct MeshHeader {
  int columns = 0, rows = 0;
  double firstLatitude = 0, firstLongitude = 0, orientation = 0;  ///< degrees
  double stepMeters = 0, radiusMeters = 0;
  bool south = false, rowsRise = false;  ///< rowsRise: the second row has the greater y
};

/// The mesh that a header describes. Spacings rounded to a metre (23813) are taken as the mesh's own
/// (23812.5) and poles within a twentieth of a cell of a grid point as that point. Air Force headers give the
/// meridian opposite to the one that GRIB asks for: of the two the one that puts the pole inside the grid is
/// taken. Nothing if none does.
std::optional<Mesh> meshOf(const MeshHeader& header);

/// Squared distance from the pole, in squared metres of the mesh, at which a latitude (absolute, degrees)
/// lies.
double squaredRadiusAt(const Mesh& mesh, double latitudeDegrees);
double squaredRadius(const Mesh& mesh, int column, int row);

/// One hemisphere as a plain polar stereographic grid, or both as a grid with southCrs.
field::Grid gridOf(const Mesh& mesh, const std::vector<Hemisphere>& halves);

}  // namespace cloudgen::input::cdfs
