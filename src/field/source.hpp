// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/genus.hpp"
#include "base/time.hpp"
#include "field/grid.hpp"

namespace cloudgen::field {

/// What a value means, whatever the file calls it. Units are SI; fractions are 0..1; NaN is missing.
enum class Quantity {
  CloudCondensate,  ///< liquid + ice mixing ratio in one field, kg per kg of air
  CloudLiquid,
  CloudIce,
  CloudFraction,
  Temperature,       ///< K
  RelativeHumidity,  ///< 0..1 (may exceed 1)
  SpecificHumidity,
  GeopotentialHeight,  ///< gpm above mean sea level
  Pressure,            ///< Pa
  WindEast,            ///< m/s, towards the east
  WindNorth,
  VerticalVelocity,  ///< Pa/s, positive downwards
};

/// "cloud condensate", "temperature", ...: for reports and messages.
std::string_view quantityName(Quantity quantity);

/// One model level over the cells that were asked for (same order, one value a cell).
struct Level {
  double pressurePa = 0;
  std::map<Quantity, std::vector<float>> values;

  bool has(Quantity quantity) const { return values.contains(quantity); }
  std::span<const float> of(Quantity quantity) const { return values.at(quantity); }
};

/// A cloud layer that a source states outright (CDFS typing, a described sky), in one cell.
struct TypedLayer {
  std::uint32_t cell = 0;
  base::Genus genus{};
  float coverFraction = 0;              ///< 0..1
  float baseMeters = 0, topMeters = 0;  ///< above mean sea level
  float opticalDepth = 0;               ///< vertical, where it is cloudy
  float windEast = 0, windNorth = 0;    ///< m/s at mid layer
  float shearEast = 0, shearNorth = 0;  ///< wind at the top minus wind at the base, m/s
};

/// What a source says of the ground at the cells that were asked for: one value a cell, or empty where it
/// says nothing.
struct Surface {
  std::vector<float> heightMeters;  ///< above mean sea level
  std::vector<float> pressurePa;
};

/// What a file holds, for reports.
struct SourceInfo {
  std::vector<std::string> files;
  std::string format, model;         ///< "GRIB2", "NCEP GFS"
  std::optional<base::UtcTime> run;  ///< start of the forecast
  base::UtcTime validTime;
  std::vector<std::string> fields;   ///< which variables serve as what, one line each
  std::vector<std::string> missing;  ///< what is not in the file and how it will be made, one line each
  std::vector<double>
      levelPressuresPa;  ///< of levels with cloud water, from the ground upwards; empty for typed layers
  std::vector<std::string> warnings;  ///< what looked wrong and what was done about it
};

/// A reader's hand-over: grid, time and levels one at a time, so that the whole model never stands in memory.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  virtual const Grid& grid() const = 0;

  /// Calls visit for each level from the ground upwards, with the values at `cells` (indices of the grid).
  /// Nothing is visited by sources that state typed layers only. Throws InputError on damaged data.
  virtual void visitLevels(std::span<const std::uint32_t> cells,
                           const std::function<void(const Level&)>& visit) const = 0;

  /// Orography and surface pressure at `cells`, as far as the source has them.
  virtual Surface surface(std::span<const std::uint32_t> cells) const {
    (void)cells;
    return {};
  }

  /// The layers that the source states outright at `cells`; empty for model output.
  virtual std::vector<TypedLayer> typedLayers(std::span<const std::uint32_t> cells) const {
    (void)cells;
    return {};
  }
};

}  // namespace cloudgen::field
