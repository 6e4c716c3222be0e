// SPDX-License-Identifier: Apache-2.0
// A sky that shows its model passes; one that was tampered with is told, and by what is wrong with it.
#include "check/fidelity/fidelity.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "made_model.hpp"

namespace cloudgen::check::test {
namespace {

bool breaks(const Fidelity& fidelity, const std::string& measure) {
  for (const Breach& breach : fidelity.breaches)
    if (breach.measure == measure) return true;
  return false;
}

TEST(Fidelity, PassesASkyThatShowsItsModel) {
  const Fidelity told = MadeSky().verified();
  for (const Breach& breach : told.breaches) ADD_FAILURE() << breach.measure << " " << breach.value;
  EXPECT_EQ(told.columns.size(), 24u);
  EXPECT_NEAR(told.cover.total.bias, 0, 0.004);
  EXPECT_LT(told.cover.total.rmse, 0.02);
  EXPECT_NEAR(told.opticalDepth.biasRelative, 0, 0.01);
  EXPECT_GT(told.opticalDepth.correlation.value(), 0.99);
  EXPECT_LT(told.base.rmse, 60);
  EXPECT_LT(told.top.rmse, 60);
  EXPECT_EQ(told.genus.agreement().value(), 1);
  EXPECT_EQ(told.genus.clouds, 24u * 228u);
}

TEST(Fidelity, PopulatedColumnsAreScoredApart) {
  MadeSky sky;
  EXPECT_EQ(sky.verified().populatedCover.total.columns, 24u);
  // Of the first cell 99 of its 228 clouds are still named, and half of what is drawn there is gone.
  sky.scene.clouds.erase(sky.scene.clouds.begin() + 99, sky.scene.clouds.begin() + 228);
  sky.scene.blobs.erase(sky.scene.blobs.begin(), sky.scene.blobs.begin() + 114);
  Fidelity told = sky.verified();
  EXPECT_EQ(told.populatedCover.total.columns, 23u);
  EXPECT_LT(told.populatedCover.total.rmse, 0.03);
  EXPECT_GT(told.cover.total.rmse, 0.04);
  EXPECT_FALSE(breaks(told, "cover.populated.total.rmse"));
  // Every column a tenth off: too much for populated ones.
  for (Blob& blob : sky.scene.blobs) blob.opacity *= 0.5f;
  told = sky.verified();
  EXPECT_TRUE(breaks(told, "cover.populated.total.rmse"));
  sky.scene.clouds.clear();
  EXPECT_EQ(sky.verified().populatedCover.total.columns, 0u) << "clouds without names, and no full sheet";
}

TEST(Fidelity, TellsThatATenthOfTheCloudsIsMissing) {
  MadeSky sky;
  std::vector<Blob> kept;
  for (std::size_t i = 0; i < sky.scene.blobs.size(); ++i)
    if (i % 10 != 3) kept.push_back(sky.scene.blobs[i]);
  sky.scene.blobs = kept;
  const Fidelity told = sky.verified();
  EXPECT_TRUE(breaks(told, "cover.total.bias"));
  EXPECT_TRUE(breaks(told, "optical_depth.bias_relative"));
  EXPECT_NEAR(told.opticalDepth.biasRelative, -0.1, 0.01);
  EXPECT_NEAR(told.cover.total.bias, -0.035, 0.005);
}

TEST(Fidelity, TellsThatTheOpticalDepthWasDoubled) {
  MadeSky sky;
  for (Blob& blob : sky.scene.blobs) blob.strength *= 2;
  const Fidelity told = sky.verified();
  EXPECT_TRUE(breaks(told, "optical_depth.bias_relative"));
  EXPECT_NEAR(told.opticalDepth.biasRelative, 1, 0.02);
}

TEST(Fidelity, LayersOfOneBaseAreNotToldApart) {
  MadeSky sky;
  const auto stated = sky.model.layers;
  for (field::StatedLayer layer : stated) {
    layer.genus = base::Genus::Stratocumulus;
    layer.opticalDepth = layer.coverFraction = 0;
    sky.model.layers.push_back(layer);
  }
  for (std::size_t i = 0; i < sky.scene.clouds.size(); i += 2)
    sky.scene.clouds[i].recorded = sky.scene.clouds[i].drawn = base::Genus::Stratocumulus;
  EXPECT_EQ(sky.verified().genus.agreement().value(), 1);
  sky.model.layers[5].genus.reset();
  EXPECT_EQ(sky.verified().genus.clouds, 23u * 228u);
}

TEST(Fidelity, ATypingIsAskedForTypesBeforeTheModel) {
  const MadeSky sky;
  MadeModel typing;
  typing.layers = sky.model.layers;
  EXPECT_EQ(compareWithModel(sky.scene, sky.frame, sky.model, &typing, {}, {}).genus.agreement().value(), 1);
  for (field::StatedLayer& layer : typing.layers) layer.genus = base::Genus::Altostratus;
  const Fidelity told = compareWithModel(sky.scene, sky.frame, sky.model, &typing, {}, {});
  EXPECT_EQ(told.genus.agreement().value(), 0);
  EXPECT_TRUE(breaks(told, "genus.agreement"));
}

TEST(Fidelity, TellsThatCloudsFloatTooHigh) {
  MadeSky sky;
  for (Blob& blob : sky.scene.blobs) blob.center.y += 300;
  const Fidelity told = sky.verified();
  EXPECT_TRUE(breaks(told, "base_m.rmse"));
  EXPECT_TRUE(breaks(told, "top_m.rmse"));
  EXPECT_NEAR(told.base.bias, 300, 40);
}

TEST(Fidelity, TellsThatHighCloudsStandLow) {
  MadeSky sky;
  for (Blob& blob : sky.scene.blobs)
    if (blob.center.y > 5000) blob.center.y -= 5500;
  EXPECT_TRUE(breaks(sky.verified(), "cover.high.bias"));
}

TEST(Fidelity, AnEmptySceneIsWrongUnlessTheModelIsClear) {
  MadeSky sky;
  sky.scene.blobs.clear();
  sky.scene.clouds.clear();
  const Fidelity told = sky.verified();
  EXPECT_TRUE(breaks(told, "cover.total.bias"));
  EXPECT_EQ(told.opticalDepth.biasRelative, -1);
  EXPECT_FALSE(told.genus.agreement().has_value());
  sky.model.layers.clear();
  EXPECT_TRUE(sky.verified().breaches.empty());
}

TEST(Fidelity, ABoxSmallerThanACellIsStillCompared) {
  MadeSky sky;
  const base::LocalFrame frame({11.05, 50.05, 11.2, 50.15});
  const Fidelity told =
      compareWithModel({"made", "splats", {}, {}, {}, 0}, frame, sky.model, nullptr, {}, {});
  EXPECT_EQ(told.columns.size(), 1u);
  EXPECT_TRUE(breaks(told, "cover.total.bias"));
}

TEST(Fidelity, RefusesAModelOfAnotherPlace) {
  MadeSky sky;
  const base::LocalFrame elsewhere({-60, 10, -50, 20});
  EXPECT_THROW(compareWithModel(sky.scene, elsewhere, sky.model, nullptr, {}, {}), base::InputError);
}

TEST(Fidelity, NamesTheWorstColumn) {
  MadeSky sky;
  const auto gone = [&](const Blob& blob) {
    const auto place = sky.frame.toGeographic({blob.center.x, 0, blob.center.z});
    return place.x > 11 && place.x < 11.5 && place.y > 50 && place.y < 50.5;
  };
  std::erase_if(sky.scene.blobs, gone);
  const Fidelity told = sky.verified();
  ASSERT_FALSE(told.worst.front().columns.empty());
  EXPECT_EQ(told.worst.front().measure, "cover");
  EXPECT_NEAR(told.worst.front().columns.front().longitudeDegrees, 11.25, 1e-9);
  EXPECT_NEAR(told.worst.front().columns.front().latitudeDegrees, 50.25, 1e-9);
}

TEST(Fidelity, OneThreadSaysWhatManySay) {
  const MadeSky sky;
  const Fidelity one = [&] {
    const base::ThreadLimit limit(1);
    return sky.verified();
  }();
  const Fidelity many = sky.verified();
  EXPECT_EQ(one.cover.total.rmse, many.cover.total.rmse);
  EXPECT_EQ(one.opticalDepth.sceneMean, many.opticalDepth.sceneMean);
  EXPECT_EQ(one.base.rmse, many.base.rmse);
}

}  // namespace
}  // namespace cloudgen::check::test
