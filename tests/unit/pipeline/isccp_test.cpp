// SPDX-License-Identifier: Apache-2.0
#include "pipeline/isccp.hpp"

#include <vector>

namespace cloudgen::pipeline {
namespace {

TEST(Isccp, ClassesByOpticalDepthAndTopPressure) {
  EXPECT_EQ(isccpClass(1, 80000), "cumulus");
  EXPECT_EQ(isccpClass(10, 80000), "stratocumulus");
  EXPECT_EQ(isccpClass(30, 80000), "stratus");
  EXPECT_EQ(isccpClass(1, 50000), "altocumulus");
  EXPECT_EQ(isccpClass(10, 50000), "altostratus");
  EXPECT_EQ(isccpClass(30, 50000), "nimbostratus");
  EXPECT_EQ(isccpClass(1, 20000), "cirrus");
  EXPECT_EQ(isccpClass(10, 20000), "cirrostratus");
  EXPECT_EQ(isccpClass(30, 20000), "deep convection");
}

TEST(Isccp, LayersAreCountedByClassAndGenus) {
  std::vector<field::Layer> layers(3);
  for (field::Layer& layer : layers) {
    layer.genus = base::Genus::Stratocumulus;
    layer.liquidOpticalDepth = 8;
    layer.topPressurePa = 85000;
  }
  layers[1].genus = base::Genus::Cumulus;
  layers[2].topPressurePa = 0;
  const auto confusion = isccpConfusion(layers);
  ASSERT_EQ(confusion.size(), 1u);
  EXPECT_EQ(confusion.at("stratocumulus").at(base::Genus::Stratocumulus), 1u);
  EXPECT_EQ(confusion.at("stratocumulus").at(base::Genus::Cumulus), 1u);
}

}  // namespace
}  // namespace cloudgen::pipeline
