// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/horizontal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "input/netcdf/lattice.hpp"
#include "input/netcdf/map_projection.hpp"
#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {
namespace {

using Warnings = std::vector<field::Warning>;

constexpr std::size_t kLongestAxis = 1 << 20;
/// Of cells that are known by their places alone.
constexpr std::size_t kMostPlaces = 1 << 24;

bool contains(const std::vector<std::size_t>& dimensions, std::size_t dimension) {
  return std::find(dimensions.begin(), dimensions.end(), dimension) != dimensions.end();
}

std::string describe(const field::Grid& grid) {
  std::string key = fmt::format("{} {}x{} {} {} {} {}", grid.crs, grid.columns, grid.rows, grid.firstX,
                                grid.firstY, grid.stepX, grid.stepY);
  if (!grid.rowY.empty()) key += fmt::format(" rows {} {}", grid.rowY[0], grid.rowY[grid.rowY.size() / 2]);
  if (!grid.centers.empty()) {
    const field::GeoPoint &first = grid.centers.front(), &last = grid.centers.back();
    key += fmt::format(" centres {} {} {} {}", first.longitudeDegrees, first.latitudeDegrees,
                       last.longitudeDegrees, last.latitudeDegrees);
  }
  return key;
}

/// The lattice by 1-D coordinates of one variable.
class Lattice {
 public:
  Lattice(const File& file, const Axes& axes, const Placed& placed, Warnings& warnings)
      : file_(file), axes_(axes), placed_(placed), warnings_(warnings) {
    const std::vector<std::size_t>& dimensions = placed.variable->dimensions;
    xDimension_ = dimensions[*placed.x];
    yDimension_ = dimensions[*placed.y];
    x_ = axes.along(xDimension_, {Kind::Longitude, Kind::ProjectionX});
    y_ = axes.along(yDimension_, {Kind::Latitude, Kind::ProjectionY});
    findPair();
    findMapping();
  }

  Horizontal horizontal() {
    Horizontal result;
    result.columns = file_.dimensions()[xDimension_].length;
    result.rows = file_.dimensions()[yDimension_].length;
    const bool geographic =
        x_ && y_ && axes_.kind(*x_) == Kind::Longitude && axes_.kind(*y_) == Kind::Latitude;
    const bool mapped = x_ && y_ && !geographic && !crs_.empty();
    if (geographic || mapped) {
      try {
        const field::Grid grid = latticeOf(file_.where(*x_), geographic ? field::Grid().crs : crs_,
                                           coordinates(*x_, geographic), coordinates(*y_, geographic));
        if (!mapped || agrees(grid)) {
          result.columns = static_cast<std::size_t>(grid.columns);
          result.key = describe(grid);
          result.make = [grid] { return grid; };
          return result;
        }
      } catch (const base::InputError& error) {
        if (!latitude_) return refusal(result, error);
      }
    }
    if (latitude_ && longitude_) return byCenters(result);
    return refusal(result, base::InputError(file_.where(*placed_.variable),
                                            "has horizontal dimensions without latitude and longitude",
                                            "give a file with coordinates of its cells"));
  }

 private:
  static Horizontal refusal(Horizontal result, const base::InputError& error) {
    result.key = error.where() + error.problem();
    result.make = [error]() -> field::Grid { throw error; };
    return result;
  }

  /// 2-D latitude and longitude over the same dimensions; those that the variable names are preferred.
  void findPair() {
    const std::string named = " " + placed_.variable->text("coordinates") + " ";
    const auto find = [&](Kind kind) {
      const Variable* found = nullptr;
      for (const Variable& variable : file_.variables()) {
        const std::size_t rank = variable.dimensions.size();
        if (rank < 2 || rank > 3 || axes_.kind(variable) != kind) continue;
        if (!contains(variable.dimensions, xDimension_) || !contains(variable.dimensions, yDimension_))
          continue;
        if (rank == 3 && file_.dimensions()[variable.dimensions[0]].length == 0) continue;
        if (rank == 3 && (variable.dimensions[0] == xDimension_ || variable.dimensions[0] == yDimension_))
          continue;  // corners of cells
        if (named.find(" " + variable.name + " ") != std::string::npos) return &variable;
        if (!found) found = &variable;
      }
      return found;
    };
    latitude_ = find(Kind::Latitude);
    longitude_ = find(Kind::Longitude);
  }

