// SPDX-License-Identifier: Apache-2.0
#include "field/air.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "field/cloud_water.hpp"
#include "field/hypsometry.hpp"
#include "field/standard_atmosphere.hpp"

namespace cloudgen::field {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

float valueOf(const Level& level, Quantity quantity, std::size_t column) {
  const auto found = level.values.find(quantity);
  return found == level.values.end() ? kMissing : found->second[column];
}

float valueOf(const std::vector<float>& values, std::size_t column) {
  return values.empty() ? kMissing : values[column];
}

/// The value, or missing where no air of this planet could have it.
double within(double value, double low, double high) {
  return value >= low && value <= high ? value : kMissing;
}

double givenPressure(const Level& level, std::size_t column) {
  const double ofCell = within(valueOf(level, Quantity::Pressure, column), 0.1, 120000);
  return std::isfinite(ofCell) ? ofCell : within(level.pressurePa, 0.1, 120000);
}

struct Humidity {
  double relative = kMissing, specific = kMissing;
};

/// What is missing of the two follows from the other; pressure or temperature may be unknown.
Humidity humidityOf(const Level& level, std::size_t column, double pressurePa, double temperatureK) {
  Humidity humidity;
  const double relative = valueOf(level, Quantity::RelativeHumidity, column);
  const double specific = valueOf(level, Quantity::SpecificHumidity, column);
  if (std::isfinite(relative)) humidity.relative = std::clamp(relative, 0.0, 2.0);
  if (std::isfinite(specific)) humidity.specific = std::clamp(specific, 0.0, 0.1);
  if (!(pressurePa > 0) || !(temperatureK > 0)) return humidity;
  const double saturation = saturationSpecificHumidity(pressurePa, temperatureK);
  if (!std::isfinite(humidity.relative)) humidity.relative = std::min(humidity.specific / saturation, 2.0);
  if (!std::isfinite(humidity.specific)) humidity.specific = humidity.relative * saturation;
  return humidity;
}

}  // namespace

AirMaker::AirMaker(const Grid& grid, const std::vector<std::uint32_t>& cells, const Surface& surface,
                   Derivations& derivations)
    : surface_(surface), derivations_(derivations) {
  const std::size_t count = cells.size();
  groundMeters_.resize(count, kMissing);
  groundPressurePa_.resize(count, kMissing);
  anchors_.resize(count, {kMissing, kMissing, kMissing});
  for (std::size_t c = 0; c < count; ++c) {
    latitudesDegrees_.push_back(static_cast<float>(centerOf(grid, cells[c]).latitudeDegrees));
    const double pressure = within(valueOf(surface.pressurePa, c), 30000, 120000);
    const double seaLevel = within(valueOf(surface.seaLevelPressurePa, c), 80000, 120000);
    const double height = within(valueOf(surface.heightMeters, c), -1000, 10000);
    const double geopotential = geopotentialHeight(height, latitudesDegrees_[c]);
    groundMeters_[c] = static_cast<float>(height);
    groundPressurePa_[c] =
        static_cast<float>(std::isfinite(pressure) ? pressure : standardPressure(geopotential));
    if (std::isfinite(pressure) && std::isfinite(height))
      starts_.push_back({pressure, geopotential, Derivation::HeightFromSurface});
    else if (std::isfinite(seaLevel))
      starts_.push_back({seaLevel, 0, Derivation::HeightFromSeaLevel});
    else
      starts_.push_back({pressure, standardHeight(pressure), Derivation::HeightFromStandardAtmosphere});
  }
}

AirLevel AirMaker::next(const Level& level, const Level* above) {
  AirLevel air;
  for (auto* values : {&air.pressurePa, &air.temperatureK, &air.dewPointK, &air.relativeHumidity,
                       &air.specificHumidity, &air.geopotentialMeters, &air.heightMeters})
    values->resize(anchors_.size(), kMissing);
  for (std::size_t c = 0; c < anchors_.size(); ++c) fill(level, above, c, air);
  if (level.has(Quantity::SpecificHumidity) && !level.has(Quantity::RelativeHumidity))
    derivations_.note(Derivation::HumidityFromSpecificHumidity);
  below_ = air;
  return air;
}

