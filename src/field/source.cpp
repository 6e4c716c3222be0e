// SPDX-License-Identifier: Apache-2.0
#include "field/source.hpp"

namespace cloudgen::field {

std::string_view quantityName(Quantity quantity) {
  switch (quantity) {
    case Quantity::CloudCondensate:
      return "cloud condensate";
    case Quantity::CloudLiquid:
      return "cloud liquid water";
    case Quantity::CloudIce:
      return "cloud ice";
    case Quantity::CloudFraction:
      return "cloud fraction";
    case Quantity::Temperature:
      return "temperature";
    case Quantity::RelativeHumidity:
      return "relative humidity";
    case Quantity::SpecificHumidity:
      return "specific humidity";
    case Quantity::GeopotentialHeight:
      return "geopotential height";
    case Quantity::Height:
      return "height";
    case Quantity::HeightAboveGround:
      return "height above ground";
    case Quantity::Pressure:
      return "pressure";
    case Quantity::WindEast:
      return "eastward wind";
    case Quantity::WindNorth:
      return "northward wind";
    case Quantity::VerticalVelocity:
      return "vertical velocity";
  }
  return "unknown quantity";
}

}  // namespace cloudgen::field
