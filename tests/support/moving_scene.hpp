// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "scene/scene.hpp"

namespace cloudgen::test {

/// The same clouds over two hours, a key every half an hour, by turns: there at first and then handed over to another,
/// which is the next and stays an hour more; and born between the second hour and the third. All go east and turn north.
inline scene::Scene moving(scene::Scene scene) {
  scene.keySeconds = {0, 1800, 3600, 5400, 7200};
  scene.timeSeconds = {0, 3600, 7200};
  struct Life {
    std::uint32_t firstKey;
    std::vector<float> growths, presences;
  };
  const std::array<Life, 3> lives{{{0, {1, 1.1f, 1.2f}, {1, 0.5f, 0}},
                                   {0, {0.8f, 0.9f, 1, 0.7f, 0.02f}, {0, 0.5f, 1, 1, 0}},
                                   {2, {0.02f, 0.7f, 1}, {0, 1, 1}}}};
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Life& life = lives[i % lives.size()];
    scene::Motion motion{life.firstKey, {}};
    for (std::uint32_t k = 0; k < life.growths.size(); ++k) {
      const float hours = 0.5f * static_cast<float>(life.firstKey + k);
      motion.moments.push_back({glm::vec3(9000 * hours, 10 * hours, -2000 * hours * hours), life.growths[k],
                                life.presences[k]});
    }
    scene.motions.push_back(motion);
  }
  return scene;
}

}  // namespace cloudgen::test
