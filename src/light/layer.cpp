// SPDX-License-Identifier: Apache-2.0
#include "light/layer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::light {
namespace {

constexpr float kMost = 0.75f;

float flattening(const shape::Puff& puff) { return puff.sigma.y / std::max(puff.sigma.x, puff.sigma.z); }
float flatness(float flattening) { return 1 - glm::smoothstep(0.2f, 0.32f, flattening); }

}  // namespace

Layer::Layer(const ExtinctionGrid& cloud) : lower_(cloud.lower().y), cell_(cloud.cellMeters()) {
  const glm::ivec3 size = cloud.size();
  const std::vector<float>& cells = cloud.cells();
  const auto at = [&](int x, int y, int z) {
    return cells[(static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) +
                  static_cast<std::size_t>(y)) *
                     static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(x)];
  };
  // How many columns hold the cloud: the square of the sum over the sum of squares of their depths.
  double whole = 0, squares = 0;
  std::vector<double> levels(static_cast<std::size_t>(size.y));
  for (int z = 0; z < size.z; ++z)
    for (int x = 0; x < size.x; ++x) {
      double column = 0;
      for (int y = 0; y < size.y; ++y) {
        levels[static_cast<std::size_t>(y)] += at(x, y, z);
        column += at(x, y, z);
      }
      whole += column;
      squares += column * column;
    }
  const double columns = squares > 0 ? whole * whole / squares : 1;
  below_.push_back(0);
  for (const double level : levels)
    below_.push_back(below_.back() + static_cast<float>(level / columns * cell_));
}

float Layer::depthFrom(float heightMeters, float rise) const {
  constexpr float kFlattest = 0.12f;
  const float place =
      std::clamp((heightMeters - lower_) / cell_, 0.0f, static_cast<float>(below_.size() - 1));
  const auto level = std::min(static_cast<std::size_t>(place), below_.size() - 2);
  const float below = glm::mix(below_[level], below_[level + 1], place - static_cast<float>(level));
  return (rise > 0 ? below_.back() - below : below) / std::max(std::abs(rise), kFlattest);
}

float layerShare(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid) {
  const glm::vec3 size(grid.size());
  const float aspect = std::min(size.x, size.z) / size.y;
  double flat = 0, whole = 1e-12;
  for (const shape::Puff& puff : puffs) {
    const double area = shape::extinctionArea(puff);
    flat += area * flattening(puff);
    whole += area;
  }
  return kMost * glm::smoothstep(1.2f, 2.2f, aspect) * flatness(static_cast<float>(flat / whole));
}

float layerShare(const shape::Puff& puff) { return kMost * flatness(flattening(puff)); }

}  // namespace cloudgen::light
