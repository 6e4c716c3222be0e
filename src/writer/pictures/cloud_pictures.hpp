// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "writer/pictures/lit_cloud.hpp"

namespace cloudgen::writer {

/// The puffs of an instance in the scene frame, as they are lit where one looks; its far puffs where there
/// are so many that nobody would see them.
void appendColored(const scene::Scene& scene, const scene::Instance& instance, const Sight& sight,
                   std::vector<ColoredPuff>& out);

/// A cloud as pictures within it. Level ones from above and below lie in the middle of its height, or where
/// it is widest if that is higher; a flat cloud has no others (from above they would be seen as bright lines)
/// but these in two layers, if it has some height: at a slant one sees its sides between them.
struct CloudPictures {
  std::vector<CloudPicture> level;    ///< those from above upwards, then those from below downwards
  std::vector<CloudPicture> upright;  ///< from its four sides, for far off
};

/// Of the quad of a picture.
glm::vec3 middleOf(const CloudPicture& picture);

/// Pixels of the pictures of a file's clouds.
struct PictureSize {
  double together = 0;  ///< of all of them, about
  int longestSide = 0;  ///< of a cloud, at most
};

/// Along the longest side of each of so many clouds, whose pictures fill together so many squares of it each,
/// about.
int pixelsOfEach(std::size_t clouds, double squares, const PictureSize& size);

/// Of a lit archetype, so many pixels along its longest side.
CloudPictures picturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels);

/// The same cloud for viewers that turn pictures: one about its middle, or the level ones of a flat cloud.
struct NearPictures {
  std::vector<CloudPicture> pictures;
  bool turns = false;
};
NearPictures nearPicturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels);

/// The same cloud for viewers that turn nothing: pictures from above, below and four sides, each with the
/// relief of what it shows, which is one surface from everywhere; a flat or sheer cloud has level ones alone.
/// Level ones come first.
std::vector<CloudPicture> shellPictures(const scene::Scene& scene, std::uint32_t lit, int pixels,
                                        float opticalDepthFactor);
/// How many squares of a cloud's longest side they fill, about.
inline constexpr double kShellSquares = 3;

/// What multiplies the pictures of a lit archetype where other clouds leave it a share of the sun.
glm::vec3 tintOf(const scene::Scene& scene, std::uint32_t lit, float sunlight);

}  // namespace cloudgen::writer
