// SPDX-License-Identifier: Apache-2.0
#include "runtime/selection.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "support/made_pack.hpp"
#include "support/runtime_path.hpp"

namespace cloudgen::runtime {
namespace {

constexpr float kSide = 120'000;

class SelectionTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(view.open(test::bytesOf(bytes))); }
  std::set<std::uint32_t> cloudsSeen(Selection& selection, const CloudSet& clouds, const Camera& camera) const {
    selection.begin(clouds, camera, Frustum(camera, 0, 0), 0, {});
    EXPECT_FALSE(selection.advance(std::numeric_limits<std::uint64_t>::max()));
    std::set<std::uint32_t> seen;
    for (const DrawPuff& puff : selection.puffs()) seen.insert(puff.instance);
    return seen;
  }
  Selection fresh() const { return {view, view.instances().size(), view.tiles().size(), 1 << 20}; }

  const std::string bytes = test::packOf(test::wideSky(8, 40, 3000, kSide));
  PackView view;
};

TEST_F(SelectionTest, TheTreeFindsWhatLookingAtEveryCloudFinds) {
  for (int frame = 0; frame < 4000; frame += 400) {
    const Camera camera = test::flightCamera(frame, kSide);
    Selection byTree = fresh(), oneByOne = fresh();
    const auto seen = cloudsSeen(byTree, {view.instances(), view.tiles(), 0}, camera);
    const auto looked = cloudsSeen(oneByOne, {view.instances(), {}, 0}, camera);
    EXPECT_TRUE(std::includes(looked.begin(), looked.end(), seen.begin(), seen.end()));
    // The boxes of tiles keep out what only a sphere about a cloud lets in: but never a puff in view.
    const Frustum exact(camera, 0, 0);
    for (const DrawPuff& puff : oneByOne.puffs()) {
      const pack::Instance& cloud = view.instances()[puff.instance];
      if (exact.meetsSphere(placed(cloud, turnOf(cloud.yaw_step()), view.centers()[puff.puff]), 0)) {
        EXPECT_TRUE(seen.count(puff.instance));
      }
    }
    EXPECT_GT(seen.size(), 20u);
    EXPECT_LT(seen.size(), 1500u);
    EXPECT_LT(byTree.work() - byTree.puffs().size(), view.instances().size()) << "most are not even looked at";
  }
}

TEST_F(SelectionTest, ACloudInFrontIsSeenAndOneBehindIsNot) {
  for (std::uint32_t i = 0; i < view.instances().size(); i += 37) {
    const pack::Instance& cloud = view.instances()[i];
    const ArchetypeInfo& info = view.archetypes()[cloud.archetype()];
    const Vec3 middle = vec3(cloud.position()) + info.middle * cloud.scale();
    Camera camera;
    camera.forward = normalized({std::sin(static_cast<float>(i)), -0.1f, std::cos(static_cast<float>(i))});
    camera.eye = middle - camera.forward * (3 * info.radiusMeters * cloud.scale());
    Selection selection = fresh();
    const CloudSet clouds{view.instances(), view.tiles(), 0};
    EXPECT_TRUE(cloudsSeen(selection, clouds, camera).count(i));
    camera.forward = camera.forward * -1;
    EXPECT_FALSE(cloudsSeen(selection, clouds, camera).count(i));
  }
}

TEST_F(SelectionTest, MovedCloudsAreFoundOutsideTheirTiles) {
  std::vector<pack::Instance> moved;
  for (const pack::Instance& cloud : view.instances()) {
    const pack::Vec3& at = cloud.position();
    moved.emplace_back(pack::Vec3(at.x() + 6000, at.y() + 500, at.z() - 6000), cloud.archetype(), cloud.yaw_step(),
                       cloud.sunlight(), cloud.scale(), cloud.optical_depth_factor());
  }
  const Camera camera = test::flightCamera(1000, kSide);
  Selection byTree = fresh(), oneByOne = fresh();
  const auto seen = cloudsSeen(byTree, {moved, view.tiles(), 9000}, camera);
  cloudsSeen(oneByOne, {moved, {}, 0}, camera);
  const Frustum exact(camera, 0, 0);
  for (const DrawPuff& puff : oneByOne.puffs()) {
    const pack::Instance& cloud = moved[puff.instance];
    if (exact.meetsSphere(placed(cloud, turnOf(cloud.yaw_step()), view.centers()[puff.puff]), 0)) {
      EXPECT_TRUE(seen.count(puff.instance));
    }
  }
}

