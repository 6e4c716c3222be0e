// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {

RawShape shapeVeil(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const std::uint64_t noiseSeed = request.seed * 37 + request.variant;
  // The window 1.4 widths across fades like a Gaussian, so that overlapping elements add up to an even sheet.
  const int across = std::max(3, static_cast<int>(std::sqrt(request.puffs * 1.15)));
  const double span = 1.35 * width, spacing = span / across;
  const double stretch = 1.0 + 2.0 * recipe.fibre;
  const int blocks = std::max(1, std::min(recipe.sections, across / 3));
  RawShape shape;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) {
      const glm::dvec3 jitter = place(recipe.billboardPlacement, 1, fills).front();
      glm::dvec3 p((column + jitter.x) * spacing - 0.5 * span, 0, (row + jitter.z) * spacing - 0.5 * span);
      const double q = std::hypot(p.x, p.z) / width;
      if (q > 0.68) continue;
      const double window =
          std::exp(-0.5 * (q / 0.29) * (q / 0.29)) * (1.0 - base::smoothStep(0.52, 0.68, q));
      // Fibres along the wind, or soft unevenness; a swell lifts top and base together.
      const double grain = base::fractalNoise(
          {p.x * 9.0 / (width * stretch * stretch), 0.5, p.z * 9.0 * stretch / width}, 4, noiseSeed);
      const double swell = base::fractalNoise({p.x * 4.0 / width, 2.5, p.z * 4.0 / width}, 2, noiseSeed + 3);
      const double size = spacing * fills.uniform(0.62, 0.95);
      const double low = fills.uniform();
      Puff puff;
      // Thin slices at all heights, the thinnest near base and top, so that a deep layer ends where it should
      // and does not fade out far beyond.
      const double y = recipe.genus == base::Genus::Fog ? depth * low * low : depth * (0.04 + 0.92 * low);
      p.y = std::clamp(y + 0.1 * depth * swell, 0.03 * depth, 0.97 * depth);
      const double thinnest = std::min(p.y, depth - p.y);
      const double thick = std::clamp(0.33 * thinnest, 0.012 * depth, 0.11 * depth);
      // Flat however many there are, or they would be lit as a heap's (light::layerShare); narrow ones then hold as
      // much as if they were as thick, so that the layer is as dense at every height.
      const double sigmaY = std::min(thick, std::max({1.0, 0.012 * depth, size * recipe.flattening}));
      puff.center = p;
      puff.sigma = glm::vec3(size * stretch, sigmaY, size / std::sqrt(stretch));
      const double contrast = 0.35 + 1.1 * recipe.fibre + 0.5 * recipe.raggedness;
      puff.extinctionPerMeter =
          static_cast<float>(window * std::clamp(1.0 + contrast * 1.8 * grain, 0.12, 2.4) *
                             (recipe.genus == base::Genus::Fog ? 1.25 - low : 1.0) * thick / sigmaY);
      const int blockX = std::clamp(static_cast<int>((p.x / span + 0.5) * blocks), 0, blocks - 1);
      const int blockZ = std::clamp(static_cast<int>((p.z / span + 0.5) * blocks), 0, blocks - 1);
      puff.section = static_cast<std::uint16_t>(blockZ * blocks + blockX);
      shape.puffs.push_back(puff);
      // Scud below the layer: small torn rags.
      if (fills.uniform() < 0.22 * recipe.raggedness && recipe.genus != base::Genus::Fog) {
        Puff rag = puff;
        const double s = size * fills.uniform(0.18, 0.4);
        rag.center.y = static_cast<float>(depth * fills.uniform(0.02, 0.15));
        rag.sigma = glm::vec3(s * 1.5, std::min(s * 0.6, 0.08 * depth + 5), s);
        rag.extinctionPerMeter *= 0.55f;
        shape.puffs.push_back(rag);
      }
    }
  if (recipe.precipitation > 0)
    addPrecipitation(shape.precipitation, recipe, {0, 0, 0}, 0.55 * width,
                     std::min(0.45 * depth, 1400.0), std::max(8, request.puffs / 8), fills);
  std::stable_sort(shape.puffs.begin(), shape.puffs.end(),
                   [](const Puff& a, const Puff& b) { return a.section < b.section; });
  for (Puff& puff : shape.precipitation) puff.section = static_cast<std::uint16_t>(blocks * blocks);
  return shape;
}

}  // namespace cloudgen::shape
