// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "input/grib/messages.hpp"

namespace cloudgen::input::grib {

enum class GridKind {
  LatLon,
  Gaussian,
  AboutCenter,  ///< rotated so that a given place lies on its equator (NCEP), not staggered
  Mercator,
  TransverseMercator,
  PolarStereographic,
  Lambert,
  Albers,
  LambertAzimuthal,
};

/// The numbers of a grid section, alike for both editions. Degrees and metres.
struct GridSection {
  std::string where;
  GridKind kind{};
  std::string ellipsoid;  ///< "+R=6371229" or "+a=... +b=..."
  std::optional<std::uint64_t> columns, rows;
  std::optional<std::uint64_t> points;  ///< edition 2
  std::vector<std::uint32_t> pointsInRows;
  double firstLatitude = 0, firstLongitude = 0;
  std::optional<double> lastLatitude, lastLongitude;
  std::optional<double> stepX, stepY;  ///< without sign
  std::uint64_t gaussianNumber = 0;
  bool rotated = false;
  double southPoleLatitude = -90, southPoleLongitude = 0, rotationAngle = 0;
  double centerLatitude = 0, centerLongitude = 0;  ///< AboutCenter, LambertAzimuthal, TransverseMercator
  double trueLatitude = 0, orientation = 0;        ///< projections; the meridian that is upright
  double firstParallel = 0, secondParallel = 0;
  double scaleAtCenter = 1, falseEasting = 0, falseNorthing = 0, firstX = 0, firstY = 0;  ///< transverse
  bool southPole = false;  ///< polar stereographic: the pole in the middle
  bool windsAlongAxes = false;
  int scanning = 0;  ///< flag table 3.4 (edition 1: 8)
};

/// Throws InputError that names grids that are not read, and what to do about them.
GridSection readGridSection(const FieldHead& head);

}  // namespace cloudgen::input::grib