void AirMaker::fill(const Level& level, const Level* above, std::size_t c, AirLevel& air) {
  double pressure = givenPressure(level, c);
  double geopotential = givenGeopotential(level, c);
  const double kelvin = temperature(level, above, c, pressure, geopotential);
  if (!std::isfinite(pressure)) {
    // The humidity that makes the air lighter needs a pressure: that of dry air does.
    const double dry = pressureAt(c, geopotential, kelvin);
    const double vapour = humidityOf(level, c, dry, kelvin).specific;
    pressure = pressureAt(c, geopotential, virtualTemperature(kelvin, vapour));
  }
  const Humidity humidity = humidityOf(level, c, pressure, kelvin);
  const double virtualKelvin = virtualTemperature(kelvin, humidity.specific);
  if (!std::isfinite(geopotential)) geopotential = geopotentialAt(c, pressure, virtualKelvin);
  settleGround(c, pressure, virtualKelvin, geopotential);
  // Air below the ground is nothing to go on from.
  const bool underGround = pressure > starts_[c].pressurePa;
  if (!underGround && std::isfinite(pressure + virtualKelvin + geopotential))
    anchors_[c] = {pressure, virtualKelvin, geopotential};

  air.pressurePa[c] = static_cast<float>(pressure);
  air.temperatureK[c] = static_cast<float>(kelvin);
  air.relativeHumidity[c] = static_cast<float>(humidity.relative);
  air.specificHumidity[c] = static_cast<float>(humidity.specific);
  if (humidity.relative > 0) air.dewPointK[c] = static_cast<float>(dewPoint(kelvin, humidity.relative));
  air.geopotentialMeters[c] = static_cast<float>(geopotential);
  const double given = within(valueOf(level, Quantity::Height, c), -2000, 100000);
  air.heightMeters[c] =
      static_cast<float>(std::isfinite(given) ? given : geometricHeight(geopotential, latitudesDegrees_[c]));
}

double AirMaker::givenGeopotential(const Level& level, std::size_t c) {
  const double latitude = latitudesDegrees_[c];
  const double height = within(valueOf(level, Quantity::Height, c), -2000, 100000);
  if (std::isfinite(height)) return geopotentialHeight(height, latitude);
  const double geopotential = within(valueOf(level, Quantity::GeopotentialHeight, c), -2000, 100000);
  if (std::isfinite(geopotential)) return geopotential;
  const double aboveGround = within(valueOf(level, Quantity::HeightAboveGround, c), -500, 100000);
  if (!std::isfinite(aboveGround)) return kMissing;
  derivations_.note(Derivation::HeightFromHeightAboveGround);
  float& ground = groundMeters_[c];
  if (!std::isfinite(ground)) {
    const double standard = standardHeight(valueOf(surface_.pressurePa, c));
    const bool known = std::isfinite(standard);
    derivations_.note(known ? Derivation::GroundFromSurfacePressure : Derivation::GroundAtSeaLevel);
    ground = known ? static_cast<float>(standard) : 0.0f;
    starts_[c].geopotentialMeters = geopotentialHeight(ground, latitude);
  }
  return geopotentialHeight(ground + aboveGround, latitude);
}

double AirMaker::temperature(const Level& level, const Level* above, std::size_t c, double pressurePa,
                             double geopotentialMeters) {
  if (level.has(Quantity::Temperature)) return within(valueOf(level, Quantity::Temperature, c), 100, 400);
  const double virtualKelvin = thicknessTemperature(above, c, pressurePa, geopotentialMeters);
  if (virtualKelvin >= 150 && virtualKelvin <= 350) {
    derivations_.note(Derivation::TemperatureFromThickness);
    return temperatureFromVirtual(virtualKelvin, humidityOf(level, c, pressurePa, virtualKelvin).specific);
  }
  const double standard = standardTemperature(std::isfinite(geopotentialMeters) ? geopotentialMeters
                                                                                : standardHeight(pressurePa));
  if (std::isfinite(standard)) derivations_.note(Derivation::TemperatureFromStandardAtmosphere);
  return standard;
}

