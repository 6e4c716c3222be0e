// SPDX-License-Identifier: Apache-2.0
#include "shape/file_shape.hpp"

#include <algorithm>
#include <cassert>

namespace cloudgen::shape {

namespace {

/// Numbers the parts of a cloud that are halves of halves of it across its longest side.
void numberSections(std::span<Puff> puffs, int parts, std::uint16_t& next) {
  if (parts <= 1 || puffs.size() <= 1) {
    for (Puff& puff : puffs) puff.section = next;
    ++next;
    return;
  }
  const Bounds box = boundsOf(puffs);
  const glm::vec3 size = box.upper - box.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.z >= size.y ? 2 : 1;
  std::stable_sort(puffs.begin(), puffs.end(),
                   [axis](const Puff& a, const Puff& b) { return a.center[axis] < b.center[axis]; });
  const std::size_t middle = puffs.size() / 2;
  numberSections(puffs.first(middle), parts / 2, next);
  numberSections(puffs.subspan(middle), parts - parts / 2, next);
}

}  // namespace

RawShape shapeFromFile(const Recipe& recipe, const ShapeRequest& request) {
  assert(recipe.fileShape);
  RawShape shape = recipe.fileShape->shape(recipe, request);
  if (recipe.flatBase) flattenBase(shape.puffs, request.depthMeters);
  // Formats turn each section to the viewer as one: small ones keep the form from every side.
  constexpr std::size_t kMostSections = 20, kPuffs = 12;
  std::uint16_t next = 0;
  numberSections(shape.puffs, static_cast<int>(std::min(kMostSections, shape.puffs.size() / kPuffs)), next);
  return shape;
}

void flattenBase(std::vector<Puff>& puffs, double depthMeters) {
  constexpr double kLevel = 1.0 / 12, kDeviations = 1.6, kFlattest = 0.5;
  const auto level = static_cast<float>(kLevel * depthMeters);
  for (Puff& puff : puffs) {
    const float widest = std::max({puff.sigma.x, puff.sigma.y, puff.sigma.z});
    if (puff.center.y - static_cast<float>(kDeviations) * widest > level) continue;
    const float sum = puff.sigma.x + puff.sigma.y + puff.sigma.z,
                area = static_cast<float>(extinctionArea(puff));
    const float round = sum / 3;
    puff.rotation = glm::quat(1, 0, 0, 0);
    puff.sigma = glm::vec3(round, static_cast<float>(kFlattest) * round, round);
    puff.extinctionPerMeter = 1;
    puff.extinctionPerMeter = area / static_cast<float>(extinctionArea(puff));
    puff.center.y = std::max(puff.center.y, level + static_cast<float>(kDeviations) * puff.sigma.y);
  }
}

}  // namespace cloudgen::shape