  void findMapping() {
    std::string name = placed_.variable->text("grid_mapping");
    name = name.substr(0, name.find_first_of(" :"));
    const Variable* mapping = name.empty() ? nullptr : file_.find(name);
    if (!mapping)
      for (const Variable& variable : file_.variables())
        if (!mapping && variable.attributes.contains("grid_mapping_name")) mapping = &variable;
    if (!mapping) return;
    if (const auto found = projection(*mapping)) {
      crs_ = *found;
      heightOfView_ = mapping->text("grid_mapping_name") == "geostationary"
                          ? mapping->number("perspective_point_height").value_or(35785831)
                          : 0;
    } else {
      warnings_.push_back(
          {"projection_unknown", fmt::format("the grid mapping \"{}\" of {} is not read",
                                             mapping->text("grid_mapping_name"), mapping->name)});
    }
  }

  /// In degrees or metres, at the centres of the cells.
  std::vector<double> coordinates(const Variable& variable, bool geographic) {
    if (file_.size(variable) > kLongestAxis)
      throw base::InputError(file_.where(variable), "is absurdly long", "fetch the file again");
    std::vector<double> values = centered(variable, file_.values(variable));
    if (geographic || crs_.starts_with("+proj=ob_tran")) return values;
    const std::string unit = variable.text("units");
    if (heightOfView_ > 0) {
      const auto toRadians = conversion(unit, "radian");
      for (double& value : values) value *= (toRadians ? toRadians->factor : 1) * heightOfView_;
      return values;
    }
    const auto toMeters = conversion(unit, "m");
    if (!toMeters)
      warnings_.push_back(
          {"unit_unknown", fmt::format("{} has the unit \"{}\": taken as metres", variable.name, unit)});
    for (double& value : values) value *= toMeters ? toMeters->factor : 1;
    return values;
  }

  /// Coordinates that are corners of their cells by the file's own bounds are moved to the centres.
  std::vector<double> centered(const Variable& variable, std::vector<double> values) {
    const Variable* bounds = file_.find(variable.text("bounds"));
    if (!bounds || !bounds->isNumeric() || bounds->dimensions.size() != 2 || values.size() < 2 ||
        bounds->dimensions[0] != variable.dimensions[0] ||
        file_.dimensions()[bounds->dimensions[1]].length != 2)
      return values;
    const std::vector<double> edges = file_.values(*bounds);
    const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
    double shift = 0;
    std::vector<double> middles;
    for (std::size_t i = 0; i < values.size(); ++i) {
      middles.push_back(0.5 * (edges[2 * i] + edges[2 * i + 1]));
      // Bounds across the date line (179, -179) say nothing by their mean.
      if (std::abs(edges[2 * i + 1] - edges[2 * i]) > 180) return values;
      shift += (middles[i] - values[i]) / static_cast<double>(values.size());
    }
    if (!(std::abs(shift) > 0.25 * std::abs(step)) || !(std::abs(shift) < 0.75 * std::abs(step)))
      return values;
    warnings_.push_back(
        {"half_cell_shift", fmt::format("{} gives corners of cells, as {} shows: cells are moved by {:g} to "
                                        "their centres",
                                        variable.name, bounds->name, shift)});
    return middles;
  }

  struct Sample {
    std::size_t column, row;
  };
  std::vector<Sample> samples() const {
    const std::size_t columns = file_.dimensions()[xDimension_].length,
                      rows = file_.dimensions()[yDimension_].length;
    std::vector<Sample> chosen;
    if (columns == 0 || rows == 0) return chosen;
    for (const std::size_t row : {std::size_t{0}, rows / 2, rows - 1})
      for (const std::size_t column : {std::size_t{0}, columns / 2, columns - 1})
        chosen.push_back({column, row});
    return chosen;
  }

  double sampled(const Variable& variable, const Sample& sample) const {
    std::vector<std::size_t> start(variable.dimensions.size(), 0), count(start.size(), 1);
    for (std::size_t i = 0; i < start.size(); ++i) {
      if (variable.dimensions[i] == xDimension_) start[i] = sample.column;
      if (variable.dimensions[i] == yDimension_) start[i] = sample.row;
    }
    return file_.values(variable, start, count).front();
  }

