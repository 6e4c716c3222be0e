// SPDX-License-Identifier: Apache-2.0
#include "light/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "light/genus_light.hpp"
#include "light/optics.hpp"
#include "light/sweep.hpp"
#include "shape/generate.hpp"
#include "support/all_recipes.hpp"
#include "support/usual_cloud.hpp"

namespace cloudgen::light {
namespace {

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

Lighting lightingOf(double azimuth, double elevation) {
  const Sun sun = sunFrom(azimuth, elevation);
  return {sun.direction, sun.color, skyUnder(sun)};
}

/// A block of puffs, the same seen from east and west, north and south.
std::vector<shape::Puff> block(float extinction) {
  std::vector<shape::Puff> puffs;
  for (int z = -4; z <= 4; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = -4; x <= 4; ++x) {
        shape::Puff puff;
        puff.center = 120.0f * glm::vec3(x, y, z);
        puff.sigma = glm::vec3(80);
        puff.extinctionPerMeter = extinction;
        puffs.push_back(puff);
      }
  return puffs;
}

std::vector<PuffLight> shaded(const std::vector<shape::Puff>& puffs, const Lighting& lighting,
                              float shading = 1) {
  return shadePuffs(puffs, bakeTransfer(puffs, ExtinctionGrid(puffs, 40), kWaterAsymmetry), lighting,
                    shading);
}

template <class Choice>
float meanLuminance(const std::vector<shape::Puff>& puffs, const std::vector<PuffLight>& lights,
                    Choice&& choice) {
  float sum = 0, count = 0;
  for (std::size_t i = 0; i < puffs.size(); ++i)
    if (choice(puffs[i])) sum += luminance(lights[i].color), ++count;
  return sum / count;
}

// Photons give this block 14 times more light on its sunlit side than on the other (sun at 20 degrees), 7
// times more above than below (zenith), before sky and tone curve.
TEST(Shade, TheSunlitSideIsBrighter) {
  const auto puffs = block(0.02f);
  const auto lights = shaded(puffs, lightingOf(90, 20));
  // In the middle of the faces: edges are lit from more sides.
  const auto inner = [](float a) { return std::abs(a) < 300; };
  const auto level = [](const shape::Puff& p) { return p.center.y > 100 && p.center.y < 400; };
  const float lit = meanLuminance(puffs, lights,
                                  [&](auto& p) { return p.center.x > 400 && inner(p.center.z) && level(p); });
  const float shadow = meanLuminance(
      puffs, lights, [&](auto& p) { return p.center.x < -400 && inner(p.center.z) && level(p); });
  EXPECT_GT(lit, 1.5f * shadow);
  const auto noon = shaded(puffs, lightingOf(180, 90));
  const auto middle = [&](const shape::Puff& p) { return inner(p.center.x) && inner(p.center.z); };
  EXPECT_GT(meanLuminance(puffs, noon, [&](auto& p) { return p.center.y > 400 && middle(p); }),
            1.3f * meanLuminance(puffs, noon, [&](auto& p) { return p.center.y < 100 && middle(p); }));
}

TEST(Shade, TheSunFromTheOtherSideMirrors) {
  const auto puffs = block(0.02f);
  const auto east = shaded(puffs, lightingOf(90, 30)), west = shaded(puffs, lightingOf(270, 30));
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    const auto mirrored = std::find_if(puffs.begin(), puffs.end(), [&](auto& p) {
      return p.center == puffs[i].center * glm::vec3(-1, 1, 1);
    });
    const auto& other = west[static_cast<std::size_t>(mirrored - puffs.begin())];
    EXPECT_NEAR(luminance(east[i].color), luminance(other.color), 0.05);
  }
}

TEST(Shade, AThinCloudIsNearlyUniform) {
  const auto puffs = block(2e-5f);
  const auto lights = shaded(puffs, lightingOf(120, 40), 0.2f);
  const auto [darkest, brightest] = std::minmax_element(
      lights.begin(), lights.end(), [](auto& a, auto& b) { return luminance(a.color) < luminance(b.color); });
  EXPECT_LT(luminance(brightest->color), 1.25f * luminance(darkest->color));
}

TEST(Shade, NoShadingIsFlat) {
  const auto puffs = block(0.003f);
  const auto spread = [&](float shading) {
    const auto lights = shaded(puffs, lightingOf(120, 40), shading);
    const auto [a, b] = std::minmax_element(lights.begin(), lights.end(), [](auto& p, auto& q) {
      return luminance(p.color) < luminance(q.color);
    });
    return luminance(b->color) / luminance(a->color);
  };
  EXPECT_LT(spread(0), spread(0.5f));
  EXPECT_LT(spread(0.5f), spread(1));
}

TEST(Shade, LookingTowardsTheSunOnlyThinEdgesShine) {
  const auto puffs = block(0.02f);
  const auto lights = shaded(puffs, lightingOf(90, 5));
  float edge = 0, deep = 1;
  for (std::size_t i = 0; i < puffs.size(); ++i)
    if (puffs[i].center.y == 240 && puffs[i].center.z == 0) {
      if (puffs[i].center.x > 470) edge = lights[i].forward;
      if (puffs[i].center.x < -470) deep = lights[i].forward;
    }
  EXPECT_GT(edge, deep);
  EXPECT_LT(deep, 0.01f);
}

class EveryGenusLit : public testing::TestWithParam<base::Genus> {
 protected:
  std::vector<shape::Puff> puffs() const {
    const shape::Recipe recipe = test::recipeOf(GetParam());
    return shape::generate(recipe, test::usualCloud(recipe, 600, 20)).puffs;
  }
};

std::string genusName(const testing::TestParamInfo<base::Genus>& tested) {
  return std::string(base::name(tested.param));
}
INSTANTIATE_TEST_SUITE_P(Light, EveryGenusLit, testing::ValuesIn(base::allGenera()), genusName);

TEST_P(EveryGenusLit, EnergyStaysInBoundsWhereverTheSunIs) {
  const auto cloud = puffs();
  for (const double elevation : {-5.0, 2.0, 10.0, 45.0, 90.0})
    for (const float shading : {0.05f, 1.0f})
      for (const PuffLight& light : shaded(cloud, lightingOf(200, elevation), shading)) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(std::isfinite(light.color[c]));
          ASSERT_GE(light.color[c], 0);
        }
        ASSERT_LT(luminance(light.color), 1.3f) << elevation;
        ASSERT_TRUE(std::isfinite(light.forward) && light.forward >= 0 && light.forward < 1);
      }
}

