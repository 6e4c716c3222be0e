// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cards.hpp"

#include <algorithm>
#include <map>

#include "light/shade.hpp"

namespace cloudgen::writer {
namespace {

/// Level quads have no thickness: several, from where a uniform layer of the puff's depth begins to where it
/// ends, tell base and top, and each height between that they are far apart.
void addLevels(const LitPuff& whole, std::vector<LitPuff>& out) {
  constexpr float kAway = 1.5f, kThin = 0.02f, kStepMeters = 1500;
  const float reach = kAway * whole.puff.sigma.y;
  const int levels = std::clamp(1 + static_cast<int>(std::lround(2 * reach / kStepMeters)), 2, 6);
  for (int i = 0; i < levels; ++i) {
    LitPuff level = whole;
    level.planes = Planes::Level;
    level.puff.center +=
        whole.puff.rotation * glm::vec3(0, reach * (2.0f * static_cast<float>(i) / (levels - 1) - 1), 0);
    level.puff.sigma.y *= kThin;
    level.puff.extinctionPerMeter /= kThin * static_cast<float>(levels);
    level.covering /= static_cast<float>(levels);  // of all of them together
    out.push_back(level);
  }
}

}  // namespace

void writeCards(QuadShapes& shapes, const scene::Scene& scene, std::span<const std::uint32_t> instances,
                const std::vector<bool>& isParted) {
  std::map<base::Genus, std::vector<LitPuff>> puffs;
  for (const std::uint32_t i : instances) {
    const scene::Instance& instance = scene.instances[i];
    const scene::LitArchetype& lit = scene.lit[instance.lit];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    const bool inParts = isParted[i];
    const std::span<const shape::Puff> source =
        inParts ? std::span(archetype.farPuffs) : std::span(&archetype.onePuff, 1);
    const std::span<const light::PuffLight> lights =
        inParts ? std::span(lit.farPuffs) : std::span(&lit.onePuff, 1);
    const float covering = inParts ? archetype.farCovering : static_cast<float>(shape::kCoveringOpticalDepth);
    const glm::vec3 dimming = light::dimming(instance.sunlight, scene.sun.color, scene.sky);
    auto& all = puffs[archetype.genus];
    for (std::size_t p = 0; p < source.size(); ++p) {
      LitPuff whole{scene::placed(scene, instance, source[p]), dimming * lights[p].color, covering};
      addLevels(whole, all);
      whole.planes = Planes::Upright;
      all.push_back(whole);
    }
  }
  for (const auto& [genus, all] : puffs)
    shapes.write(genus, crossedQuads(all, glm::vec3(0), shapes.atlas(genus)));
}

}  // namespace cloudgen::writer
