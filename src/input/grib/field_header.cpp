// SPDX-License-Identifier: Apache-2.0
#include "input/grib/field_header.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace cloudgen::input::grib {
namespace {

using field::Quantity;

/// A parameter by its GRIB2 number (discipline 0) and by ecCodes' short name for GRIB1.
struct Parameter {
  int category, number;
  std::string_view shortName;
  Quantity quantity;
  double factor;
};

constexpr double kPercent = 0.01, kPerGravity = 1 / 9.80665;

/// WMO code table 4.2, discipline 0.
constexpr Parameter kParameters[] = {
    {1, 22, "clwmr", Quantity::CloudCondensate, 1},
    {1, 23, "icmr", Quantity::CloudIce, 1},
    {1, 82, "QI", Quantity::CloudIce, 1},
    {1, 83, "clwc", Quantity::CloudLiquid, 1},
    {1, 84, "ciwc", Quantity::CloudIce, 1},
    {6, 1, "tcc", Quantity::CloudFraction, kPercent},
    {6, 22, "ccl", Quantity::CloudFraction, kPercent},
    {6, 32, "cc", Quantity::CloudFraction, 1},
    {0, 0, "t", Quantity::Temperature, 1},
    {1, 1, "r", Quantity::RelativeHumidity, kPercent},
    {1, 0, "q", Quantity::SpecificHumidity, 1},
    {3, 5, "gh", Quantity::GeopotentialHeight, 1},
    {3, 4, "z", Quantity::GeopotentialHeight, kPerGravity},
    {2, 2, "u", Quantity::WindEast, 1},
    {2, 3, "v", Quantity::WindNorth, 1},
    {2, 8, "w", Quantity::VerticalVelocity, 1},
};

const Parameter* parameterOf(const Handle& handle, int edition, const std::string& shortName) {
  const long discipline = handle.integerIfAny("discipline").value_or(-1);
  const long category = handle.integerIfAny("parameterCategory").value_or(-1);
  const long number = handle.integerIfAny("parameterNumber").value_or(-1);
  for (const Parameter& parameter : kParameters) {
    const bool byNumber =
        edition == 2 && discipline == 0 && category == parameter.category && number == parameter.number;
    if (byNumber || (edition == 1 && shortName == parameter.shortName)) return &parameter;
  }
  return nullptr;
}

/// A date as yyyymmdd and a time as hhmm, as ecCodes gives them.
base::UtcTime timeOf(const Handle& handle, const char* dateKey, const char* timeKey) {
  const long date = handle.integer(dateKey), time = handle.integer(timeKey);
  const auto text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}Z", date / 10000, date / 100 % 100, date % 100,
                                time / 100, time % 100);
  const auto moment = date < 0 || time < 0 ? std::nullopt : base::utcFromIso(text);
  if (!moment)
    throw base::InputError(handle.location().name(), "has an impossible date (" + text + ")",
                           "fetch the file again");
  return *moment;
}

Role roleOf(const FieldHeader& header, bool instant) {
  if (!instant) return Role::Other;
  if (header.levelType == "isobaricInhPa" || header.levelType == "isobaricInPa")
    return header.quantity ? Role::Level : Role::Other;
  if (header.levelType != "surface") return Role::Other;
  if (header.shortName == "sp") return Role::SurfacePressure;
  if (header.shortName == "orog" || header.quantity == Quantity::GeopotentialHeight)
    return Role::SurfaceHeight;
  return Role::Other;
}

[[noreturn]] void badGrid(const Handle& handle, const std::string& what) {
  throw base::InputError(handle.location().name(), what,
                         "fetch the file again, or regrid it to a regular latitude-longitude grid");
}

/// Eastward (or westward) extent from the first to the last column, in degrees, with the sign of the scan.
double longitudeSpan(double first, double last, bool westward) {
  double span = westward ? first - last : last - first;
  if (span <= 0) span += 360;
  return westward ? -span : span;
}

/// The step between cells; first and last point are more precise than the rounded increment of the file.
double stepOf(const Handle& handle, double span, int count, const char* incrementKey, double sign) {
  const auto increment = handle.numberIfAny(incrementKey);
  if (count == 1) return sign * (increment && *increment > 0 ? *increment : 1.0);
  const double step = span / (count - 1);
  if (!(std::abs(step) > 1e-6) || std::abs(step) > 180)
    badGrid(handle, "has a grid with an impossible spacing");
  if (increment && *increment > 0 && std::abs(std::abs(step) - *increment) > 0.01 * *increment + 0.002)
    badGrid(handle, fmt::format("has a grid whose corners and spacing disagree ({} against {} degrees)",
                                std::abs(step), *increment));
  return step;
}

}  // namespace