TEST_F(SelectionTest, DetailLostIsUnderTheLimit) {
  const Camera camera = test::flightCamera(500, kSide);
  Selection selection = fresh();
  cloudsSeen(selection, {view.instances(), view.tiles(), 0}, camera);
  std::set<std::uint32_t> levels;
  for (const DrawPuff& puff : selection.puffs()) {
    const pack::Instance& cloud = view.instances()[puff.instance];
    const ArchetypeInfo& info = view.archetypes()[cloud.archetype()];
    const std::uint32_t level = selection.levelOf(puff.instance);
    EXPECT_GE(puff.puff, info.first[level]);
    EXPECT_LT(puff.puff, info.first[level] + info.count[level]);
    const float distance =
        length(vec3(cloud.position()) + info.middle * cloud.scale() - camera.eye) - info.radiusMeters * cloud.scale();
    if (level > 0) {
      EXPECT_LE(info.errorMeters[level] * cloud.scale() * camera.focalPixels() / distance, 3.001f);
    }
    levels.insert(level);
  }
  EXPECT_GE(levels.size(), 3u) << "near clouds are fine, far ones coarse";
}

TEST_F(SelectionTest, HysteresisKeepsLevelsFromFlickering) {
  Selection selection = fresh();
  const CloudSet clouds{view.instances(), view.tiles(), 0};
  const Camera here = test::flightCamera(500, kSide);
  cloudsSeen(selection, clouds, here);
  std::vector<std::uint32_t> before;
  const auto levels = [&] {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < view.instances().size(); ++i) all.push_back(selection.levelOf(i));
    return all;
  };
  Camera there = here;
  there.eye = there.eye + Vec3{0, 0, -30};
  cloudsSeen(selection, clouds, there);
  before = levels();
  for (int i = 0; i < 10; ++i) {
    cloudsSeen(selection, clouds, i % 2 ? there : here);
    EXPECT_EQ(levels(), before) << "to and fro by 30 m changes nothing";
  }
}

TEST_F(SelectionTest, InPiecesItFindsTheSame) {
  const Camera camera = test::flightCamera(700, kSide);
  const CloudSet clouds{view.instances(), view.tiles(), 0};
  Selection whole = fresh(), pieces = fresh();
  cloudsSeen(whole, clouds, camera);
  pieces.begin(clouds, camera, Frustum(camera, 0, 0), 0, {});
  int steps = 1;
  while (pieces.advance(50)) ++steps;
  EXPECT_GT(steps, 5);
  ASSERT_EQ(pieces.puffs().size(), whole.puffs().size());
  for (std::size_t i = 0; i < whole.puffs().size(); ++i) {
    EXPECT_EQ(pieces.puffs()[i].instance, whole.puffs()[i].instance);
    EXPECT_EQ(pieces.puffs()[i].puff, whole.puffs()[i].puff);
    EXPECT_EQ(pieces.keys()[i], whole.keys()[i]);
  }
}

TEST_F(SelectionTest, StopsWhereItsRoomEnds) {
  Selection small(view, view.instances().size(), view.tiles().size(), 500);
  cloudsSeen(small, {view.instances(), view.tiles(), 0}, test::flightCamera(0, kSide));
  EXPECT_LE(small.puffs().size(), 500u);
  EXPECT_GT(small.puffs().size(), 300u);
}

}  // namespace
}  // namespace cloudgen::runtime
