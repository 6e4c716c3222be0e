// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/derivation.hpp"
#include "field/grid.hpp"
#include "field/source.hpp"

namespace cloudgen::field {

/// The air of a level in every column; NaN where it is missing.
struct AirLevel {
  std::vector<float> pressurePa, temperatureK, dewPointK;
  std::vector<float> relativeHumidity, specificHumidity;  ///< 0..2, kg/kg
  std::vector<float> geopotentialMeters, heightMeters;    ///< above mean sea level
};

/// Makes the air of one level after the other, from the ground upwards, of whatever the levels tell:
/// - height: Height, else GeopotentialHeight, else HeightAboveGround on the orography, else by the
/// hypsometric
///   equation from the level below, the lowest one from surface pressure and orography, else from the
///   sea-level pressure, else from the surface pressure or its own at its height in the ICAO standard
///   atmosphere;
/// - pressure: of the cell, else of the level, else by the same equation from the height;
/// - temperature: given, else from the thickness to the neighbouring levels, else ICAO standard atmosphere.
class AirMaker {
 public:
  AirMaker(const Grid& grid, const std::vector<std::uint32_t>& cells, const Surface& surface,
           Derivations& derivations);

  /// `above` is the next level, or null.
  AirLevel next(const Level& level, const Level* above);

  /// Height of the ground, m above mean sea level: orography, else where the air passed so far reaches the
  /// surface pressure; NaN where neither is known.
  const std::vector<float>& groundMeters() const { return groundMeters_; }
  /// Pressure at the ground: given, else of the standard atmosphere at the orography, else of the lowest
  /// level.
  const std::vector<float>& groundPressurePa() const { return groundPressurePa_; }

 private:
  /// A place in the column from which heights and pressures go on; NaN: none yet.
  struct Anchor {
    double pressurePa, virtualTemperatureK, geopotentialMeters;
  };
  struct Start {
    double pressurePa, geopotentialMeters;
    Derivation height;
  };
  void fill(const Level& level, const Level* above, std::size_t column, AirLevel& air);
  double givenGeopotential(const Level& level, std::size_t column);
  double temperature(const Level& level, const Level* above, std::size_t column, double pressurePa,
                     double geopotentialMeters);
  double thicknessTemperature(const Level* above, std::size_t column, double pressurePa,
                              double geopotentialMeters);
  double geopotentialAt(std::size_t column, double pressurePa, double virtualTemperatureK);
  double pressureAt(std::size_t column, double geopotentialMeters, double virtualTemperatureK);
  void settleGround(std::size_t column, double pressurePa, double virtualTemperatureK,
                    double geopotentialMeters);

  const Surface& surface_;
  Derivations& derivations_;
  std::vector<float> latitudesDegrees_, groundMeters_, groundPressurePa_;
  std::vector<Start> starts_;
  std::vector<Anchor> anchors_;
  AirLevel below_;
};

}  // namespace cloudgen::field
