// SPDX-License-Identifier: Apache-2.0
#include "input/model/cover_layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cloudgen::input::model {
namespace {

using base::Genus;

constexpr float kLeastCover = 0.01f;

struct Typical {
  float baseMeters, depthMeters, opticalDepth, iceShare;
};

/// Heights where the file gives none: middles of the WMO etages, which sink towards the poles.
Typical typicalOf(CloudPart part, const CoverColumn& column) {
  const auto warm =
      static_cast<float>(std::pow(std::cos(column.latitudeDegrees * std::numbers::pi / 180), 2));
  switch (part) {
    case CloudPart::Middle:
      return {std::max(2800.0f + 1400.0f * warm, column.surfaceMeters + 300), 900, 4.8f, 0.4f};
    case CloudPart::High:
      return {std::max(5500.0f + 5500.0f * warm, column.surfaceMeters + 2000), 1200, 2.2f, 1};
    case CloudPart::Convective:
      return {column.surfaceMeters + 800, 1500, 10, 0};
    case CloudPart::Total:
    case CloudPart::Low:
      break;
  }
  return {column.surfaceMeters + 600, 900, 4.7f, 0};
}

/// Base and top of a part: the file's where it has both, in order and above the ground.
std::pair<float, float> heightsOf(const CoverColumn::Part& part, const Typical& typical,
                                  float surfaceMeters) {
  const float base = std::max(part.baseMeters, surfaceMeters);
  if (std::isfinite(part.baseMeters) && part.topMeters - base >= 50) return {base, part.topMeters};
  if (std::isfinite(part.topMeters) && part.topMeters - surfaceMeters >= 150)
    return {std::max(part.topMeters - typical.depthMeters, surfaceMeters + 50), part.topMeters};
  if (std::isfinite(part.baseMeters)) return {base, base + typical.depthMeters};
  return {typical.baseMeters, typical.baseMeters + typical.depthMeters};
}

field::StatedLayer layerOf(CloudPart kind, const CoverColumn::Part& part, const CoverColumn& column,
                           std::uint32_t cell) {
  constexpr float kDeepConvection = 5000;
  const Typical typical = typicalOf(kind, column);
  field::StatedLayer layer;
  layer.cell = cell;
  layer.coverFraction = part.cover;
  std::tie(layer.baseMeters, layer.topMeters) = heightsOf(part, typical, column.surfaceMeters);
  layer.opticalDepth = typical.opticalDepth;
  layer.iceShare = typical.iceShare;
  if (kind == CloudPart::Convective) {
    const bool deep = layer.topMeters - layer.baseMeters > kDeepConvection;
    layer.genus = deep ? Genus::Cumulonimbus : Genus::Cumulus;
    if (deep) layer.opticalDepth = 60;
  }
  return layer;
}

}  // namespace

void visitCoverLayers(const CoverColumn& column, std::uint32_t cell,
                      const std::function<void(const field::StatedLayer&)>& visit) {
  std::map<CloudPart, CoverColumn::Part> parts = column.parts;
  const auto coverOf = [&](CloudPart part) {
    const auto found = parts.find(part);
    return found != parts.end() && found->second.cover > 0 ? found->second.cover : 0.0f;
  };
  const bool byHeight =
      parts.contains(CloudPart::Low) || parts.contains(CloudPart::Middle) || parts.contains(CloudPart::High);
  if (byHeight) parts.erase(CloudPart::Total);
  const CloudPart lowest = byHeight ? CloudPart::Low : CloudPart::Total;
  if (parts.contains(lowest)) {
    const float rest = coverOf(lowest) - coverOf(CloudPart::Convective);
    parts[lowest].cover = std::max(0.0f, rest);
  }
  std::vector<field::StatedLayer> layers;
  for (const auto& [kind, part] : parts)
    if (part.cover >= kLeastCover) layers.push_back(layerOf(kind, part, column, cell));
  std::stable_sort(layers.begin(), layers.end(),
                   [](const auto& a, const auto& b) { return a.baseMeters < b.baseMeters; });
  for (const field::StatedLayer& layer : layers) visit(layer);
}

}  // namespace cloudgen::input::model
