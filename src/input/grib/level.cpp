// SPDX-License-Identifier: Apache-2.0
// WMO code tables 3 (edition 1) and 4.5 (edition 2), with NCEP's local types from 192, which mean the same in
// both editions.
#include "input/grib/level.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::input::grib {
namespace {

using model::CloudPart;
using model::Vertical;
using model::VerticalKind;

Level levelAt(VerticalKind kind, double value) {
  Level level{Place::Level, CloudPart::Total, {}};
  level.vertical.kind = kind;
  level.vertical.value = value;
  return level;
}

/// NCEP's types of cloud levels; other centres with tables of their own use these numbers in the same sense
/// or not at all.
Level cloudLevel(int type) {
  constexpr CloudPart kParts[] = {CloudPart::Low, CloudPart::Middle, CloudPart::High, CloudPart::Convective};
  constexpr int kFirst[] = {212, 222, 232, 242};
  constexpr Place kPlaces[] = {Place::CloudBase, Place::CloudTop, Place::CloudLayer};
  for (int i = 0; i < 4; ++i)
    if (type >= kFirst[i] && type <= kFirst[i] + 2) return {kPlaces[type - kFirst[i]], kParts[i], {}};
  if (type == 200) return {Place::WholeAtmosphere, CloudPart::Total, {}};
  if (type == 206) return {Place::GridScaleBase, CloudPart::Total, {}};
  if (type == 207) return {Place::GridScaleTop, CloudPart::Total, {}};
  if (type == 211) return {Place::BoundaryLayerCloud, CloudPart::Low, {}};
  return {};
}

/// Coordinates are pairs for p = a + b ps if b runs up to 1 at the ground (COSMO keeps other numbers there).
bool areHalfLevels(const std::vector<double>& coordinates) {
  const std::size_t count = coordinates.size() / 2;
  if (coordinates.size() % 2 != 0 || count < 2) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = coordinates[i], b = coordinates[count + i];
    if (!std::isfinite(a) || !std::isfinite(b) || b < -1e-6 || b > 1 + 1e-6 || a < -1 || a > 120000)
      return false;
  }
  return std::max(coordinates[count], coordinates.back()) > 0.9;
}

/// The level between the half levels `number` - 1 and `number`, counted from 0 as the file lists them.
Level hybridLevel(const Product& product, double number) {
  Level level = levelAt(VerticalKind::ModelLevel, number);
  const std::vector<double>& pairs = product.coordinates;
  if (number < 1 || number >= static_cast<double>(pairs.size() / 2) || !areHalfLevels(pairs)) return level;
  const auto below = static_cast<std::size_t>(number);
  level.vertical.kind = VerticalKind::Hybrid;
  level.vertical.a = 0.5 * (pairs[below - 1] + pairs[below]);
  level.vertical.b = 0.5 * (pairs[pairs.size() / 2 + below - 1] + pairs[pairs.size() / 2 + below]);
  return level;
}

Level pressureLayer(double one, double other) {
  Level level = levelAt(VerticalKind::Pressure, 0.5 * (one + other));
  level.place = Place::PressureLayer;
  return level;
}

Level levelOf2(const Product& product) {
  const double value = product.firstValue, other = product.secondValue;
  const bool layer = product.secondType == product.firstType;
  switch (product.firstType) {
    case 1:
      return product.secondType == 8 ? Level{Place::WholeAtmosphere, CloudPart::Total, {}}
                                     : Level{Place::Surface, CloudPart::Total, {}};
    case 2:
      return {Place::CloudBase, CloudPart::Total, {}};
    case 3:
      return {Place::CloudTop, CloudPart::Total, {}};
    case 8:
    case 10:
      return {Place::WholeAtmosphere, CloudPart::Total, {}};
    case 100:
      if (layer) return pressureLayer(value, other);
      // DWD's low cloud: from 800 hPa down to the ground.
      if (product.secondType == 1) return pressureLayer(value, 101325);
      return value > 0 && value <= 120000 ? levelAt(VerticalKind::Pressure, value) : Level{};
    case 101:
      return {Place::MeanSea, CloudPart::Total, {}};
    case 102:
      return levelAt(VerticalKind::HeightAboveSea, layer ? 0.5 * (value + other) : value);
    case 103:
      return levelAt(VerticalKind::HeightAboveGround, layer ? 0.5 * (value + other) : value);
    case 104:
      return levelAt(VerticalKind::Sigma, layer ? 0.5 * (value + other) : value);
    case 105:
    case 119:
      return hybridLevel(product, value);
    case 111:  // eta
    case 118:  // hybrid height
      return levelAt(VerticalKind::ModelLevel, value);
    case 150: {
      Level level = levelAt(VerticalKind::ModelLevel, value);
      if (!layer) level.place = Place::HalfLevel;
      return level;
    }
    default:
      return cloudLevel(product.firstType);
  }
}

Level levelOf1(const Product& product) {
  const double value = product.firstValue;  // of both octets
  const double below = product.secondValue, above = std::floor(value / 256);
  switch (product.firstType) {
    case 1:
      return {Place::Surface, CloudPart::Total, {}};
    case 2:
      return {Place::CloudBase, CloudPart::Total, {}};
    case 3:
      return {Place::CloudTop, CloudPart::Total, {}};
    case 8:
      return {Place::WholeAtmosphere, CloudPart::Total, {}};
    case 100:
      return value > 0 && value <= 1200 ? levelAt(VerticalKind::Pressure, 100 * value) : Level{};
    case 210:
      return value > 0 ? levelAt(VerticalKind::Pressure, value) : Level{};
    case 101:  // in kPa
      return pressureLayer(1000 * above, 1000 * below);
    case 102:
      return {Place::MeanSea, CloudPart::Total, {}};
    case 103:
      return levelAt(VerticalKind::HeightAboveSea, value);
    case 104:
      return levelAt(VerticalKind::HeightAboveSea, 50 * (above + below));
    case 105:
      return levelAt(VerticalKind::HeightAboveGround, value);
    case 106:
      return levelAt(VerticalKind::HeightAboveGround, 50 * (above + below));
    case 107:
      return levelAt(VerticalKind::Sigma, value / 10000);
    case 108:
      return levelAt(VerticalKind::Sigma, (above + below) / 200);
    case 109: {
      Level level = hybridLevel(product, value);
      // COSMO: heights of half levels stand on type 109, layers between them on type 110.
      if (!product.coordinates.empty() && !areHalfLevels(product.coordinates)) level.place = Place::HalfLevel;
      return level;
    }
    case 110:
      return hybridLevel(product, above);
    case 119:
      return levelAt(VerticalKind::ModelLevel, value);
    default:
      return cloudLevel(product.firstType);
  }
}

}  // namespace

Level levelOf(const Product& product) { return product.edition == 1 ? levelOf1(product) : levelOf2(product); }

}  // namespace cloudgen::input::grib
