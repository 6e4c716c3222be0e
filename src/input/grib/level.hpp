// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/grib/product.hpp"
#include "input/model/model_field.hpp"

namespace cloudgen::input::grib {

/// Where in the vertical a field lies.
enum class Place {
  Surface,
  MeanSea,
  WholeAtmosphere,
  Level,      ///< one of many, as Level::vertical says
  HalfLevel,  ///< a border between generalised vertical layers; vertical.value is its number
  CloudBase,  ///< with Level::part
  CloudTop,
  CloudLayer,
  BoundaryLayerCloud,  ///< cover of cloud in the boundary layer, beside the low one
  GridScaleBase,       ///< of cloud that is not convective
  GridScaleTop,
  PressureLayer,  ///< between two pressures; vertical.value is their mean
  Elsewhere
};

struct Level {
  Place place = Place::Elsewhere;
  model::CloudPart part = model::CloudPart::Total;
  model::Vertical vertical;
};

Level levelOf(const Product& product);

}  // namespace cloudgen::input::grib
