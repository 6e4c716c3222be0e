// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <span>

#include "input/model/model_field.hpp"

namespace cloudgen::input::model {

/// What single-level fields say at one cell; fractions 0..1, heights in metres above mean sea level, NaN
/// where unknown.
struct CoverColumn {
  struct Part {
    float cover, baseMeters, topMeters;
  };
  std::map<CloudPart, Part> parts;
  float surfaceMeters = 0;
  double latitudeDegrees = 0;
};

/// The layers of a column that is known by cover alone, upwards. Where base and top are missing: low 600 to
/// 1500 m above ground, middle and high at the middle of the WMO etages of that latitude, 900 and 1200 m
/// deep. Optical depths by etage are assumed, of the order of ISCCP's means (Rossow & Schiffer 1999).
/// Convective cover becomes cumulus, cumulonimbus if over 5 km deep, and is taken from the low
/// cover. Total cover alone becomes one layer at the height of low cloud.
void visitCoverLayers(const CoverColumn& column, std::uint32_t cell,
                      const std::function<void(const field::StatedLayer&)>& visit);

}  // namespace cloudgen::input::model