FieldHeader readHeader(const Handle& handle) {
  FieldHeader header;
  header.location = handle.location();
  header.shortName = handle.text("shortName");
  header.levelType = handle.text("typeOfLevel");
  header.gridType = handle.text("gridType");
  if (const Parameter* parameter = parameterOf(handle, header.location.edition, header.shortName)) {
    header.quantity = parameter->quantity;
    header.factor = parameter->factor;
  }
  header.role = roleOf(header, handle.text("stepType") == "instant");
  if (header.role == Role::Level) {
    header.pressurePa = handle.number("level") * (header.levelType == "isobaricInhPa" ? 100.0 : 1.0);
    if (!(header.pressurePa > 0) || header.pressurePa > 120000) header.role = Role::Other;
  }
  if (header.role == Role::Other) return header;
  header.run = timeOf(handle, "dataDate", "dataTime");
  header.valid = timeOf(handle, "validityDate", "validityTime");
  header.gridKey = handle.text("md5GridSection");
  header.member = handle.integerIfAny("perturbationNumber").value_or(0);
  return header;
}

std::string modelName(const Handle& handle) {
  const std::string centre = handle.text("centre");
  const long process = handle.integerIfAny("generatingProcessIdentifier").value_or(-1);
  const bool isGfs = process == 81 || process == 82 || process == 96;
  if (centre == "kwbc" && isGfs) return "NCEP GFS";
  if (centre == "kwbc") return fmt::format("NCEP, process {}", process);
  if (centre == "ecmf") return "ECMWF IFS";
  return fmt::format("centre {}, process {}", centre, process);
}

std::size_t StoredGrid::place(std::uint32_t cell) const {
  const auto column = static_cast<std::size_t>(grid.column(cell)),
             row = static_cast<std::size_t>(grid.row(cell));
  return columnsFirst ? column * static_cast<std::size_t>(storedRows) + row
                      : row * static_cast<std::size_t>(storedColumns) + column;
}

StoredGrid readGrid(const Handle& handle) {
  constexpr long kMostPoints = long{1} << 25;
  const std::string type = handle.text("gridType");
  if (type != "regular_ll")
    throw base::InputError(
        handle.location().name(), fmt::format("is on a grid of type {}, which is not read yet", type),
        "regrid it to latitude and longitude, as with `cdo remapbil,r720x361` or wgrib2's -new_grid");
  const long columns = handle.integer("Ni"), rows = handle.integer("Nj");
  if (columns < 1 || rows < 1 || columns > kMostPoints || rows > kMostPoints || columns * rows > kMostPoints)
    badGrid(handle, fmt::format("has an absurd grid of {} by {} points", columns, rows));
  if (handle.integerIfAny("alternativeRowScanning").value_or(0) != 0)
    badGrid(handle, "has rows that run to and fro");

  StoredGrid stored;
  stored.storedColumns = static_cast<int>(columns);
  stored.storedRows = static_cast<int>(rows);
  stored.columnsFirst = handle.integerIfAny("jPointsAreConsecutive").value_or(0) != 0;
  const bool westward = handle.integerIfAny("iScansNegatively").value_or(0) != 0;
  const double firstLatitude = handle.number("latitudeOfFirstGridPointInDegrees");
  const double lastLatitude = handle.number("latitudeOfLastGridPointInDegrees");
  const double firstLongitude = handle.number("longitudeOfFirstGridPointInDegrees");
  const double lastLongitude = handle.number("longitudeOfLastGridPointInDegrees");
  if (std::max(std::abs(firstLatitude), std::abs(lastLatitude)) > 90.001 ||
      std::max(std::abs(firstLongitude), std::abs(lastLongitude)) > 720.001)
    badGrid(handle, "has a grid that is not on this planet");

  field::Grid& grid = stored.grid;
  grid.rows = stored.storedRows;
  grid.columns = stored.storedColumns;
  grid.firstX = firstLongitude;
  grid.firstY = firstLatitude;
  const double southward = handle.integerIfAny("jScansPositively").value_or(0) != 0 ? 1 : -1;
  grid.stepX = stepOf(handle, longitudeSpan(firstLongitude, lastLongitude, westward), grid.columns,
                      "iDirectionIncrementInDegrees", westward ? -1 : 1);
  grid.stepY =
      stepOf(handle, lastLatitude - firstLatitude, grid.rows, "jDirectionIncrementInDegrees", southward);
  if (grid.rows > 1 && grid.stepY * southward < 0)
    badGrid(handle, "has rows that run against the stated direction");
  const double width = std::abs(grid.stepX), around = grid.columns * width;
  grid.wrapsLongitude = std::abs(around - 360) < 0.01 * width;
  if (grid.columns > 1 && std::abs(around - width - 360) < 0.01 * width) {
    --grid.columns;
    grid.wrapsLongitude = true;
  }
  return stored;
}

}  // namespace cloudgen::input::grib
