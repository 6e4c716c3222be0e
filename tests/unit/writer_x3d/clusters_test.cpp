// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/clusters.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

/// Every puff is drawn once.
void expectPartition(const std::vector<Cluster>& clusters, std::size_t puffs) {
  std::set<std::uint32_t> seen;
  for (const Cluster& cluster : clusters)
    for (const std::uint32_t i : cluster.puffs)
      EXPECT_TRUE(seen.insert(i).second) << "puff " << i << " twice";
  EXPECT_EQ(seen.size(), puffs);
}

TEST(Clusters, AHeapTurnsAndKeepsItsSections) {
  const auto cloud = test::heap("Cu", base::Genus::Cumulus, 1500, 900, 3, 60);
  const auto clusters = clustersOf(cloud.puffs, cloud.sectionStart, 24);
  expectPartition(clusters, cloud.puffs.size());
  EXPECT_GE(clusters.size(), 3u);
  for (const Cluster& cluster : clusters) {
    EXPECT_TRUE(cluster.turns);
    for (const std::uint32_t i : cluster.puffs)
      EXPECT_EQ(cloud.puffs[i].section, cloud.puffs[cluster.puffs.front()].section);
  }
}

TEST(Clusters, AFlatSheetDoesNotStandUp) {
  const auto cloud = test::sheet("Sc", base::Genus::Stratocumulus, 8000, 300, 200, 1, 0.8f, 4);
  const auto clusters = clustersOf(cloud.puffs, cloud.sectionStart, 24);
  expectPartition(clusters, cloud.puffs.size());
  EXPECT_FALSE(clusters.back().turns);
}

TEST(Clusters, LongPuffsKeepTheirDirection) {
  const auto cloud = test::sheet("Ci", base::Genus::Cirrus, 3000, 3000, 30, 6, 0.9f, 0.3f);
  const auto clusters = clustersOf(cloud.puffs, cloud.sectionStart, 24);
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_FALSE(clusters[0].turns);
}

TEST(Clusters, NeverMoreThanAllowed) {
  const auto cloud = test::heap("Cu", base::Genus::Cumulus, 20000, 500, 40, 400);
  for (const std::size_t most : {1u, 5u, 24u}) {
    const auto clusters = clustersOf(cloud.puffs, cloud.sectionStart, most);
    EXPECT_LE(clusters.size(), most);
    expectPartition(clusters, cloud.puffs.size());
  }
}

TEST(Clusters, PuffsOnOneSpotAndNoPuffs) {
  EXPECT_TRUE(clustersOf({}, {}, 24).empty());
  const std::vector<shape::Puff> same(9);
  expectPartition(clustersOf(same, {}, 24), 9);
}

}  // namespace
}  // namespace cloudgen::writer
