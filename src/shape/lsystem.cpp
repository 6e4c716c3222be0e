// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/common.hpp>
#include <memory>

#include "shape/file_shape.hpp"
#include "shape/grammar.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::shape {
namespace {

struct Box {
  glm::dvec3 lower{1e300}, upper{-1e300};
};

/// The turtle starts on the condensation level: what hangs below it is cut off flat there.
Box boxOf(const std::vector<GrownBall>& balls) {
  Box box;
  for (const GrownBall& ball : balls) {
    box.lower = glm::min(box.lower, ball.center - ball.radius);
    box.upper = glm::max(box.upper, ball.center + ball.radius);
  }
  box.lower.y = 0;
  return box;
}

/// What a seed grows; where chance draws nothing above the start, what the grammar was checked with.
std::vector<GrownBall> grown(const Grammar& grammar, std::uint64_t seed, std::uint64_t variant) {
  std::vector<GrownBall> balls = grow(grammar, seed, variant);
  const bool stands =
      std::any_of(balls.begin(), balls.end(), [](const GrownBall& ball) { return ball.center.y >= 0; });
  return stands ? balls : grow(grammar, 1, 0);
}

/// Of what some seeds grow.
double meanWidthOverDepth(const Grammar& grammar) {
  constexpr int kSeeds = 6;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Box box = boxOf(grown(grammar, seed, 0));
    const glm::dvec3 size = box.upper - box.lower;
    sum += std::log(std::sqrt(size.x * size.z) / size.y);
  }
  return std::exp(sum / kSeeds);
}

/// One puff a ball, merged to the number asked for.
std::vector<Puff> puffsOf(const std::vector<Lobe>& lobes, int count) {
  std::vector<Puff> puffs;
  for (const Lobe& lobe : lobes) {
    Puff puff;
    puff.center = lobe.center;
    puff.sigma = glm::vec3(0.5 * lobe.radius);
    puff.center.y = std::max(puff.center.y, 1.5f * puff.sigma.y);
    puff.extinctionPerMeter = static_cast<float>(1 / lobe.radius);
    puffs.push_back(puff);
  }
  return reduce(puffs, std::max(1, count));
}

RawShape shaped(const Grammar& grammar, const Recipe& recipe, const ShapeRequest& request) {
  const std::vector<GrownBall> balls = grown(grammar, request.seed, request.variant);
  const Box box = boxOf(balls);
  const glm::dvec3 size = box.upper - box.lower,
                   foot(0.5 * (box.lower.x + box.upper.x), box.lower.y, 0.5 * (box.lower.z + box.upper.z));
  const double across = request.widthMeters / std::sqrt(size.x * size.z), up = request.depthMeters / size.y,
               fair = std::cbrt(across * across * up);
  std::vector<Lobe> lobes;
  for (const GrownBall& ball : balls)
    lobes.push_back({(ball.center - foot) * glm::dvec3(across, up, across), fair * ball.radius,
                     static_cast<std::uint16_t>(lobes.size()), 0});
  RawShape shape;
  if (request.puffs < 2 * static_cast<int>(lobes.size())) {
    shape.puffs = puffsOf(lobes, request.puffs);
    return shape;
  }
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  if (request.puffs >= 12 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 8, 0.42, places);
  fillLobes(shape.puffs, lobes, recipe, request.puffs, 0, fills);
  return shape;
}

}  // namespace

FileShape shapeFromGrammar(const std::string& json, const std::string& where) {
  const auto grammar = std::make_shared<const Grammar>(grammarFromJson(json, where));
  FileShape shape;
  shape.kind = "lsystem";
  shape.widthOverDepth = meanWidthOverDepth(*grammar);
  shape.shape = [grammar](const Recipe& recipe, const ShapeRequest& request) {
    return shaped(*grammar, recipe, request);
  };
  return shape;
}

}  // namespace cloudgen::shape
