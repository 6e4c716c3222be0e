// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/tile_tree.hpp"

#include <algorithm>

#include "support/pack_scene.hpp"

namespace cloudgen::writer::packed {
namespace {

TEST(TileTree, EveryCloudIsInOneLeafThatHoldsIt) {
  for (const int clouds : {0, 1, 32, 33, 500}) {
    scene::Scene scene = test::sceneOf({test::heap("Cu_1", base::Genus::Cumulus, 1500, 900, 3, 12),
                                        test::sheet("Ci_1", base::Genus::Cirrus, 5000, 400, 12, 3, 0.15f, 0.4f)},
                                       clouds);
    const TileTree tree = tileTreeOf(scene);
    std::vector<std::uint32_t> sorted = tree.order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), static_cast<std::size_t>(clouds));
    for (std::uint32_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
    std::uint32_t inLeaves = 0;
    for (const pack::Tile& tile : tree.tiles) {
      if (tile.children() > 0) {
        EXPECT_LE(tile.children(), 8u);
        continue;
      }
      EXPECT_LE(tile.count(), 32u);
      inLeaves += tile.count();
      for (std::uint32_t i = tile.first(); i < tile.first() + tile.count(); ++i) {
        const shape::Bounds box = scene::boundsOf(scene, scene.instances[tree.order[i]]);
        EXPECT_TRUE(box.lower.x >= tile.lower().x() && box.upper.x <= tile.upper().x());
        EXPECT_TRUE(box.lower.y >= tile.lower().y() && box.upper.y <= tile.upper().y());
        EXPECT_TRUE(box.lower.z >= tile.lower().z() && box.upper.z <= tile.upper().z());
      }
    }
    EXPECT_EQ(inLeaves, static_cast<std::uint32_t>(clouds));
  }
}

TEST(TileTree, LeavesAreCompact) {
  const scene::Scene scene = test::wideSky(2, 12, 4000, 200'000);
  const TileTree tree = tileTreeOf(scene);
  double area = 0;
  for (const pack::Tile& tile : tree.tiles)
    if (tile.children() == 0)
      area += static_cast<double>(tile.upper().x() - tile.lower().x()) * (tile.upper().z() - tile.lower().z());
  // 4000 clouds of up to 1.8 km, 32 a leaf: squares of 18 km and their overhang.
  EXPECT_LT(area, 2.5 * 200'000.0 * 200'000.0);
}

}  // namespace
}  // namespace cloudgen::writer::packed
