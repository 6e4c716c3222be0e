// SPDX-License-Identifier: Apache-2.0
#include "runtime/lighting.hpp"

#include <glm/common.hpp>

#include "light/color.hpp"
#include "support/made_pack.hpp"

namespace cloudgen::runtime {
namespace {

/// Largest difference, in steps of 255, between the colours of the runtime and those that the scene was shaded with.
float worstDifference(const scene::Scene& scene, const Lighting& lighting) {
  float worst = 0;
  for (const scene::LitArchetype& lit : scene.lit) {
    const std::int64_t first = lighting.firstColor(lit.archetype, static_cast<std::uint32_t>(lit.yawStep));
    EXPECT_GE(first, 0);
    for (std::size_t p = 0; p < lit.puffs.size(); ++p) {
      const PuffColor& color = lighting.colors()[static_cast<std::size_t>(first) + p];
      const glm::vec3 wanted = 255.0f * light::srgbFromLinear(glm::min(lit.puffs[p].color, glm::vec3(1)));
      worst = std::max({worst, std::abs(wanted.r - color.red), std::abs(wanted.g - color.green),
                        std::abs(wanted.b - color.blue)});
      worst = std::max(worst, std::abs(static_cast<float>(color.forward) - 255 / kMostForward * lit.puffs[p].forward));
    }
  }
  return worst;
}

TEST(Lighting, ColoursAreThoseOfTheScene) {
  for (const auto& [azimuth, elevation] : {std::pair{200.0, 35.0}, {90.0, 8.0}, {20.0, 71.0}, {260.0, 1.0}}) {
    scene::Scene scene = test::smallScene();
    scene.sun = light::sunFrom(azimuth, elevation);
    scene.sky = light::skyUnder(scene.sun);
    scene = test::withLight(scene);
    const std::string bytes = test::packOf(scene);
    PackView view;
    ASSERT_TRUE(view.open(test::bytesOf(bytes)));
    Lighting lighting(view, false);
    lighting.setSun({static_cast<float>(azimuth), static_cast<float>(elevation)});
    EXPECT_LT(worstDifference(scene, lighting), 8) << "sun at " << elevation;
  }
}

TEST(Lighting, ASunThatMovesIsTheSunOfAPackThatWasMadeUnderIt) {
  scene::Scene morning = test::smallScene(), evening = test::smallScene();
  morning.sun = light::sunFrom(100, 20);
  evening.sun = light::sunFrom(280, 20);
  morning.sky = evening.sky = light::skyUnder(morning.sun);
  morning = test::withLight(morning);
  evening = test::withLight(evening);
  const std::string bytes = test::packOf(morning);
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  Lighting lighting(view, false);
  lighting.setSun({280, 20});
  EXPECT_LT(worstDifference(evening, lighting), 8);
  EXPECT_GT(worstDifference(morning, lighting), 30) << "the sun makes a difference";
}

TEST(Lighting, NoColourOverflowsWhateverTheSun) {
  const std::string bytes = test::packOf(test::packScene());
  PackView view;
  ASSERT_TRUE(view.open(test::bytesOf(bytes)));
  Lighting lighting(view, true);
  float before = 0;
  for (float elevation = -30; elevation <= 90; elevation += 5) {
    lighting.setSun({77, elevation});
    const Vec3 sun = lighting.sunColor(0);
    EXPECT_TRUE(isFinite(sun) && sun.x <= 1.001f && sun.x >= 0);
    EXPECT_GE(sun.x, before - 1e-4f) << "it reddens and dims as it sinks";
    before = sun.x;
    EXPECT_TRUE(isFinite(lighting.sky().zenith) && isFinite(lighting.sky().ambient));
  }
}

}  // namespace
}  // namespace cloudgen::runtime
