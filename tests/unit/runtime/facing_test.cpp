// SPDX-License-Identifier: Apache-2.0
#include "runtime/facing.hpp"

#include "runtime/runtime.hpp"
#include "support/made_pack.hpp"

namespace cloudgen::runtime {
namespace {

TEST(Facing, IsKeptWithinHalfTheRadiusAndOnlyThere) {
  const scene::Scene scene = test::packScene();
  const std::string bytes = test::packOf(scene);
  Runtime runtime;
  ASSERT_TRUE(runtime.open(test::bytesOf(bytes)));
  const PackView& pack = runtime.pack();
  const pack::Instance& cloud = pack.instances()[0];
  const std::uint32_t puff = pack.archetypes()[cloud.archetype()].first[0];
  const Vec3 middle = placed(cloud, turnOf(cloud.yaw_step()), pack.centers()[puff]);
  const float radius = kReach * cloud.scale() *
                       std::max({floatOf(pack.puffs()[puff].sigma_x()), floatOf(pack.puffs()[puff].sigma_y()),
                                 floatOf(pack.puffs()[puff].sigma_z())});
  const auto facingAt = [&](float share) -> const Vec3* {
    Camera camera;
    camera.eye = middle + Vec3{share * radius, 0.05f * radius, 0};
    camera.forward = {-1, 0, 0};
    for (const FacingLock::Locked& locked : runtime.update(camera).locked)
      if (locked.puff.instance == 0 && locked.puff.puff == puff) return &locked.facing;
    return nullptr;
  };
  EXPECT_EQ(facingAt(0.9f), nullptr);
  EXPECT_EQ(facingAt(0.55f), nullptr);
  const Vec3* entry = facingAt(0.45f);
  ASSERT_NE(entry, nullptr);
  const Vec3 kept = *entry;
  EXPECT_NEAR(length(kept), 1, 1e-5f);
  EXPECT_GT(kept.x, 0.98f);
  for (const float share : {0.3f, 0.1f, 0.0f, -0.2f, -0.45f}) {
    const Vec3* now = facingAt(share);
    ASSERT_NE(now, nullptr) << share;
    EXPECT_EQ(now->x, kept.x) << "it does not spin as one flies through";
  }
  EXPECT_EQ(facingAt(-0.6f), nullptr);
  const Vec3* back = facingAt(-0.4f);
  ASSERT_NE(back, nullptr);
  EXPECT_LT(back->x, -0.98f) << "coming in again it faces the eye anew";
}

}  // namespace
}  // namespace cloudgen::runtime
