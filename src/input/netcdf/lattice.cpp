// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/frame.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::size_t kMostCells = std::size_t{1} << 30;

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw base::InputError(where, what, "check the coordinates of the file");
}

double meanStep(const std::vector<double>& values) {
  return values.size() < 2 ? 0 : (values.back() - values.front()) / static_cast<double>(values.size() - 1);
}

/// The greatest distance from even steps.
double unevenness(const std::vector<double>& values) {
  const double step = meanStep(values);
  double greatest = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    greatest = std::max(greatest, std::abs(values.front() + static_cast<double>(i) * step - values[i]));
  return greatest;
}

/// What single precision leaves of a coordinate.
double rounding(const std::vector<double>& values) {
  return 4 * std::numeric_limits<float>::epsilon() *
         std::max(std::abs(values.front()), std::abs(values.back()));
}

bool runsOneWay(const std::vector<double>& values) {
  const bool up = values.size() < 2 || values[1] > values[0];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(std::abs(values[i]) < 1e9)) return false;
    if (i > 0 && (up ? values[i] <= values[i - 1] : values[i] >= values[i - 1])) return false;
  }
  return true;
}

/// 350, 355, 0, 5 as 350, 355, 360, 365.
void unwrap(std::vector<double>& longitudes) {
  // Turning round absurd ones would never end.
  for (const double longitude : longitudes)
    if (!(std::abs(longitude) < 1e4)) return;
  for (std::size_t i = 1; i < longitudes.size(); ++i) {
    while (longitudes[i] - longitudes[i - 1] > 180) longitudes[i] -= 360;
    while (longitudes[i] - longitudes[i - 1] < -180) longitudes[i] += 360;
  }
}

field::Grid gridOfUnevenColumns(const std::string& where, const std::vector<double>& x,
                                const std::vector<double>& y) {
  field::Grid grid;
  grid.columns = static_cast<int>(x.size());
  grid.rows = static_cast<int>(y.size());
  grid.centers.reserve(x.size() * y.size());
  for (const double latitude : y)
    for (const double longitude : x) grid.centers.push_back({base::wrappedLongitude(longitude), latitude});
  if (x.size() < 2 || y.size() < 2) fail(where, "has uneven coordinates and only one row");
  return grid;
}

}  // namespace

field::Grid latticeOf(const std::string& where, const std::string& crs, std::vector<double> x,
                      const std::vector<double>& y) {
  const bool geographic = crs.starts_with("+proj=longlat");
  if (x.empty() || y.empty()) fail(where, "has empty coordinates");
  if (geographic) unwrap(x);
  if (!runsOneWay(x) || !runsOneWay(y)) fail(where, "has coordinates that do not run one way");
  if (geographic && std::max(std::abs(y.front()), std::abs(y.back())) > 90.001)
    fail(where, "has latitudes beyond the poles");
  if (x.size() > kMostCells / y.size()) fail(where, "has an absurd number of cells");

  field::Grid grid;
  grid.crs = crs;
  double stepX = meanStep(x);
  if (geographic && x.size() > 2 && std::abs(std::abs(x.back() - x.front()) - 360) < 0.01 * std::abs(stepX))
    x.pop_back();
  if (geographic && std::abs(x.back() - x.front()) >= 360)
    fail(where, "goes more than once around the Earth");
  stepX = meanStep(x);
  if (unevenness(x) > 0.02 * std::abs(stepX) + rounding(x)) {
    if (geographic) return gridOfUnevenColumns(where, x, y);
    fail(where, "has unevenly spaced columns on its map");
  }
  grid.columns = static_cast<int>(x.size());
  grid.rows = static_cast<int>(y.size());
  grid.firstX = x.front();
  grid.firstY = y.front();
  grid.stepX = stepX;
  grid.stepY = meanStep(y);
  // A single row or column is as wide as the others are apart.
  constexpr double kOneDegree = 1, kTenKilometres = 10000;
  const double alone = geographic ? kOneDegree : kTenKilometres;
  if (x.size() == 1) grid.stepX = grid.stepY != 0 ? std::abs(grid.stepY) : alone;
  if (y.size() == 1) grid.stepY = std::abs(grid.stepX);
  const double period = geographic || crs.starts_with("+proj=ob_tran") ? 360 : 0;
  grid.wrapsLongitude = period > 0 && x.size() > 2 &&
                        std::abs(std::abs(grid.stepX) * grid.columns - period) < 0.02 * std::abs(grid.stepX);
  if (grid.wrapsLongitude) grid.stepX = std::copysign(period / grid.columns, grid.stepX);
  if (unevenness(y) > 0.002 * std::abs(grid.stepY) + rounding(y)) grid.rowY = y;
  return grid;
}

field::Grid gridOfCenters(const std::string& where, std::size_t columns, std::size_t rows,
                          std::span<const double> longitudes, std::span<const double> latitudes) {
  if (columns == 0 || rows == 0 || longitudes.size() != columns * rows || latitudes.size() != columns * rows)
    fail(where, "has latitudes and longitudes of another shape than its cells");
  const auto at = [&](std::size_t column, std::size_t row) { return row * columns + column; };
  bool straight = true;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const double longitude = longitudes[at(column, row)], latitude = latitudes[at(column, row)];
      if (!(std::abs(latitude) <= 90.001) || !(std::abs(longitude) <= 1000))
        fail(where, fmt::format("says no place for column {}, row {}", column, row));
      straight &= std::abs(longitude - longitudes[at(column, 0)]) < 1e-5 &&
                  std::abs(latitude - latitudes[at(0, row)]) < 1e-5;
    }
  if (straight) {
    std::vector<double> x(longitudes.begin(), longitudes.begin() + static_cast<std::ptrdiff_t>(columns)), y;
    for (std::size_t row = 0; row < rows; ++row) y.push_back(latitudes[at(0, row)]);
    field::Grid grid = latticeOf(where, field::Grid().crs, x, y);
    // A dropped column would part the cells from the values.
    if (grid.columns == static_cast<int>(columns)) return grid;
  }
  if (columns < 2 || rows < 2) fail(where, "has a single line of cells that follows no meridian or parallel");
  field::Grid grid;
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  grid.centers.reserve(columns * rows);
  for (std::size_t i = 0; i < columns * rows; ++i)
    grid.centers.push_back({base::wrappedLongitude(longitudes[i]), std::clamp(latitudes[i], -90.0, 90.0)});
  return grid;
}

}  // namespace cloudgen::input::netcdf
