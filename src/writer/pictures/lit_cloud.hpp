// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "writer/pictures/puff_painting.hpp"

namespace cloudgen::writer {

inline constexpr Sight kFromAbove{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    kFromBelow{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, kFromSouth{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    kFromNorth{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, kFromEast{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
    kFromWest{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};

/// A picture of a cloud, in the cloud's own metres under its heading: a quad with one face.
struct CloudPicture {
  PuffPicture picture;
  Sight sight;
};

struct Fineness {
  float pixelsPerMeter = 0;
  int reliefCells = 0;  ///< along the longer side of a picture, or no relief
};

/// Some of the puffs of a cloud, by their index.
using Part = std::vector<std::size_t>;

/// A lit archetype to be painted, in its own metres under its heading.
class LitCloud {
 public:
  LitCloud(const scene::Scene& scene, std::uint32_t lit, float opticalDepthFactor);

  const shape::Bounds& box() const { return box_; }
  glm::vec3 size() const { return box_.upper - box_.lower; }
  /// The longer of its two level sides.
  float width() const;
  /// Through the box from above.
  float meanOpticalDepth() const;
  const std::vector<shape::Puff>& puffs() const { return puffs_; }

  Part whole() const;
  /// Its puffs in so many layers across an axis, in their order, with equal shares of its extinction.
  std::vector<Part> layers(int axis, int count) const;

  /// A picture of some of its puffs, `share` of their optical depth in it: for a plane that does not turn, as
  /// it is seen on the whole by all who stand before it.
  CloudPicture seen(const Part& part, const Sight& sight, const Fineness& fineness, float share = 1) const;
  /// The same as one sees it who looks at an angle of this cosine to the sun.
  CloudPicture seenAt(float cosine, const Part& part, const Sight& sight, const Fineness& fineness,
                      float share = 1) const;

 private:
  std::vector<shape::Puff> puffs_;
  std::vector<light::EncodedLight> lights_;
  shape::Bounds box_;
  light::Sun sun_;
};

/// Mean cosine between the sun and looks at a picture that does not turn, from all over the half-space before
/// it.
float meanCosine(const Sight& sight, const light::Sun& sun);

}  // namespace cloudgen::writer
