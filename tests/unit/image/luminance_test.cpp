// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "image/preview.hpp"
#include "light/color.hpp"
#include "light/genus_light.hpp"
#include "light/shade.hpp"
#include "shape/blending.hpp"
#include "support/all_recipes.hpp"
#include "support/usual_cloud.hpp"

namespace cloudgen::image {
namespace {

constexpr double kLayerAspect = 8, kTolerance = 0.05;

Surroundings afternoon() {
  Surroundings around;
  around.sun = light::sunFrom(215, 40);
  around.sky = light::skyUnder(around.sun);
  return around;
}

/// As the pipeline lights it and a writer widens it.
std::vector<Splat> drawn(base::Genus genus, const shape::ShapeRequest& wanted, float baseMeters,
                         const Surroundings& around) {
  const auto puffs = shape::generate(test::recipeOf(genus), wanted).puffs;
  const light::ExtinctionGrid grid(puffs, light::cellsAlongLongestFor(puffs.size()));
  const auto transfer = light::bakeTransfer(puffs, grid, light::asymmetryOf(genus));
  const auto lights = light::shadePuffs(puffs, transfer, {around.sun.direction, around.sun.color, around.sky},
                                        light::shadingOf(genus));
  const float covering = shape::coveringOf(puffs);
  std::vector<Splat> splats;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    const shape::Puff puff = shape::widenedAcross(puffs[i], covering);
    Splat splat{puff.center + glm::vec3(0, baseMeters, 0), puff.sigma, puff.rotation};
    splat.opacity = -std::expm1(-shape::frontalOpticalDepth(puff));
    splat.color = light::srgbFromLinear(lights[i].color);
    splats.push_back(splat);
  }
  return splats;
}

double meanLuminance(const Picture& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      sum += glm::dot(light::linearFromSrgb(picture.at(x, y)), glm::vec3(0.2126f, 0.7152f, 0.0722f));
  return sum / (picture.width * picture.height);
}

class EveryGenusDrawn : public testing::TestWithParam<base::Genus> {
 protected:
  /// Of small pictures from the south, in which the cloud is as large as can be: from its foot, and from above. A
  /// mean of a few clouds: with other puffs each is another one.
  std::array<double, 2> luminances(int puffs) const {
    const Surroundings around = afternoon();
    const float base = GetParam() == base::Genus::Fog ? 0 : 1000;
    const shape::Recipe recipe = test::recipeOf(GetParam());
    const std::uint64_t variants = recipe.form == shape::Form::Tower ? 6 : 2;
    std::array<double, 2> means{};
    for (std::uint64_t variant = 0; variant < variants; ++variant) {
      shape::ShapeRequest wanted = test::usualCloud(recipe, puffs, kLayerAspect);
      wanted.variant = variant;
      const double width = wanted.widthMeters, middle = base + 0.5 * wanted.depthMeters;
      const auto splats = drawn(GetParam(), wanted, base, around);
      const Camera below{{0, 0.8 * base + 2, 1.1 * width}, {0, middle, 0}, 45, 32, 24},
          above{{0, middle + 0.8 * width, 0.8 * width}, {0, middle, 0}, 45, 32, 24};
      const RenderOptions smooth{.detail = false};
      means[0] += meanLuminance(render(splats, below, around, smooth, {})) / static_cast<double>(variants);
      means[1] += meanLuminance(render(splats, above, around, smooth, {})) / static_cast<double>(variants);
    }
    return means;
  }
};

INSTANTIATE_TEST_SUITE_P(Preview, EveryGenusDrawn, testing::ValuesIn(base::allGenera()),
                         [](const auto& tested) { return std::string(base::name(tested.param)); });

// A budget is a matter of detail, not of brightness.
TEST_P(EveryGenusDrawn, IsAsBrightWithHalfOrTwiceThePuffs) {
  const int puffs = GetParam() == base::Genus::Cumulus || GetParam() == base::Genus::Cumulonimbus ? 1000 : 1600;
  const auto usual = luminances(puffs), half = luminances(puffs / 2), twice = luminances(2 * puffs);
  for (const int view : {0, 1}) {
    EXPECT_NEAR(half[view] / usual[view], 1, kTolerance) << (view ? "from above" : "from its foot");
    EXPECT_NEAR(twice[view] / usual[view], 1, kTolerance) << (view ? "from above" : "from its foot");
  }
}

}  // namespace
}  // namespace cloudgen::image