/// The layers to the level below and above have their mean temperatures half-way (in the logarithm of
/// pressure); the level's own lies on the line through them. With one layer only the standard lapse rate
/// leads from its middle to the level.
double AirMaker::thicknessTemperature(const Level* above, std::size_t c, double pressurePa,
                                      double geopotentialMeters) {
  const auto layer = [&](double otherPressure, double otherGeopotential) {
    return meanVirtualTemperature(pressurePa, otherPressure, otherGeopotential - geopotentialMeters);
  };
  const double lowPressure = valueOf(below_.pressurePa, c);
  const double lowGeopotential = valueOf(below_.geopotentialMeters, c);
  const double highPressure = above ? givenPressure(*above, c) : kMissing;
  const double highGeopotential = above ? givenGeopotential(*above, c) : kMissing;
  const double low = layer(lowPressure, lowGeopotential), high = layer(highPressure, highGeopotential);
  if (std::isfinite(low) && std::isfinite(high)) {
    const double share = std::log(lowPressure / pressurePa) / std::log(lowPressure / highPressure);
    return low + share * (high - low);
  }
  const double lapse = geopotentialMeters < 11000 ? kStandardLapseRate : 0.0;
  if (std::isfinite(high)) return high + 0.5 * lapse * (highGeopotential - geopotentialMeters);
  return low - 0.5 * lapse * (geopotentialMeters - lowGeopotential);
}

double AirMaker::geopotentialAt(std::size_t c, double pressurePa, double virtualTemperatureK) {
  const Anchor& anchor = anchors_[c];
  const Start& start = starts_[c];
  if (!std::isfinite(pressurePa + virtualTemperatureK)) return kMissing;
  derivations_.note(start.height);
  if (std::isfinite(anchor.pressurePa))
    return anchor.geopotentialMeters +
           thickness(anchor.pressurePa, pressurePa, 0.5 * (anchor.virtualTemperatureK + virtualTemperatureK));
  if (std::isfinite(start.pressurePa))
    return start.geopotentialMeters + thicknessFromGround(start.pressurePa, pressurePa, virtualTemperatureK);
  return standardHeight(pressurePa);
}

double AirMaker::pressureAt(std::size_t c, double geopotentialMeters, double virtualTemperatureK) {
  const Anchor& anchor = anchors_[c];
  const Start& start = starts_[c];
  if (!std::isfinite(geopotentialMeters + virtualTemperatureK)) return kMissing;
  const bool known = std::isfinite(start.pressurePa);
  derivations_.note(known ? Derivation::PressureFromHeight : Derivation::PressureFromStandardAtmosphere);
  if (std::isfinite(anchor.pressurePa))
    return pressureAfter(anchor.pressurePa, geopotentialMeters - anchor.geopotentialMeters,
                         0.5 * (anchor.virtualTemperatureK + virtualTemperatureK));
  if (known)
    return pressureFromGround(start.pressurePa, geopotentialMeters - start.geopotentialMeters,
                              virtualTemperatureK);
  return standardPressure(geopotentialMeters);
}

void AirMaker::settleGround(std::size_t c, double pressurePa, double virtualTemperatureK,
                            double geopotentialMeters) {
  if (!std::isfinite(pressurePa + virtualTemperatureK + geopotentialMeters)) return;
  if (!std::isfinite(groundPressurePa_[c])) groundPressurePa_[c] = static_cast<float>(pressurePa);
  if (std::isfinite(groundMeters_[c]) || !(pressurePa <= valueOf(surface_.pressurePa, c))) return;
  const double rise = thicknessFromGround(surface_.pressurePa[c], pressurePa, virtualTemperatureK);
  groundMeters_[c] = static_cast<float>(geometricHeight(geopotentialMeters - rise, latitudesDegrees_[c]));
  derivations_.note(Derivation::GroundFromSurfacePressure);
}

}  // namespace cloudgen::field
