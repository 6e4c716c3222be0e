// SPDX-License-Identifier: Apache-2.0
#include "runtime/timeline.hpp"

#include "runtime/runtime.hpp"
#include "support/made_pack.hpp"

namespace cloudgen::runtime {
namespace {

/// Cloud i goes i x 100 m east in ten minutes and doubles; every third one is gone by then.
void addKeyframes(pack::RuntimePackT& content) {
  for (const double seconds : {0.0, 600.0}) {
    auto frame = std::make_unique<pack::KeyframeT>();
    frame->seconds = seconds;
    for (std::size_t i = 0; seconds > 0 && i < content.instances.size(); ++i)
      frame->motions.emplace_back(pack::Vec3(100 * static_cast<float>(i), 0, 0), 2.0f, i % 3 == 0 ? 0.0f : 1.0f);
    content.keyframes.push_back(std::move(frame));
  }
}

TEST(Timeline, RunsStraightBetweenKeyframes) {
  const std::string bytes = test::packOf(test::packScene(), addKeyframes);
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  Timeline timeline(view);
  ASSERT_TRUE(timeline.moves());
  EXPECT_EQ(timeline.lastSeconds(), 600);
  for (const double seconds : {-50.0, 0.0, 150.0, 300.0, 600.0, 900.0}) {
    timeline.setTime(seconds);
    const float share = static_cast<float>(std::clamp(seconds / 600, 0.0, 1.0));
    for (std::size_t i = 0; i < view.instances().size(); ++i) {
      const pack::Instance &is = timeline.instances()[i], &was = view.instances()[i];
      EXPECT_NEAR(is.position().x(), was.position().x() + share * 100 * static_cast<float>(i), 0.01f);
      EXPECT_EQ(is.position().z(), was.position().z());
      EXPECT_NEAR(is.scale(), was.scale() * (1 + share), 1e-5f);
      EXPECT_NEAR(is.optical_depth_factor(), i % 3 == 0 ? 1 - share : 1, 1e-5f);
    }
  }
}

TEST(Timeline, TilesAreWidenedByTheLongestWay) {
  const std::string bytes = test::packOf(test::packScene(), addKeyframes);
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  EXPECT_GE(Timeline(view).tileSlackMeters(), 100.0f * static_cast<float>(view.instances().size() - 1));
}

TEST(Timeline, WithoutKeyframesTheCloudsAreThoseOfTheFile) {
  const std::string bytes = test::packOf(test::packScene());
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  Timeline timeline(view);
  timeline.setTime(100);
  EXPECT_EQ(timeline.instances().data(), view.instances().data());
}

TEST(Timeline, TheRuntimeTellsThatCloudsMoved) {
  const std::string bytes = test::packOf(test::packScene(), addKeyframes);
  Runtime runtime;
  ASSERT_TRUE(runtime.open(test::bytesOf(bytes)));
  EXPECT_TRUE(runtime.update({}).cloudsChanged);
  EXPECT_FALSE(runtime.update({}).cloudsChanged);
  runtime.setTime(10);
  EXPECT_TRUE(runtime.update({}).cloudsChanged);
}

}  // namespace
}  // namespace cloudgen::runtime
