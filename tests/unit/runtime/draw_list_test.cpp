// SPDX-License-Identifier: Apache-2.0
#include "runtime/draw_list.hpp"

#include <set>

#include "runtime/runtime.hpp"
#include "support/made_pack.hpp"
#include "support/runtime_path.hpp"

namespace cloudgen::runtime {
namespace {

constexpr float kSide = 120'000;

float distanceOf(const Frame& frame, const PackView& pack, const DrawPuff& puff, const Vec3& eye) {
  const pack::Instance& cloud = frame.clouds[puff.instance];
  return length(placed(cloud, turnOf(cloud.yaw_step()), pack.centers()[puff.puff]) - eye);
}

/// Fails where the list is not ordered as it says.
void expectOrdered(const Frame& frame, const PackView& pack, const Vec3& eye) {
  float farthestSoFar = 1e30f;
  for (const DrawPuff& puff : frame.puffs) {
    const float distance = distanceOf(frame, pack, puff, eye);
    ASSERT_LE(distance, farthestSoFar * (1 + 1.0f / 1024) + frame.orderErrorMeters + 1e-2f);
    farthestSoFar = std::min(farthestSoFar, distance);
  }
}

class DrawListTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(runtime.open(test::bytesOf(bytes))); }
  const std::string bytes = test::packOf(test::wideSky(8, 40, 3000, kSide));
  Runtime runtime;
};

TEST_F(DrawListTest, FarthestFirstWithinTheStatedErrorAllAlongAFlight) {
  int made = 0;
  float worst = 0;
  for (int f = 0; f < 600; ++f) {
    const Camera camera = test::flightCamera(f, kSide);
    const Frame frame = runtime.update(camera);
    made += frame.puffsChanged;
    worst = std::max(worst, frame.orderErrorMeters);
    if (f % 7 == 0) expectOrdered(frame, runtime.pack(), camera.eye);
  }
  EXPECT_LE(worst, 2 * LazyOptions().moveMeters);
  EXPECT_LT(made, 200) << "most frames keep the list of the one before";
  EXPECT_GT(made, 20);
}

TEST_F(DrawListTest, WhatIsInViewIsInTheListHoweverOldTheListIs) {
  for (int f = 0; f < 400; ++f) {
    const Camera camera = test::flightCamera(f, kSide);
    const Frame frame = runtime.update(camera);
    if (f % 20 != 0) continue;
    std::set<std::uint32_t> listed;
    for (const DrawPuff& puff : frame.puffs) listed.insert(puff.instance);
    const Frustum exact(camera, 0, 0);
    for (std::uint32_t i = 0; i < frame.clouds.size(); ++i) {
      const pack::Instance& cloud = frame.clouds[i];
      const ArchetypeInfo& info = runtime.pack().archetypes()[cloud.archetype()];
      const Turn turn = turnOf(cloud.yaw_step());
      for (std::uint32_t p = info.first[0]; p < info.first[0] + info.count[0]; ++p)
        if (exact.meetsSphere(placed(cloud, turn, runtime.pack().centers()[p]), 0)) {
          ASSERT_TRUE(listed.count(i)) << "frame " << f;
        }
    }
  }
}

TEST_F(DrawListTest, AStandingCameraCostsNothingAndATurnedOneGetsANewListAtOnce) {
  Camera camera = test::flightCamera(0, kSide);
  EXPECT_TRUE(runtime.update(camera).puffsChanged);
  for (int f = 0; f < 20; ++f) EXPECT_FALSE(runtime.update(camera).puffsChanged);
  camera.forward = {1, 0, 0.2f};
  const Frame frame = runtime.update(camera);
  EXPECT_TRUE(frame.puffsChanged);
  EXPECT_EQ(frame.orderErrorMeters, 0);
  expectOrdered(frame, runtime.pack(), camera.eye);
}

TEST_F(DrawListTest, AnotherLensGetsAnotherList) {
  Camera camera = test::flightCamera(0, kSide);
  runtime.update(camera);
  camera.verticalFieldRadians = 0.3f;
  EXPECT_TRUE(runtime.update(camera).puffsChanged);
}

TEST(RadixSort, SortsByBothBytesAndKeepsTheOrderOfEquals) {
  std::vector<std::uint16_t> keys, half(5000), whole(5000);
  std::vector<DrawPuff> puffs, halfPuffs(5000), sorted(5000);
  base::RandomStream random(1, 0, base::Purpose::Test);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    keys.push_back(static_cast<std::uint16_t>(random.index(3000) * 21));
    puffs.push_back({i, keys.back()});
  }
  RadixPass low(0, keys);
  while (low.advance(700, keys, puffs, half, halfPuffs) > 0) continue;
  RadixPass high(1, half);
  EXPECT_EQ(high.advance(9000, half, halfPuffs, whole, sorted), 5000u) << "no more than there are";
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(whole[i], sorted[i].puff);
    if (i == 0) continue;
    EXPECT_GE(whole[i], whole[i - 1]);
    if (whole[i] == whole[i - 1]) {
      EXPECT_GT(sorted[i].instance, sorted[i - 1].instance);
    }
  }
}

TEST(RadixSort, KeysFallWithTheDistance) {
  for (float meters = 2; meters < 3e6f; meters *= 1.0011f)
    EXPECT_GT(farFirst(meters * meters), farFirst(1.0011f * meters * 1.0011f * meters)) << meters;
  EXPECT_EQ(farFirst(0), 0xffff);
  EXPECT_EQ(farFirst(NAN), 0xffff);
  EXPECT_EQ(farFirst(INFINITY), 0);
}

}  // namespace
}  // namespace cloudgen::runtime
