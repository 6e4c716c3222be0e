// SPDX-License-Identifier: Apache-2.0
#include "pipeline/archetype.hpp"

#include "pipeline/footprint.hpp"
#include "shape/heights.hpp"
#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

field::Layer deepLayer(float middleMeters) {
  field::Layer layer;
  layer.genus = base::Genus::Nimbostratus;
  layer.spreadEvenly(1000, 6000);
  layer.middleMeters = middleMeters;
  layer.fraction = 0.5f;
  layer.liquidOpticalDepth = 20;
  return layer;
}

/// Where half of a cloud's extinction lies below, as a share of its depth.
double middleOf(const field::Layer& layer) {
  const Options options = test::usualOptions();
  Generalisation general;
  general.puffsPerCloud.fill(60);
  const ArchetypeShape shape = shapeOf(shapeKeyOf(layer, 0, 5000, 20'000, options), options, general);
  return shape::heightOfShare(shape.cloud.puffs, 0.5) / shape.depthMeters;
}

TEST(Archetype, CloudsOfALayerGatherTheirWaterWhereItDoes) {
  const double even = middleOf(deepLayer(3500));
  EXPECT_LT(middleOf(deepLayer(2200)), even - 0.1);
  EXPECT_GT(middleOf(deepLayer(4800)), even + 0.1);
}

TEST(Footprint, KnowsHowHighItsPuffsAre) {
  shape::Puff low, high;
  low.center = {-1000, 300, 0}, high.center = {1000, 900, 0};
  low.sigma = high.sigma = {200, 50, 200};
  low.extinctionPerMeter = high.extinctionPerMeter = 0.01f;
  const Footprint footprint(std::vector<shape::Puff>{low, high}, 1000);
  EXPECT_NEAR(footprint.heightsAt(-1, 0).mean, 0.3, 1e-3);
  EXPECT_NEAR(footprint.heightsAt(1, 0).mean, 0.9, 1e-3);
  EXPECT_NEAR(footprint.heightsAt(1, 0).square, 0.9 * 0.9 + 0.05 * 0.05, 1e-3);
}

}  // namespace
}  // namespace cloudgen::pipeline
