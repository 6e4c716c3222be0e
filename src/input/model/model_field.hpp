// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/time.hpp"
#include "field/grid.hpp"
#include "field/source.hpp"

/// What readers of model output (GRIB, NetCDF) have in common: each lists its fields by meaning, and
/// makeSource() (model_source.hpp) chooses among them.
namespace cloudgen::input::model {

/// Fields on one level only. Units: Pa (LogSurfacePressure: its natural logarithm), m above mean sea level,
/// 0..1.
enum class SingleKind {
  SurfacePressure,
  LogSurfacePressure,
  SeaLevelPressure,
  SurfaceHeight,  ///< orography
  CloudCover,
  CloudBaseHeight,
  CloudTopHeight,
  CloudBasePressure,
  CloudTopPressure,
};

/// Which clouds a cover, base or top speaks of.
enum class CloudPart { Total, Low, Middle, High, Convective };

struct Single {
  SingleKind kind{};
  CloudPart part = CloudPart::Total;
  auto operator<=>(const Single&) const = default;
};

enum class VerticalKind {
  Pressure,           ///< value in Pa
  Hybrid,             ///< p = a + b ps at the full level; value is the number
  Sigma,              ///< p = value ps
  HeightAboveSea,     ///< value in m
  HeightAboveGround,  ///< value in m
  ModelLevel          ///< value is a number; pressure or height are fields of their own
};

struct Vertical {
  VerticalKind kind = VerticalKind::Pressure;
  double value = 0;
  double a = 0, b = 0;  ///< of hybrid levels, Pa and 1
};

/// A field of a file; the data are read when they are asked for.
struct Field {
  std::variant<field::Quantity, Single> meaning;
  std::string name;                    ///< as the file calls it: "clwmr", "QCLOUD"
  std::string where;                   ///< for messages: "a.grib2, message 12 at byte 345"
  Vertical vertical;                   ///< of quantities on levels
  std::optional<base::UtcTime> valid;  ///< nothing: holds at any time (orography)
  std::optional<base::UtcTime> run;
  long member = 0;                     ///< of an ensemble
  std::size_t grid = 0;                ///< index in Contents::grids
  bool averaged = false;               ///< over hours before the valid time, not of a moment
  bool inPercent = false;              ///< fractions whose unit is said to be per cent: read() gives per cent
  bool alongGridAxes = false;          ///< winds that are not yet towards true east and north
  bool holdsIceBelowFreezing = false;  ///< liquid water that is ice where T < 0 C (WRF's WSM3)
  /// The values at cells of its grid in the unit of the meaning, NaN where missing. Throws InputError.
  std::function<std::vector<float>(std::span<const std::uint32_t> cells)> read;
};

/// All that files of one format hold.
struct Contents {
  std::vector<std::string> files;
  std::string format, model;
  /// One a distinct grid; made when a field on it is chosen, since files hold grids that nobody needs. Throws
  /// InputError for grids that cannot be placed.
  std::vector<std::function<field::Grid()>> grids;
  std::vector<Field> fields;
  std::vector<std::string> unused;  ///< known meanings without use (rain, snow), one line each
  std::vector<field::Warning> warnings;
};

}  // namespace cloudgen::input::model