  /// False, with a warning, where the file's own latitudes and longitudes lie elsewhere.
  bool agrees(const field::Grid& grid) {
    if (!latitude_ || !longitude_ || !grid.rowY.empty()) return true;
    std::vector<KnownPlace> places;
    for (const Sample& sample : samples()) {
      const double longitude = sampled(*longitude_, sample), latitude = sampled(*latitude_, sample);
      // Views from space have no place in their corners.
      if (std::isfinite(longitude) && std::isfinite(latitude))
        places.push_back(
            {static_cast<double>(sample.column), static_cast<double>(sample.row), {longitude, latitude}});
    }
    const bool degrees = grid.crs.starts_with("+proj=ob_tran");
    const double cell = std::abs(grid.stepX) * (degrees ? 111000 : 1);
    const double distance = greatestDistanceMeters(grid, places);
    if (distance <= std::max(50.0, 0.02 * cell)) return true;
    warnings_.push_back({"projection_disagrees",
                         fmt::format("the grid mapping puts cells up to {:.0f} m from the latitudes and "
                                     "longitudes in the file, which are taken instead",
                                     distance)});
    return false;
  }

  Horizontal byCenters(Horizontal result) {
    const std::string where = file_.where(*latitude_);
    if (result.columns == 0 || result.rows > kMostPlaces / result.columns)
      return refusal(result,
                     base::InputError(where, "has an absurd number of cells", "cut the file into parts"));
    result.key = fmt::format("centres {}x{}", result.columns, result.rows);
    try {
      for (const Sample& sample : samples())
        result.key += fmt::format(" {} {}", sampled(*longitude_, sample), sampled(*latitude_, sample));
    } catch (const base::InputError& error) {
      return refusal(result, error);
    }
    // The grid may be made after this reader is gone: the file is opened again.
    const std::filesystem::path path = file_.name();
    const std::string longitude = longitude_->name, latitude = latitude_->name;
    const std::size_t x = xDimension_, y = yDimension_, columns = result.columns, rows = result.rows;
    result.make = [=] {
      const File again(path);
      const auto all = [&](const std::string& name) {
        const Variable* variable = again.find(name);
        if (!variable)
          throw base::InputError(again.name(), "has changed", "leave input files alone while they are read");
        std::vector<std::size_t> start(variable->dimensions.size(), 0), count(start.size(), 1);
        std::size_t xPlace = 0, yPlace = 0;
        for (std::size_t i = 0; i < start.size(); ++i) {
          if (variable->dimensions[i] == x) count[i] = columns, xPlace = i;
          if (variable->dimensions[i] == y) count[i] = rows, yPlace = i;
        }
        std::vector<double> stored = again.values(*variable, start, count);
        if (yPlace < xPlace) return stored;
        std::vector<double> turned(stored.size());
        for (std::size_t row = 0; row < rows; ++row)
          for (std::size_t column = 0; column < columns; ++column)
            turned[row * columns + column] = stored[column * rows + row];
        return turned;
      };
      return gridOfCenters(where, columns, rows, all(longitude), all(latitude));
    };
    return result;
  }

  const File& file_;
  const Axes& axes_;
  const Placed& placed_;
  Warnings& warnings_;
  std::size_t xDimension_ = 0, yDimension_ = 0;
  const Variable *x_ = nullptr, *y_ = nullptr, *latitude_ = nullptr, *longitude_ = nullptr;
  std::string crs_;
  double heightOfView_ = 0;
};

/// The cells along one dimension, if they are a lattice written out (COSP's "loc").
Horizontal pointsOf(const File& file, const Axes& axes, const Placed& placed) {
  const std::size_t dimension = placed.variable->dimensions[*placed.point];
  Horizontal result;
  result.points = true;
  result.columns = file.dimensions()[dimension].length;
  const auto refuse = [&](const std::string& what) {
    const base::InputError error(
        file.where(*placed.variable), what,
        "put it on a latitude-longitude grid first, for example with \"cdo remapbil\"");
    result.key = error.where() + what;
    result.make = [error]() -> field::Grid { throw error; };
    return result;
  };
  const Variable* latitude = axes.along(dimension, {Kind::Latitude});
  const Variable* longitude = axes.along(dimension, {Kind::Longitude});
  const std::size_t count = result.columns;
  if (!latitude || !longitude || count == 0 || count > kMostPlaces)
    return refuse(fmt::format("lists {} cells without their places", count));
  const std::vector<double> x = file.values(*longitude), y = file.values(*latitude);
  const auto runOf = [&](const std::vector<double>& values) {
    std::size_t run = 1;
    while (run < count && std::abs(values[run] - values[0]) < 1e-6) ++run;
    return run;
  };
  // The slower of the two stands still while the other runs.
  result.columnsFirst = runOf(x) > runOf(y);
  const std::size_t fast = std::max(runOf(x), runOf(y));
  if (count % fast != 0 || (count > 1 && fast == 1))
    return refuse(fmt::format("lies on a mesh of {} cells without rows and columns", count));
  const std::size_t slow = count / fast;
  std::vector<double> columns, rows;
  const std::vector<double>&quick = result.columnsFirst ? y : x, &steady = result.columnsFirst ? x : y;
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::abs(quick[i] - quick[i % fast]) < 1e-6) ||
        !(std::abs(steady[i] - steady[i / fast * fast]) < 1e-6))
      return refuse(fmt::format("lies on a mesh of {} cells without rows and columns", count));
  for (std::size_t i = 0; i < fast; ++i) (result.columnsFirst ? rows : columns).push_back(quick[i]);
  for (std::size_t i = 0; i < slow; ++i) (result.columnsFirst ? columns : rows).push_back(steady[i * fast]);
  try {
    const field::Grid grid = latticeOf(file.where(*latitude), field::Grid().crs, columns, rows);
    result.rows = rows.size();
    result.columns = columns.size();
    if (static_cast<std::size_t>(grid.columns) != columns.size()) return refuse("repeats its first column");
    result.key = describe(grid);
    result.make = [grid] { return grid; };
  } catch (const base::InputError& error) {
    return refuse(error.problem());
  }
  return result;
}

}  // namespace

