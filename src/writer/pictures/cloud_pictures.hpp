// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "writer/pictures/puff_painting.hpp"

namespace cloudgen::writer {

/// The puffs of an instance in the scene frame, as they are lit; its far puffs where there are so many that
/// nobody would see them.
void appendColored(const scene::Scene& scene, const scene::Instance& instance, std::vector<ColoredPuff>& out);

/// A picture of a cloud, in the cloud's own metres under its heading: a quad with one face.
struct CloudPicture {
  PuffPicture picture;
  Sight sight;
};

/// A cloud as pictures within it. Level ones from above and below lie in the middle of its height, or where
/// it is widest if that is higher; a flat cloud has no others: from above they would be seen as bright lines.
struct CloudPictures {
  std::vector<CloudPicture> level;
  std::vector<CloudPicture> upright;  ///< from its four sides, for far off
  std::vector<CloudPicture> turning;  ///< one, to be turned to the viewer about its middle
};

/// Of the quad of a picture.
glm::vec3 middleOf(const CloudPicture& picture);

/// Of a lit archetype, so many pixels along its longest side.
CloudPictures picturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels);

/// What multiplies the pictures of a lit archetype where other clouds leave it a share of the sun.
glm::vec3 tintOf(const scene::Scene& scene, std::uint32_t lit, float sunlight);

}  // namespace cloudgen::writer
