// SPDX-License-Identifier: Apache-2.0
#include "light/optics.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace cloudgen::light {
namespace {

/// Integral over the sphere, and mean cosine, of a function of the cosine. Fine near the forward peak.
template <class Function>
std::pair<double, double> moments(Function&& function) {
  double total = 0, cosines = 0;
  constexpr int kSteps = 400'000;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps;  // angle = pi u^3
    const double angle = std::numbers::pi * u * u * u;
    const double weight = 2 * std::numbers::pi * std::sin(angle) * std::numbers::pi * 3 * u * u / kSteps *
                          function(std::cos(angle));
    total += weight;
    cosines += weight * std::cos(angle);
  }
  return {total, cosines};
}

TEST(Phase, HenyeyGreensteinIsNormalisedAndHasItsAsymmetry) {
  for (const double g : {-0.5, 0.0, 0.4, 0.85, 0.988}) {
    const auto [total, cosine] = moments([&](double mu) { return henyeyGreenstein(mu, g); });
    EXPECT_NEAR(total, 1, 1e-4) << g;
    EXPECT_NEAR(cosine, g, 1e-4) << g;
  }
  EXPECT_NEAR(henyeyGreenstein(0.3, 0), 1 / (4 * std::numbers::pi), 1e-12);
}

TEST(Phase, DraineIsNormalisedAndHasItsAsymmetry) {
  for (const auto& [g, alpha] : {std::pair{0.556, 22.0}, {0.3, 1.0}, {0.0, 1.0}}) {
    const auto [total, cosine] = moments([&, g = g, a = alpha](double mu) { return draine(mu, g, a); });
    EXPECT_NEAR(total, 1, 1e-4);
    EXPECT_NEAR(cosine, draineAsymmetry(g, alpha), 1e-4);
  }
  // g = 0, alpha = 1 is Rayleigh's.
  EXPECT_NEAR(draine(0.5, 0, 1), 3 / (16 * std::numbers::pi) * 1.25, 1e-12);
}

TEST(Phase, DropletsOfTenMicrometresAsPublished) {
  const DropletPhase phase = dropletPhase(10);
  EXPECT_NEAR(phase.peakG, 0.988177, 1e-6);
  EXPECT_NEAR(phase.draineG, 0.555671, 1e-6);
  EXPECT_NEAR(phase.draineAlpha, 21.9955, 1e-4);
  EXPECT_NEAR(phase.draineShare, 0.481955, 1e-6);
}

TEST(Phase, DropletsScatterForwardAsCloudsDo) {
  for (const double diameter : {5.0, 10.0, 20.0, 50.0}) {
    const DropletPhase droplets = dropletPhase(diameter);
    const auto [total, cosine] = moments([&](double mu) { return phase(droplets, mu); });
    EXPECT_NEAR(total, 1, 2e-3) << diameter;
    EXPECT_NEAR(cosine, asymmetry(droplets), 2e-3) << diameter;
    EXPECT_NEAR(asymmetry(droplets), kWaterAsymmetry, 0.06) << diameter;
  }
  EXPECT_EQ(dropletPhase(2).peakG, dropletPhase(5).peakG);
}

TEST(Optics, TheLineOfLightScatteredOnceMeetsThePhaseFunction) {
  for (const double g : {0.0, 0.79, 0.85}) {
    const ScatteredOnce once = scatteredOnce(g);
    const auto at = [&](double cosine) { return once.even + once.towards * (0.25 + 0.5 * cosine); };
    EXPECT_NEAR(at(0), 1, 1e-6) << g;
    EXPECT_NEAR(at(-1), henyeyGreenstein(-1, g) / henyeyGreenstein(0, g), 1e-6) << g;
    EXPECT_GE(at(1), 1) << g;
  }
}

}  // namespace
}  // namespace cloudgen::light