/// Luminance of a cloud as one who looks down sees it: each puff by its area, its opacity, and what is left of it
/// through those above; `share` of it that is brightest.
double seenFromAbove(const std::vector<shape::Puff>& cloud, const std::vector<PuffLight>& lights, DepthSweep& sweep,
                     double share) {
  std::vector<std::pair<double, double>> seen;
  double whole = 0;
  sweep.towards({0, 1, 0});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const shape::Puff& puff = cloud[i];
    const double area = static_cast<double>(puff.sigma.x) * puff.sigma.z *
                        -std::expm1(-shape::frontalOpticalDepth(puff)) *
                        std::exp(-sweep.at(puff.center + puff.sigma.y * glm::vec3(0, 1, 0)));
    seen.emplace_back(luminance(lights[i].color), area);
    whole += area;
  }
  std::sort(seen.rbegin(), seen.rend());
  double light = 0, left = share * whole;
  for (const auto& [one, area] : seen) {
    light += one * std::min(area, left);
    if ((left -= area) <= 0) break;
  }
  return light / (share * whole);
}

// As the pipeline lights them. Seen from above every genus is bright white with relief (the WMO's atlas): so is its
// lit half under suns from noon to late afternoon, and the whole is never dark.
TEST_P(EveryGenusLit, TopsAreBrightUnderAnySunOfTheDay) {
  const auto cloud = puffs();
  const ExtinctionGrid grid(cloud, 40);
  const CloudTransfer transfer = bakeTransfer(cloud, grid, asymmetryOf(GetParam()));
  DepthSweep sweep(grid);
  for (const double elevation : {66.0, 45.0, 25.0}) {
    const auto lights = shadePuffs(cloud, transfer, lightingOf(160, elevation), shadingOf(GetParam()));
    const double lit = seenFromAbove(cloud, lights, sweep, 0.5), whole = seenFromAbove(cloud, lights, sweep, 1);
    RecordProperty("lit", std::to_string(lit));
    EXPECT_GT(lit, 0.65) << elevation;
    EXPECT_GT(whole, 0.45) << elevation;
  }
}

// One transfer for every sun: what the harmonics lose of the answers that are baked for one sun. Below the thickest layer
// they miss some of the narrow light that comes through from the zenith.
TEST_P(EveryGenusLit, TheTransferHoldsEverySun) {
  const auto cloud = puffs();
  const ExtinctionGrid grid(cloud, 24);
  const auto transfers = bakeTransfer(cloud, grid, kWaterAsymmetry).puffs;
  for (const double elevation : {3.0, 20.0, 50.0, 80.0})
    for (const double azimuth : {10.0, 130.0, 250.0}) {
      const glm::vec3 sun = sunFrom(azimuth, elevation).direction;
      const auto answers = bakeSun(cloud, grid, kWaterAsymmetry, sun);
      const Harmonics harmonics = harmonicsOf(sun);
      double squares = 0, norm = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double off = dot(transfers[i].sun, harmonics) - answers[i].sun;
        squares += off * off;
        norm += static_cast<double>(answers[i].sun) * answers[i].sun;
      }
      EXPECT_LT(std::sqrt(squares / norm), GetParam() == base::Genus::Nimbostratus ? 0.065 : 0.05) << elevation << ' ' << azimuth;
    }
}

TEST_P(EveryGenusLit, LightFromEverywhereIsKept) {
  const auto cloud = puffs();
  const CloudTransfer baked = bakeTransfer(cloud, ExtinctionGrid(cloud, 24), kWaterAsymmetry);
  for (const PuffTransfer& transfer : baked.puffs) {
    EXPECT_NEAR(transfer.sky + transfer.ground, 1, 1e-4);
    EXPECT_TRUE(transfer.visibility >= 0 && transfer.visibility <= 1);
  }
}

}  // namespace
}  // namespace cloudgen::light
