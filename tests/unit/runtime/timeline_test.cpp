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

/// Cloud 1 is there until the end, cloud 2 from the middle on; the others never.
void addLives(pack::RuntimePackT& content) {
  const std::vector<std::vector<std::uint32_t>> there{{1}, {1, 2}, {1, 2}};
  for (std::size_t k = 0; k < there.size(); ++k) {
    auto frame = std::make_unique<pack::KeyframeT>();
    frame->seconds = 300 * static_cast<double>(k);
    frame->clouds = there[k];
    for (const std::uint32_t cloud : there[k])
      frame->motions.emplace_back(pack::Vec3(10, 0, 0), 1.0f, cloud == 2 && k == 1 ? 0.0f : 1.0f);
    content.keyframes.push_back(std::move(frame));
  }
}

TEST(Timeline, CloudsAreThereInTheirLivesAlone) {
  const std::string bytes = test::packOf(test::packScene(), addLives);
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  Timeline timeline(view);
  const auto presence = [&](double seconds, std::size_t cloud) {
    timeline.setTime(seconds);
    return timeline.instances()[cloud].optical_depth_factor() / view.instances()[cloud].optical_depth_factor();
  };
  for (const double seconds : {0.0, 150.0, 450.0, 600.0}) {
    EXPECT_EQ(presence(seconds, 0), 0);
    EXPECT_EQ(presence(seconds, 1), 1);
  }
  EXPECT_EQ(presence(150, 2), 0);
  EXPECT_NEAR(presence(450, 2), 0.5f, 1e-6f);
}

TEST(Timeline, KeyframesOfCloudsThatAreNotThereAreRefused) {
  const auto opens = [](const auto& change) {
    const std::string bytes = test::packOf(test::packScene(), [&](pack::RuntimePackT& content) {
      addLives(content);
      change(*content.keyframes[1]);
    });
    PackView view;
    return static_cast<bool>(view.open(test::bytesOf(bytes)));
  };
  EXPECT_TRUE(opens([](pack::KeyframeT&) {}));
  EXPECT_FALSE(opens([](pack::KeyframeT& frame) { frame.clouds = {2, 1}; }));
  EXPECT_FALSE(opens([](pack::KeyframeT& frame) { frame.clouds = {1}; }));
  EXPECT_FALSE(opens([](pack::KeyframeT& frame) { frame.clouds = {1, 1'000'000}; }));
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
