// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/axes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {
namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

template <std::size_t N>
bool isOneOf(std::string_view text, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

constexpr std::array<std::string_view, 7> kNorth{"degrees_north", "degree_north", "degrees_n",   "degree_n",
                                                 "degreesn",      "degreen",      "degree north"};
constexpr std::array<std::string_view, 7> kEast{"degrees_east", "degree_east", "degrees_e",  "degree_e",
                                                "degreese",     "degreee",     "degree east"};
constexpr std::array<std::string_view, 5> kLatitudeNames{"latitude", "lat", "nav_lat", "xlat", "xlat_m"};
constexpr std::array<std::string_view, 6> kLongitudeNames{"longitude", "lon",     "nav_lon",
                                                          "xlong",     "xlong_m", "long"};
constexpr std::array<std::string_view, 5> kXNames{"x", "rlon", "west_east", "xc", "nx"};
constexpr std::array<std::string_view, 5> kYNames{"y", "rlat", "south_north", "yc", "ny"};
constexpr std::array<std::string_view, 26> kVerticalNames{
    "level",      "lev",          "levels",     "plev",         "pressure_level",    "isobaricinhpa",
    "isobaric",   "isobaricinpa", "hybrid",     "hybrid_level", "model_level",       "model_level_number",
    "height",     "pressure",     "altitude",   "alt",          "heightaboveground", "heightabovesea",
    "sigma",      "eta",          "bottom_top", "nlev",         "generalvertical",   "generalverticallayer",
    "eta_levels", "vertical"};
constexpr std::array<std::string_view, 6> kTimeNames{"time", "valid_time", "t", "times", "nt", "validtime"};
constexpr std::array<std::string_view, 6> kReferenceNames{
    "forecast_reference_time", "reftime", "analysis_time", "initial_time", "base_time", "reference_time"};
constexpr std::array<std::string_view, 6> kPeriodNames{
    "step", "forecast_period", "leadtime", "lead_time", "forecast_time", "prediction_timedelta"};
constexpr std::array<std::string_view, 5> kMemberNames{"number", "member", "ensemble", "realization",
                                                       "ensemble_member"};
constexpr std::array<std::string_view, 5> kPointNames{"loc", "point", "ncol", "ncells", "cell"};
constexpr std::array<std::string_view, 8> kVerticalStandardNames{"air_pressure",
                                                                 "altitude",
                                                                 "height",
                                                                 "model_level_number",
                                                                 "geopotential_height",
                                                                 "height_above_mean_sea_level",
                                                                 "height_above_reference_ellipsoid",
                                                                 "height_above_geopotential_datum"};

bool isUnderground(const std::string& name) {
  return name.find("soil") != std::string::npos || name.find("depth") != std::string::npos;
}

Role roleOf(Kind kind) {
  switch (kind) {
    case Kind::Latitude:
    case Kind::ProjectionY:
      return Role::Y;
    case Kind::Longitude:
    case Kind::ProjectionX:
      return Role::X;
    case Kind::Vertical:
      return Role::Vertical;
    case Kind::Time:
    case Kind::Reference:
      return Role::Time;
    case Kind::Period:
      return Role::Step;
    case Kind::Member:
      return Role::Member;
    case Kind::None:
      break;
  }
  return Role::Other;
}

Role roleOfName(const std::string& name) {
  if (isUnderground(name)) return Role::Other;
  if (isOneOf(name, kLatitudeNames) || isOneOf(name, kYNames)) return Role::Y;
  if (isOneOf(name, kLongitudeNames) || isOneOf(name, kXNames)) return Role::X;
  if (isOneOf(name, kVerticalNames) || name == "z") return Role::Vertical;
  if (isOneOf(name, kTimeNames)) return Role::Time;
  if (isOneOf(name, kPeriodNames)) return Role::Step;
  if (isOneOf(name, kMemberNames)) return Role::Member;
  if (isOneOf(name, kPointNames)) return Role::Point;
  if (name == "expver") return Role::Version;
  return Role::Other;
}

Kind kindOfTime(const std::string& name, const std::string& standard) {
  const bool reference = standard == "forecast_reference_time" || isOneOf(name, kReferenceNames);
  return reference && standard != "time" ? Kind::Reference : Kind::Time;
}

bool isVertical(const Variable& variable, const std::string& name, const std::string& standard) {
  if (isUnderground(name) || standard == "depth") return false;
  if (isOneOf(standard, kVerticalStandardNames)) return true;
  if (standard.starts_with("atmosphere_") && standard.ends_with("_coordinate")) return true;
  if (lowerCase(variable.text("axis")) == "z" || variable.attributes.contains("formula_terms")) return true;
  if (isOneOf(name, kVerticalNames)) return true;
  return !variable.text("positive").empty() || conversion(variable.text("units"), "Pa").has_value();
}

}  // namespace

Kind kindOf(const Variable& variable) {
  if (!variable.isNumeric()) return Kind::None;
  const std::string name = lowerCase(variable.name), standard = lowerCase(variable.text("standard_name"));
  const std::string unit = lowerCase(variable.text("units")), axis = lowerCase(variable.text("axis"));
  if (standard == "grid_latitude" || standard.starts_with("projection_y")) return Kind::ProjectionY;
  if (standard == "grid_longitude" || standard.starts_with("projection_x")) return Kind::ProjectionX;
  if (standard == "latitude") return Kind::Latitude;
  if (standard == "longitude") return Kind::Longitude;
  if (standard == "realization") return Kind::Member;
  if (standard == "forecast_period") return Kind::Period;
  if (standard == "forecast_reference_time") return Kind::Reference;
  if (unit.find(" since ") != std::string::npos || unit.starts_with("day as %"))
    return kindOfTime(name, standard);
  if (isOneOf(name, kPeriodNames) && conversion(unit, "s")) return Kind::Period;
  if (isOneOf(name, kMemberNames)) return Kind::Member;
  if (name == "rlat" || (axis == "y" && name == "y")) return Kind::ProjectionY;
  if (name == "rlon" || (axis == "x" && name == "x")) return Kind::ProjectionX;
  if (isOneOf(unit, kNorth) || isOneOf(name, kLatitudeNames)) return Kind::Latitude;
  if (isOneOf(unit, kEast) || isOneOf(name, kLongitudeNames)) return Kind::Longitude;
  if (isVertical(variable, name, standard)) return Kind::Vertical;
  if (axis == "x" || isOneOf(name, kXNames)) return Kind::ProjectionX;
  if (axis == "y" || isOneOf(name, kYNames)) return Kind::ProjectionY;
  return Kind::None;
}

