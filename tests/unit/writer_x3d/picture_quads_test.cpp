// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/picture_quads.hpp"

#include <gtest/gtest.h>

#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

TEST(PictureQuads, StandWhereTheCloudDoes) {
  const scene::Scene scene = test::smallScene();
  const shape::Bounds& box = scene.archetypes[scene.lit[0].archetype].bounds;
  const CloudPictures cloud = picturesOf(scene, 0, 64);
  std::vector<const image::ByteImage*> images;
  for (const CloudPicture& one : cloud.level) images.push_back(&one.picture.image);
  const PictureAtlas atlas(images);
  const glm::vec3 place(1000, 2000, -3000);
  QuadMesh mesh;
  appendQuads(cloud.level, atlas, 0, place, 2, glm::vec3(1), mesh);
  ASSERT_EQ(mesh.quads.size(), cloud.level.size());
  EXPECT_EQ(mesh.faces.size(), mesh.quads.size());
  for (const Quad& quad : mesh.quads) {
    EXPECT_GE(quad.center.y, place.y + 2 * box.lower.y);
    EXPECT_LE(quad.center.y, place.y + 2 * box.upper.y);
  }
}

}  // namespace
}  // namespace cloudgen::writer
