// SPDX-License-Identifier: Apache-2.0
#include "input/grib/meaning.hpp"

namespace cloudgen::input::grib {
namespace {

using field::Quantity;
using model::CloudPart;
using model::Single;
using model::SingleKind;

std::optional<Meaning> onLevel(What what) {
  switch (what) {
    case What::CloudCondensate:
      return Meaning{Quantity::CloudCondensate};
    case What::CloudLiquid:
      return Meaning{Quantity::CloudLiquid};
    case What::CloudIce:
      return Meaning{Quantity::CloudIce};
    case What::Cover:
      return Meaning{Quantity::CloudFraction};
    case What::Temperature:
      return Meaning{Quantity::Temperature};
    case What::RelativeHumidity:
      return Meaning{Quantity::RelativeHumidity};
    case What::SpecificHumidity:
      return Meaning{Quantity::SpecificHumidity};
    case What::HumidityMixingRatio:
      return Meaning{Quantity::SpecificHumidity, Conversion::MixingRatioToSpecific};
    case What::GeopotentialHeight:
      return Meaning{Quantity::GeopotentialHeight};
    case What::Geopotential:
      return Meaning{Quantity::GeopotentialHeight, Conversion::PerGravity};
    case What::Height:
      return Meaning{Quantity::Height};
    case What::Pressure:
      return Meaning{Quantity::Pressure};
    case What::LogSurfacePressure:  // stands on the first of the hybrid levels
      return Meaning{Single{SingleKind::LogSurfacePressure}};
    case What::WindEast:
      return Meaning{Quantity::WindEast};
    case What::WindNorth:
      return Meaning{Quantity::WindNorth};
    case What::VerticalVelocity:
      return Meaning{Quantity::VerticalVelocity};
    default:
      return std::nullopt;
  }
}

/// The storey of a layer between two pressures (DWD: borders at 800 and 400 hPa).
CloudPart partAt(double pressurePa) {
  return pressurePa > 75000 ? CloudPart::Low : pressurePa > 45000 ? CloudPart::Middle : CloudPart::High;
}

std::optional<Meaning> coverAt(const Level& level) {
  switch (level.place) {
    case Place::Surface:
    case Place::WholeAtmosphere:
      return Meaning{Single{SingleKind::CloudCover}};
    case Place::CloudLayer:
      return Meaning{Single{SingleKind::CloudCover, level.part}};
    case Place::BoundaryLayerCloud:
      return Meaning{Single{SingleKind::CloudCover, level.part}, Conversion::None, true};
    case Place::PressureLayer:
      return Meaning{Single{SingleKind::CloudCover, partAt(level.vertical.value)}};
    default:
      return std::nullopt;
  }
}

/// A height (or a pressure) of a surface in the air.
std::optional<Meaning> atCloud(const Level& level, SingleKind base, SingleKind top) {
  const bool gridScale = level.place == Place::GridScaleBase || level.place == Place::GridScaleTop;
  if (level.place == Place::CloudBase || level.place == Place::GridScaleBase)
    return Meaning{Single{base, level.part}, Conversion::None, gridScale};
  if (level.place == Place::CloudTop || level.place == Place::GridScaleTop)
    return Meaning{Single{top, level.part}, Conversion::None, gridScale};
  return std::nullopt;
}

std::optional<Meaning> heightAt(const Level& level, Conversion conversion) {
  if (level.place == Place::Surface) return Meaning{Single{SingleKind::SurfaceHeight}, conversion};
  auto meaning = atCloud(level, SingleKind::CloudBaseHeight, SingleKind::CloudTopHeight);
  if (meaning) meaning->conversion = conversion;
  return meaning;
}

std::optional<Meaning> besideLevels(What what, const Level& level) {
  const bool below = level.place == Place::Surface || level.place == Place::MeanSea;
  switch (what) {
    case What::Cover:
      return coverAt(level);
    case What::LowCover:
      return Meaning{Single{SingleKind::CloudCover, CloudPart::Low}};
    case What::MiddleCover:
      return Meaning{Single{SingleKind::CloudCover, CloudPart::Middle}};
    case What::HighCover:
      return Meaning{Single{SingleKind::CloudCover, CloudPart::High}};
    case What::ConvectiveCover:
      return Meaning{Single{SingleKind::CloudCover, CloudPart::Convective}};
    case What::GeopotentialHeight:
    case What::Height:
      return heightAt(level, Conversion::None);
    case What::Geopotential:
      return heightAt(level, Conversion::PerGravity);
    case What::Pressure:
      if (level.place == Place::Surface) return Meaning{Single{SingleKind::SurfacePressure}};
      if (level.place == Place::MeanSea) return Meaning{Single{SingleKind::SeaLevelPressure}};
      return atCloud(level, SingleKind::CloudBasePressure, SingleKind::CloudTopPressure);
    case What::SeaLevelPressure:
      return below ? std::optional(Meaning{Single{SingleKind::SeaLevelPressure}}) : std::nullopt;
    case What::LogSurfacePressure:
      return below ? std::optional(Meaning{Single{SingleKind::LogSurfacePressure}}) : std::nullopt;
    case What::CloudBaseHeight:
      return Meaning{Single{SingleKind::CloudBaseHeight, level.part}};
    case What::CloudTopHeight:
      return Meaning{Single{SingleKind::CloudTopHeight, level.part}};
    case What::ConvectiveCloudBaseHeight:
      return Meaning{Single{SingleKind::CloudBaseHeight, CloudPart::Convective}};
    case What::ConvectiveCloudTopHeight:
      return Meaning{Single{SingleKind::CloudTopHeight, CloudPart::Convective}};
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Meaning> meaningOf(const Parameter& parameter, const Level& level) {
  if (level.place == Place::Level) return onLevel(parameter.what);
  if (level.place == Place::HalfLevel && parameter.what != What::Height) return std::nullopt;
  return besideLevels(parameter.what, level);
}

bool falls(What what) { return what == What::Rain || what == What::Snow || what == What::Graupel; }

}  // namespace cloudgen::input::grib