std::vector<Place> Horizontal::places(std::span<const std::uint32_t> cells) const {
  std::vector<Place> places;
  places.reserve(cells.size());
  for (const std::uint32_t cell : cells) {
    const std::size_t row = cell / columns, column = cell % columns;
    if (points)
      places.push_back({0, columnsFirst ? column * rows + row : cell});
    else
      places.push_back({row, column});
  }
  return places;
}

Horizontal horizontalOf(const File& file, const Axes& axes, const Placed& placed, Warnings& warnings) {
  if (placed.point) return pointsOf(file, axes, placed);
  return Lattice(file, axes, placed, warnings).horizontal();
}

Horizontal columnOf(const File& file, const Axes& axes, const OpenOptions& options, Warnings& warnings) {
  const auto valueOf = [&](Kind kind) -> std::optional<double> {
    const Variable* found = axes.scalar(kind);
    for (const Variable& variable : file.variables())  // of a column that moves, where it starts
      if (!found && variable.dimensions.size() == 1 && axes.kind(variable) == kind) found = &variable;
    if (!found || file.size(*found) == 0 || file.size(*found) > kLongestAxis) return std::nullopt;
    const double value = file.values(*found).front();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  std::optional<double> longitude = valueOf(Kind::Longitude), latitude = valueOf(Kind::Latitude);
  if (options.place && !(longitude && latitude)) {
    longitude = options.place->longitudeDegrees;
    latitude = options.place->latitudeDegrees;
  }
  Horizontal result;
  if (!longitude || !latitude || !(std::abs(*latitude) <= 90) || !(std::abs(*longitude) <= 1000)) {
    const base::InputError error(file.name(), "is a single column that does not say where it stands",
                                 "say its place");
    result.key = error.where();
    result.make = [error]() -> field::Grid { throw error; };
    return result;
  }
  double side = 10000;
  const Variable* resolution = file.find("horizontal_resolution");
  const auto toMeters = resolution ? conversion(resolution->text("units"), "m") : std::nullopt;
  const std::vector<double> sizes =
      resolution && resolution->isNumeric() && file.size(*resolution) <= kLongestAxis
          ? file.values(*resolution)
          : std::vector<double>{};
  const double stated = sizes.empty() ? 0 : sizes.front() * (toMeters ? toMeters->factor : 1000);
  if (stated > 1 && stated < 1e6)
    side = stated;
  else
    warnings.push_back(
        {"cell_size_assumed", "a single column that does not say its horizontal resolution: 10 km is taken"});
  field::Grid grid;
  grid.crs = fmt::format("+proj=laea +lat_0={} +lon_0={} +R={}", base::shortest(*latitude),
                         base::shortest(*longitude), base::shortest(field::kEarthRadiusMeters));
  grid.columns = grid.rows = 1;
  grid.stepX = grid.stepY = side;
  result.key = describe(grid);
  result.make = [grid] { return grid; };
  return result;
}

}  // namespace cloudgen::input::netcdf