Axes::Axes(const File& file) : file_(file), roles_(file.dimensions().size(), Role::Other) {
  for (const Variable& variable : file.variables()) kinds_.push_back(kindOf(variable));
  takeCoordinates();
  takePairsOfTwoDimensions();
  takeNames();
}

void Axes::takeCoordinates() {
  std::vector<bool> named(roles_.size(), false);
  for (const Variable& variable : file_.variables()) {
    if (variable.dimensions.size() != 1) continue;
    const std::size_t dimension = variable.dimensions.front();
    if (variable.name != file_.dimensions()[dimension].name) continue;
    roles_[dimension] = roleOf(kind(variable));
    named[dimension] = roles_[dimension] != Role::Other;
  }
  // Others along the same dimension speak where none has its name; latitude and longitude along one
  // dimension make it a list of places, unless that dimension is time (a moving column).
  for (std::size_t dimension = 0; dimension < roles_.size(); ++dimension) {
    if (named[dimension]) continue;
    const bool latitude = along(dimension, {Kind::Latitude}), longitude = along(dimension, {Kind::Longitude});
    if (roleOfName(lowerCase(file_.dimensions()[dimension].name)) == Role::Time)
      roles_[dimension] = Role::Time;
    else if (latitude && longitude)
      roles_[dimension] = Role::Point;
    else if (latitude || along(dimension, {Kind::ProjectionY}))
      roles_[dimension] = Role::Y;
    else if (longitude || along(dimension, {Kind::ProjectionX}))
      roles_[dimension] = Role::X;
    else if (along(dimension, {Kind::Time}))
      roles_[dimension] = Role::Time;
    else if (along(dimension, {Kind::Vertical}))
      roles_[dimension] = Role::Vertical;
    else if (along(dimension, {Kind::Member}))
      roles_[dimension] = Role::Member;
  }
}

void Axes::takePairsOfTwoDimensions() {
  for (const Variable& variable : file_.variables()) {
    const std::size_t rank = variable.dimensions.size();
    if (rank < 2 || rank > 3 || kind(variable) != Kind::Latitude) continue;
    const std::size_t y = variable.dimensions[rank - 2], x = variable.dimensions[rank - 1];
    // Bounds of a 1-D coordinate look alike; their first dimension has a role.
    if (roles_[y] != Role::Other || roles_[x] != Role::Other || x == y) continue;
    const Role nameOfY = roleOfName(lowerCase(file_.dimensions()[y].name));
    const bool swapped = nameOfY == Role::X;
    roles_[y] = swapped ? Role::X : Role::Y;
    roles_[x] = swapped ? Role::Y : Role::X;
  }
}

void Axes::takeNames() {
  for (std::size_t dimension = 0; dimension < roles_.size(); ++dimension)
    if (roles_[dimension] == Role::Other)
      roles_[dimension] = roleOfName(lowerCase(file_.dimensions()[dimension].name));
}

Kind Axes::kind(const Variable& variable) const {
  return kinds_[static_cast<std::size_t>(&variable - file_.variables().data())];
}

const Variable* Axes::along(std::size_t dimension, std::initializer_list<Kind> kinds) const {
  const Variable* found = nullptr;
  for (const Variable& variable : file_.variables()) {
    if (variable.dimensions.size() != 1 || variable.dimensions.front() != dimension) continue;
    if (std::find(kinds.begin(), kinds.end(), kind(variable)) == kinds.end()) continue;
    if (variable.name == file_.dimensions()[dimension].name) return &variable;
    if (!found) found = &variable;
  }
  return found;
}

const Variable* Axes::scalar(Kind kind) const {
  for (const Variable& variable : file_.variables()) {
    const auto isOne = [&](std::size_t dimension) { return file_.dimensions()[dimension].length == 1; };
    if (std::all_of(variable.dimensions.begin(), variable.dimensions.end(), isOne) &&
        this->kind(variable) == kind)
      return &variable;
  }
  return nullptr;
}

std::optional<Placed> place(const File& file, const Axes& axes, const Variable& variable) {
  Placed placed{&variable, {}, {}, {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < variable.dimensions.size(); ++i) {
    const Role role = axes.role(variable.dimensions[i]);
    std::optional<std::size_t>* const slot = role == Role::X          ? &placed.x
                                             : role == Role::Y        ? &placed.y
                                             : role == Role::Point    ? &placed.point
                                             : role == Role::Vertical ? &placed.vertical
                                             : role == Role::Time     ? &placed.time
                                             : role == Role::Step     ? &placed.step
                                             : role == Role::Member   ? &placed.member
                                             : role == Role::Version  ? &placed.version
                                                                      : nullptr;
    const std::size_t length = file.dimensions()[variable.dimensions[i]].length;
    if (slot && !*slot)
      *slot = i;
    else if (length != 1)
      return std::nullopt;
  }
  return placed;
}

}  // namespace cloudgen::input::netcdf
