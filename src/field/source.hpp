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
  Height,              ///< m above mean sea level (geometric)
  HeightAboveGround,   ///< m
  Pressure,            ///< Pa
  WindEast,            ///< m/s, towards the east
  WindNorth,
  VerticalVelocity,  ///< Pa/s, positive downwards
};

/// "cloud condensate", "temperature", ...: for reports and messages.
std::string_view quantityName(Quantity quantity);

/// One model level over the cells that were asked for (same order, one value a cell).
struct Level {
  double pressurePa = 0;  ///< of isobaric levels; 0 where pressure is a value a cell, or unknown
  std::map<Quantity, std::vector<float>> values;

  bool has(Quantity quantity) const { return values.contains(quantity); }
  std::span<const float> of(Quantity quantity) const { return values.at(quantity); }
};

/// A cloud layer that a source states outright (CDFS typing, a weather code, a METAR, low-middle-high cover,
/// a described sky), in one cell.
struct StatedLayer {
  std::uint32_t cell = 0;
  std::optional<base::Genus> genus;     ///< nothing: the type rules decide
  float coverFraction = 0;              ///< 0..1
  float baseMeters = 0, topMeters = 0;  ///< above mean sea level
  float opticalDepth = 0;               ///< vertical, where it is cloudy
  float iceShare = 0;                   ///< of the optical depth, 0..1
  int cloudCount = 0;       ///< clouds in this cell where the source counts them (weather codes); 0: by cover
  float spacingMeters = 0;  ///< least distance between those clouds
  std::uint16_t ageMinutes = 0;         ///< of the observation before the valid time
  float windEast = 0, windNorth = 0;    ///< m/s at mid layer
  float shearEast = 0, shearNorth = 0;  ///< wind at the top minus wind at the base, m/s
};

/// What a source says of the ground at the cells that were asked for: one value a cell, or empty where it
/// says nothing.
struct Surface {
  std::vector<float> heightMeters;  ///< orography, above mean sea level
  std::vector<float> pressurePa;
  std::vector<float> seaLevelPressurePa;
  /// Of all cloud in the column, above mean sea level; NaN where there is none.
  std::vector<float> cloudBaseMeters, cloudTopMeters;
};

/// Something that looked wrong in the input, and what was done about it. The ids are those of
/// schemas/inspect.schema.json ("cover_in_percent", "negative_condensate", ...).
struct Warning {
  std::string id, text;
};

/// The levels that clouds are taken from, from the ground upwards.
struct LevelList {
  std::string kind;  ///< "pressure", "hybrid", "height above sea", ...; empty: none
  std::string unit;  ///< "hPa", "m", "" for numbers
  std::vector<double> values;
};

/// What a file holds, for reports.
struct SourceInfo {
  std::vector<std::string> files;
  std::string format, model;         ///< "GRIB2", "NCEP GFS"
  std::optional<base::UtcTime> run;  ///< start of the forecast
  base::UtcTime validTime;
  std::vector<base::UtcTime> validTimes;  ///< all that the input has, ascending
  LevelList levels;
  std::vector<std::string> fields;   ///< which variables serve as what, one line each
  std::vector<std::string> unused;   ///< known but not used, one line each
  std::vector<std::string> missing;  ///< what is not in the file and how it will be made, one line each
  std::vector<Warning> warnings;
};

/// How a source tells its clouds.
enum class Telling {
  Levels,  ///< water or humidity on model levels: visitLevels
  Layers   ///< layers stated outright: visitLayers
};

/// A reader's hand-over: grid, time and levels one at a time, so that the whole model never stands in memory.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  virtual const Grid& grid() const = 0;
  virtual Telling telling() const = 0;

  /// Calls visit for each level from the ground upwards, with the values at `cells` (indices of the grid).
  /// Winds blow towards true east and north. With no cells the levels come without values, so that it costs
  /// nothing to learn which quantities are on which level. Nothing is visited by sources of layers. Throws
  /// InputError on damaged data.
  virtual void visitLevels(std::span<const std::uint32_t> cells,
                           const std::function<void(const Level&)>& visit) const = 0;

  /// Orography, pressures and the like at `cells`, as far as the source has them.
  virtual Surface surface(std::span<const std::uint32_t> cells) const {
    (void)cells;
    return {};
  }

  /// Calls visit for each layer that the source states outright at `cells`, cell by cell in their order,
  /// upwards.
  virtual void visitLayers(std::span<const std::uint32_t> cells,
                           const std::function<void(const StatedLayer&)>& visit) const {
    (void)cells, (void)visit;
  }
};

}  // namespace cloudgen::field
