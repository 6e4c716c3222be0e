// SPDX-License-Identifier: Apache-2.0
#include "input/grib/stored_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "input/grib/gaussian.hpp"
#include "input/grib/grid_section.hpp"
#include "input/grib/plane.hpp"

namespace cloudgen::input::grib {
namespace {

constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 28;

[[noreturn]] void bad(const GridSection& section, const std::string& what) {
  throw base::InputError(section.where, what,
                         "fetch the file again, or regrid it to a regular latitude-longitude grid");
}

/// Scanning flags.
bool westwards(const GridSection& section) { return (section.scanning & 0x80) != 0; }
bool northwards(const GridSection& section) { return (section.scanning & 0x40) != 0; }

std::string geographicCrs(const GridSection& section) {
  if (!section.rotated) return "+proj=longlat " + section.ellipsoid;
  if (section.rotationAngle != 0) bad(section, "has a rotated grid turned about its own pole");
  return fmt::format("+proj=ob_tran +o_proj=longlat +o_lat_p={} +o_lon_p=0 +lon_0={} {}",
                     -section.southPoleLatitude, section.southPoleLongitude, section.ellipsoid);
}

void setSize(const GridSection& section, StoredGrid& stored) {
  if (!section.columns || !section.rows) bad(section, "does not say how many columns and rows its grid has");
  const std::uint64_t columns = *section.columns, rows = *section.rows;
  if (columns < 1 || rows < 1 || columns > kMostPoints || rows > kMostPoints || columns * rows > kMostPoints)
    bad(section, fmt::format("has an absurd grid of {} by {} points", columns, rows));
  stored.storedColumns = stored.grid.columns = static_cast<int>(columns);
  stored.storedRows = stored.grid.rows = static_cast<int>(rows);
  stored.westwards = westwards(section);
  stored.columnsFirst = (section.scanning & 0x20) != 0;
  stored.toAndFro = (section.scanning & 0x10) != 0;
}

/// Eastward extent from the western to the eastern border column, in (0, 360].
double eastwardSpan(const GridSection& section) {
  const double span = westwards(section) ? section.firstLongitude - *section.lastLongitude
                                         : *section.lastLongitude - section.firstLongitude;
  return span <= 0 ? span + 360 : span;
}

/// Step between points: the corners are more precise than the rounded increment, if they agree.
double stepOf(const GridSection& section, double span, int count, const std::optional<double>& increment) {
  if (count == 1) return increment.value_or(1);
  const double step = span / (count - 1);
  if (!(step > 1e-6) || step > 180) bad(section, "has a grid with an impossible spacing");
  if (increment && std::abs(step - *increment) > 0.01 * *increment + 0.002) {
    // A last longitude that repeats the first one may be written as the column before it, or the reverse.
    const double around = *increment * count;
    if (std::abs(around - 360) < 0.01 * *increment) return *increment;
    bad(section, fmt::format("has a grid whose corners and spacing disagree ({} against {} degrees)", step,
                             *increment));
  }
  return step;
}

void checkOnPlanet(const GridSection& section) {
  const double latitude =
      std::max(std::abs(section.firstLatitude), std::abs(section.lastLatitude.value_or(0)));
  const double longitude =
      std::max(std::abs(section.firstLongitude), std::abs(section.lastLongitude.value_or(0)));
  if (!(latitude <= 90.001) || !(longitude <= 720.001)) bad(section, "has a grid that is not on this planet");
}

void setColumns(const GridSection& section, StoredGrid& stored) {
  field::Grid& grid = stored.grid;
  grid.stepX = stepOf(section, eastwardSpan(section), grid.columns, section.stepX);
  grid.firstX =
      stored.westwards ? section.firstLongitude - (grid.columns - 1) * grid.stepX : section.firstLongitude;
  const double around = grid.columns * grid.stepX;
  grid.wrapsLongitude = std::abs(around - 360) < 0.01 * grid.stepX;
  if (grid.columns > 1 && std::abs(around - grid.stepX - 360) < 0.01 * grid.stepX) {
    --grid.columns;
    grid.wrapsLongitude = true;
  }
}

void setEvenRows(const GridSection& section, field::Grid& grid) {
  const double northward = northwards(section) ? 1 : -1;
  const double span = northward * (*section.lastLatitude - section.firstLatitude);
  if (grid.rows > 1 && span < 0) bad(section, "has rows that run against the stated direction");
  grid.firstY = section.firstLatitude;
  grid.stepY = northward * stepOf(section, span, grid.rows, section.stepY);
}

void setGaussianRows(const GridSection& section, field::Grid& grid) {
  constexpr std::uint64_t kMostRows = 8000;
  const std::uint64_t n = section.gaussianNumber;
  if (n < 1 || n > kMostRows) bad(section, fmt::format("has an absurd Gaussian number ({})", n));
  std::vector<double> latitudes = gaussianLatitudes(static_cast<int>(n));
  if (northwards(section)) std::reverse(latitudes.begin(), latitudes.end());
  std::size_t first = 0;
  for (std::size_t i = 0; i < latitudes.size(); ++i)
    if (std::abs(latitudes[i] - section.firstLatitude) < std::abs(latitudes[first] - section.firstLatitude))
      first = i;
  const auto rows = static_cast<std::size_t>(grid.rows);
  if (rows > latitudes.size() - first ||
      std::abs(latitudes[first] - section.firstLatitude) > 45.0 / static_cast<double>(n))
    bad(section, fmt::format("has {} rows from {} degrees, which do not fit a Gaussian grid of number {}",
                             rows, section.firstLatitude, n));
  const auto begin = latitudes.begin() + static_cast<std::ptrdiff_t>(first);
  grid.rowY.assign(begin, begin + grid.rows);
  grid.firstY = grid.rowY.front();
  const double mean = 180.0 / (2.0 * static_cast<double>(n));
  grid.stepY = grid.rows > 1 ? (grid.rowY.back() - grid.rowY.front()) / (grid.rows - 1)
                             : (northwards(section) ? mean : -mean);
}

StoredGrid regular(const GridSection& section) {
  StoredGrid stored;
  checkOnPlanet(section);
  setSize(section, stored);
  stored.grid.crs = geographicCrs(section);
  setColumns(section, stored);
  if (section.kind == GridKind::Gaussian)
    setGaussianRows(section, stored.grid);
  else
    setEvenRows(section, stored.grid);
  return stored;
}

/// The points of a full circle of `count` that lie in the grid's longitudes.
field::ReducedRow partOfCircle(const GridSection& section, std::uint32_t count) {
  constexpr double kRounding = 1e-3;
  const double west = section.firstLongitude, east = west + eastwardSpan(section);
  const double from = std::ceil((west - kRounding) * count / 360),
               to = std::floor((east + kRounding) * count / 360);
  const double step = count ? 360.0 / count : 360.0;
  return {0, std::max(0, static_cast<int>(to - from) + 1), from * step, step};
}

StoredGrid reduced(const GridSection& section) {
  StoredGrid stored;
  checkOnPlanet(section);
  field::Grid& grid = stored.grid;
  const std::vector<std::uint32_t>& counts = section.pointsInRows;
  const std::uint32_t longest = *std::max_element(counts.begin(), counts.end());
  const std::uint64_t sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (section.scanning & 0xb0) bad(section, "has rows of their own length in an unusual order");
  if (longest < 1 || longest > 100000 || counts.size() > 100000 || sum > kMostPoints)
    bad(section, fmt::format("has an absurd grid of {} points in {} rows", sum, counts.size()));
  grid.crs = geographicCrs(section);
  grid.rows = static_cast<int>(counts.size());
  const double span = eastwardSpan(section), width = 360.0 / longest;
  const bool global = std::abs(span + width - 360) < 0.5 * width || std::abs(span - 360) < 0.1 * width;
  // Rows of a part of the globe are counted either as they are (thinned) or as full circles (Gaussian).
  const bool circles =
      !global && section.kind == GridKind::Gaussian && section.points && *section.points != sum;
  std::uint64_t start = 0;
  for (const std::uint32_t count : counts) {
    field::ReducedRow row{0, static_cast<int>(count), section.firstLongitude, span};
    if (global && count > 0) row.stepX = 360.0 / count;
    if (!global && count > 1) row.stepX = span / (count - 1);
    if (circles) row = partOfCircle(section, count);
    row.start = static_cast<std::uint32_t>(start);
    start += static_cast<std::uint64_t>(row.count);
    if (start > kMostPoints) bad(section, "has an absurd number of points");
    grid.columns = std::max(grid.columns, row.count);
    grid.reducedRows.push_back(row);
  }
  if (start == 0 || (section.points && start != *section.points))
    bad(section, fmt::format("states {} points where its rows have {}", section.points.value_or(0), start));
  grid.wrapsLongitude = global;
  grid.firstX = section.firstLongitude;
  grid.stepX = grid.columns > 1 ? (global ? 360.0 / grid.columns : span / (grid.columns - 1)) : span;
  if (section.kind == GridKind::Gaussian)
    setGaussianRows(section, grid);
  else
    setEvenRows(section, grid);
  stored.storedColumns = grid.columns;
  stored.storedRows = grid.rows;
  return stored;
}

StoredGrid aroundCenter(GridSection section) {
  const field::GeoPoint center{section.centerLongitude, section.centerLatitude};
  if (std::abs(center.latitudeDegrees) > 90) bad(section, "has a grid that is not on this planet");
  const field::GeoPoint first = aboutCenter(center, {section.firstLongitude, section.firstLatitude});
  StoredGrid stored;
  setSize(section, stored);
  if (!section.stepX || !section.stepY) bad(section, "does not say how far apart its points are");
  section.southPoleLatitude = section.centerLatitude - 90;
  section.southPoleLongitude = section.centerLongitude;
  field::Grid& grid = stored.grid;
  grid.crs = geographicCrs(section);
  grid.stepX = *section.stepX;
  grid.stepY = northwards(section) ? *section.stepY : -*section.stepY;
  if (section.lastLatitude && section.lastLongitude && grid.columns > 1 && grid.rows > 1) {
    // The corners are more precise than the rounded increments.
    const field::GeoPoint last = aboutCenter(center, {*section.lastLongitude, *section.lastLatitude});
    const double stepX = std::abs(last.longitudeDegrees - first.longitudeDegrees) / (grid.columns - 1),
                 stepY = (last.latitudeDegrees - first.latitudeDegrees) / (grid.rows - 1);
    if (std::abs(stepX / grid.stepX - 1) < 0.01 && std::abs(stepY / grid.stepY - 1) < 0.01) {
      grid.stepX = stepX;
      grid.stepY = stepY;
    }
  }
  const double width = (grid.columns - 1) * grid.stepX;
  if (width > 360 || (grid.rows - 1) * std::abs(grid.stepY) > 180)
    bad(section, "has a grid larger than the globe");
  grid.firstX = first.longitudeDegrees - (stored.westwards ? width : 0);
  grid.firstY = first.latitudeDegrees;
  return stored;
}

std::string planeCrs(const GridSection& section) {
  const double pole = section.southPole ? -1 : 1;
  switch (section.kind) {
    case GridKind::Mercator: {
      // The middle meridian, so that no column lies beyond the edge of the map.
      const double middle =
          section.lastLongitude
              ? section.firstLongitude + (westwards(section) ? -0.5 : 0.5) * eastwardSpan(section)
              : section.firstLongitude;
      return fmt::format("+proj=merc +lat_ts={} +lon_0={} {}", section.trueLatitude, middle,
                         section.ellipsoid);
    }
    case GridKind::TransverseMercator:
      return fmt::format("+proj=tmerc +lat_0={} +lon_0={} +k={} +x_0={} +y_0={} {}", section.centerLatitude,
                         section.centerLongitude, section.scaleAtCenter, section.falseEasting,
                         section.falseNorthing, section.ellipsoid);
    case GridKind::PolarStereographic:
      return fmt::format("+proj=stere +lat_0={} +lat_ts={} +lon_0={} {}", 90 * pole,
                         pole * std::abs(section.trueLatitude), section.orientation, section.ellipsoid);
    case GridKind::Lambert:
    case GridKind::Albers:
      return fmt::format("+proj={} +lat_1={} +lat_2={} +lat_0={} +lon_0={} {}",
                         section.kind == GridKind::Lambert ? "lcc" : "aea", section.firstParallel,
                         section.secondParallel, section.firstParallel, section.orientation,
                         section.ellipsoid);
    default:
      return fmt::format("+proj=laea +lat_0={} +lon_0={} {}", section.centerLatitude, section.centerLongitude,
                         section.ellipsoid);
  }
}

StoredGrid projected(const GridSection& section) {
  constexpr double kLongestStep = 2e6;
  StoredGrid stored;
  if (section.kind != GridKind::TransverseMercator) checkOnPlanet(section);
  setSize(section, stored);
  if (section.kind == GridKind::Mercator && section.rotationAngle != 0)
    bad(section, "has a Mercator grid that is turned");
  if (!section.stepX || !section.stepY || *section.stepX > kLongestStep || *section.stepY > kLongestStep)
    bad(section, "has a grid with an impossible spacing");
  field::Grid& grid = stored.grid;
  grid.crs = planeCrs(section);
  const glm::dvec2 first =
      section.kind == GridKind::TransverseMercator
          ? glm::dvec2{section.firstX, section.firstY}
          : toPlane(grid.crs, {section.firstLongitude, section.firstLatitude}, section.where);
  grid.stepX = *section.stepX;
  grid.stepY = northwards(section) ? *section.stepY : -*section.stepY;
  grid.firstX = first.x - (stored.westwards ? (grid.columns - 1) * grid.stepX : 0);
  grid.firstY = first.y;
  return stored;
}

StoredGrid placed(const GridSection& section) {
  constexpr int kShiftedRows = 0x0f;
  if (section.scanning & kShiftedRows) bad(section, "has rows that are shifted against each other");
  switch (section.kind) {
    case GridKind::LatLon:
    case GridKind::Gaussian:
      return section.pointsInRows.empty() ? regular(section) : reduced(section);
    case GridKind::AboutCenter:
      return aroundCenter(section);
    default:
      return projected(section);
  }
}

}  // namespace

std::size_t StoredGrid::size() const {
  if (!grid.reducedRows.empty()) return grid.size();
  return static_cast<std::size_t>(storedColumns) * static_cast<std::size_t>(storedRows);
}

std::size_t StoredGrid::place(std::uint32_t cell) const {
  const bool asInFile = !westwards && !columnsFirst && !toAndFro && storedColumns == grid.columns;
  if (asInFile || !grid.reducedRows.empty()) return cell;
  const auto columns = static_cast<std::size_t>(storedColumns), rows = static_cast<std::size_t>(storedRows);
  auto column = static_cast<std::size_t>(grid.column(cell)), row = static_cast<std::size_t>(grid.row(cell));
  if (westwards) column = columns - 1 - column;
  if (toAndFro && columnsFirst && column % 2 == 1) row = rows - 1 - row;
  if (toAndFro && !columnsFirst && row % 2 == 1) column = columns - 1 - column;
  return columnsFirst ? column * rows + row : row * columns + column;
}

StoredGrid readGrid(const FieldHead& head) {
  const GridSection section = readGridSection(head);
  StoredGrid stored = placed(section);
  if (section.points && *section.points != stored.size())
    bad(section, fmt::format("states {} points where its grid has {}", *section.points, stored.size()));
  return stored;
}

std::string gridKey(const FieldHead& head) {
  std::string key = *head.grid;
  const auto clear = [&](std::size_t octet) {
    if (octet <= key.size()) key[octet - 1] = static_cast<char>(key[octet - 1] & ~0x08);
  };
  if (head.location.edition == 1) {
    if (key.size() < 32) return *head.identification;
    // Vertical coordinates lie in this section too.
    const auto coordinates = 4 * static_cast<std::size_t>(static_cast<unsigned char>(key[3]));
    const auto place = static_cast<std::size_t>(static_cast<unsigned char>(key[4]));
    if (coordinates > 0 && place != 255 && place > 6 && place - 1 <= key.size())
      key.erase(place - 1, coordinates);
    clear(17);
    key.replace(0, 5, 1, '1');
    return key;
  }
  const int type =
      key.size() < 14 ? 0 : static_cast<unsigned char>(key[12]) << 8 | static_cast<unsigned char>(key[13]);
  const bool projection = type == 10 || type == 12 || type == 20 || type == 30 || type == 31;
  clear(projection ? 47 : 55);
  key.insert(key.begin(), '2');
  return key;
}

bool windsAlongAxes(const FieldHead& head) {
  try {
    const GridSection section = readGridSection(head);
    const bool eastAndNorth =
        section.kind == GridKind::Mercator ||
        ((section.kind == GridKind::LatLon || section.kind == GridKind::Gaussian) && !section.rotated);
    return section.windsAlongAxes && !eastAndNorth;
  } catch (const base::InputError&) {
    return false;  // the grid says so when it is asked for
  }
}

}  // namespace cloudgen::input::grib
