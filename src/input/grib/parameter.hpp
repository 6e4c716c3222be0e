// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "input/grib/product.hpp"

namespace cloudgen::input::grib {

/// What a parameter measures, wherever it lies.
enum class What {
  CloudCondensate,
  CloudLiquid,
  CloudIce,
  Cover,  ///< of any part: the level says which
  LowCover,
  MiddleCover,
  HighCover,
  ConvectiveCover,
  Temperature,
  RelativeHumidity,
  SpecificHumidity,
  HumidityMixingRatio,
  GeopotentialHeight,
  Geopotential,  ///< m2/s2
  Height,        ///< geometric, m
  Pressure,
  SeaLevelPressure,
  LogSurfacePressure,
  WindEast,
  WindNorth,
  VerticalVelocity,  ///< Pa/s
  CloudBaseHeight,
  CloudTopHeight,
  ConvectiveCloudBaseHeight,
  ConvectiveCloudTopHeight,
  Rain,
  Snow,
  Graupel,
};

struct Parameter {
  What what{};
  std::string_view name;
  bool inPercent = false;
};

/// By the numbers of the file.
std::optional<Parameter> parameterOf(const Product& product);

/// Whether the numbers are the centre's own and not known here, so that ecCodes may know better.
bool hasOwnNumbers(const Product& product);

/// By the name that ecCodes has for it, where the numbers say nothing.
std::optional<Parameter> parameterNamed(std::string_view shortName);

}  // namespace cloudgen::input::grib
