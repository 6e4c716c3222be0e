// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// Quads of a cloud that are drawn as one Shape, in the cloud's own metres.
struct CloudPart {
  bool turns = false;   ///< true: a Billboard about `center`, which the quads are given from
  glm::vec3 center{0};  ///< zero for those that stay where they are
  QuadMesh mesh;
};

/// What the clouds that share their quads have in common: the archetype under a heading, the share of the sun
/// that other clouds leave it, and Instance::opticalDepthFactor.
struct CloudLook {
  std::uint32_t lit = 0;
  float sunlight = 1, opticalDepthFactor = 1;
};

/// How much of a cloud is drawn as a node of its own.
enum class CloudDetail : unsigned char {
  Full,   ///< all its puffs, in parts that turn where they are round
  Simple  ///< its far puffs in one part
};

/// How wide the quads of every lit archetype are, so that from above they cover together what its puffs do as
/// blended blobs, which is what clouds are fitted as: what turns to the viewer shows its side from above, too,
/// which is less than its plan where it is flat.
class Coverings {
 public:
  /// Of the lit archetypes of these instances.
  Coverings(const scene::Scene& scene, const std::vector<image::SpriteAtlas>& atlases,
            const std::vector<bool>& full);
  float of(std::uint32_t lit, CloudDetail detail) const {
    return (detail == CloudDetail::Full ? full_ : simple_)[lit];
  }

 private:
  std::vector<float> full_, simple_;
};

/// A lit archetype turned by its yaw, at scale 1.
std::vector<CloudPart> partsOf(const scene::Scene& scene, const CloudLook& look, CloudDetail detail,
                               float covering, const image::SpriteAtlas& atlas);

}  // namespace cloudgen::writer
