// SPDX-License-Identifier: Apache-2.0
#include "field/derivation.hpp"

namespace cloudgen::field {
namespace {

std::pair<std::string, std::string> lineOf(Derivation derivation) {
  switch (derivation) {
    case Derivation::GroundFromSurfacePressure:
      return {"ground height", "where the air has the surface pressure: no orography in the input"};
    case Derivation::GroundAtSeaLevel:
      return {"ground height", "sea level: heights are above ground, and no orography in the input"};
    case Derivation::HeightFromHeightAboveGround:
      return {"height", "height above ground plus the ground's height"};
    case Derivation::HeightFromSurface:
      return {"height",
              "hypsometric equation upwards from the surface pressure (Wallace & Hobbs 2006, eq. 3.29)"};
    case Derivation::HeightFromSeaLevel:
      return {"height",
              "hypsometric equation upwards from the sea-level pressure (Wallace & Hobbs 2006, eq. 3.29)"};
    case Derivation::HeightFromStandardAtmosphere:
      return {
          "height",
          "hypsometric equation upwards from the lowest known pressure at its height in the ICAO standard "
          "atmosphere"};
    case Derivation::PressureFromHeight:
      return {"pressure", "hypsometric equation from heights and temperatures"};
    case Derivation::PressureFromStandardAtmosphere:
      return {"pressure", "ICAO standard atmosphere at the lowest level, hypsometric equation above"};
    case Derivation::TemperatureFromThickness:
      return {"temperature", "hypsometric equation from the thickness between neighbouring levels"};
    case Derivation::TemperatureFromStandardAtmosphere:
      return {"temperature", "ICAO standard atmosphere"};
    case Derivation::HumidityFromSpecificHumidity:
      return {"relative humidity", "specific humidity over saturation (Buck 1981)"};
    case Derivation::FractionFromHumidityAndWater:
      return {"cloud fraction", "Xu & Randall 1996 from relative humidity and condensate"};
    case Derivation::FractionNotAllZero:
      return {"cloud fraction", "the input's is zero wherever it has cloud water, and is not used"};
    case Derivation::FractionFromHumidity:
      return {"cloud fraction",
              "derived from RH: Sundqvist 1989, critical humidity 0.9 at the ground to 0.7 aloft as in ECHAM "
              "(Lohmann & Roeckner 1996; Quaas 2012), none above 100 hPa"};
    case Derivation::FractionFull:
      return {"cloud fraction", "1 where there is cloud water: neither fraction nor humidity in the input"};
    case Derivation::WaterFromHumidity:
      return {"cloud water",
              "derived from RH: 0.21 g/m3 in cloud at the ground, falling with height by the precipitable "
              "water (Hack 1998, as in CCM3)"};
    case Derivation::WaterWithinModelClouds:
      return {"cloud base and top", "clouds derived from RH are cut to the model's own base and top"};
    case Derivation::PhaseFromTemperature:
      return {"liquid and ice", "condensate split by temperature: all liquid from 0 C, all ice to -23 C"};
    case Derivation::DepthOfLoneLevel:
      return {"depth of a lone level", "50 hPa to either side (300 m above 100 hPa)"};
  }
  return {};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Derivations::lines() const {
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t i = 0; i < kCount; ++i)
    if (noted_.test(i)) lines.push_back(lineOf(static_cast<Derivation>(i)));
  for (const Quantity quantity : interpolated_)
    lines.emplace_back(quantityName(quantity),
                       "interpolated in the logarithm of pressure on levels that lack it");
  return lines;
}

}  // namespace cloudgen::field
