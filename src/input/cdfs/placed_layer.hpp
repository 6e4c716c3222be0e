// SPDX-License-Identifier: Apache-2.0
// Inline, since it is asked for millions of layers.
#pragma once

#include <algorithm>
#include <optional>

#include "input/cdfs/analysis.hpp"

namespace cloudgen::input::cdfs {

/// Heights above this one are damage.
inline constexpr float kHighestMeters = 25000;

/// A height above mean sea level, or 0 where there is none: "no cloud" is written as 0 or below.
inline float heightIn(const std::vector<std::int16_t>& column, std::size_t slot) {
  if (column.empty()) return 0;
  const float height = column[slot];
  return height > 0 && height <= kHighestMeters ? height : 0;
}

/// A layer as it will be told: kind, heights in metres above mean sea level, optical depth.
struct PlacedLayer {
  const CloudKind* kind = nullptr;
  float baseMeters = 0, topMeters = 0, opticalDepth = 0;
  bool baseAssumed = false, depthAssumed = false;
};

/// The layer in `slot` (cell * kLayers + layer). Where a base is missing it is the top minus the depth of its
/// type, but not under the type's least base, nor under half the top; a missing top is the base plus that
/// depth. Nothing where neither is there.
inline std::optional<PlacedLayer> placedLayer(const Analysis& analysis, std::size_t slot) {
  PlacedLayer layer;
  layer.topMeters = heightIn(analysis.top, slot);
  layer.baseMeters = heightIn(analysis.base, slot);
  const float known = std::max(layer.topMeters, layer.baseMeters);
  if (!(known > 0)) return std::nullopt;
  layer.kind = analysis.type.empty() ? nullptr : &kindOf(analysis.table, analysis.type[slot]);
  if (!layer.kind || !layer.kind->genus) layer.kind = &unknownKind(known);
  const CloudKind& kind = *layer.kind;
  if (!(layer.topMeters > 0)) {
    layer.topMeters = layer.baseMeters + kind.depthMeters;
  } else if (!(layer.baseMeters > 0 && layer.baseMeters < layer.topMeters)) {
    layer.baseAssumed = true;
    layer.baseMeters =
        std::max(layer.topMeters - kind.depthMeters, std::min(kind.leastBaseMeters, 0.5f * layer.topMeters));
  }
  const float given = analysis.opticalDepth.empty() ? 0 : analysis.opticalDepth[slot];
  layer.depthAssumed = !(given > 0);
  layer.opticalDepth = layer.depthAssumed ? kind.opticalDepth : std::min(given, 1000.0f);
  return layer;
}

}  // namespace cloudgen::input::cdfs
