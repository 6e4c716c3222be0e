// SPDX-License-Identifier: Apache-2.0
#include "light/extinction_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::light {

int cellsAlongLongestFor(std::size_t puffs) {
  return std::clamp(static_cast<int>(5.0 * std::cbrt(static_cast<double>(puffs))), 12, 90);
}

ExtinctionGrid::ExtinctionGrid(std::span<const shape::Puff> puffs, int cellsAlongLongest) {
  const shape::Bounds bounds = shape::boundsOf(puffs, 2.0f);
  const glm::vec3 size = bounds.upper - bounds.lower;
  const float longest = std::max({size.x, size.y, size.z, 1.0f});
  // Many puffs tell finer relief, which must be lit, too.
  constexpr float kMany = 20000, kMostFiner = 2.5f;
  const float finer = std::clamp(std::cbrt(static_cast<float>(puffs.size()) / kMany), 1.0f, kMostFiner);
  // Flat clouds get finer cells, so that their depth is resolved by a few.
  const float shortest = std::max(std::min({size.x, size.y, size.z}), longest / 64.0f);
  cell_ = std::max(std::min(longest / (finer * static_cast<float>(cellsAlongLongest)), shortest / 6.0f),
                   longest / (finer * 160.0f));
  // And no more cells than the puffs can tell apart.
  const double mostCells = 400.0 * static_cast<double>(std::max<size_t>(puffs.size(), 10));
  cell_ = std::max(cell_,
                   static_cast<float>(std::cbrt(static_cast<double>(size.x) * size.y * size.z / mostCells)));
  lower_ = bounds.lower - glm::vec3(cell_);
  nx_ = static_cast<int>(size.x / cell_) + 3;
  ny_ = static_cast<int>(size.y / cell_) + 3;
  nz_ = static_cast<int>(size.z / cell_) + 3;
  values_.assign(static_cast<size_t>(nx_) * ny_ * nz_, 0.0f);

  // Each puff as its Gaussian sampled at the cells within two deviations, normalised to its extinction area.
  std::vector<float> weights;
  for (const shape::Puff& puff : puffs) {
    const shape::Bounds own = shape::boundsOf({&puff, 1}, 2.0f);
    const glm::ivec3 from = glm::max(glm::ivec3((own.lower - lower_) / cell_), glm::ivec3(0));
    const glm::ivec3 to =
        glm::min(glm::ivec3((own.upper - lower_) / cell_), glm::ivec3(nx_ - 1, ny_ - 1, nz_ - 1));
    const glm::vec3 blurred = glm::max(puff.sigma, glm::vec3(0.45f * cell_));
    const glm::quat inverse = glm::conjugate(puff.rotation);
    weights.clear();
    double total = 0;
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
          const glm::vec3 cellCenter = lower_ + (glm::vec3(x, y, z) + 0.5f) * cell_;
          const glm::vec3 local = (inverse * (cellCenter - puff.center)) / blurred;
          weights.push_back(std::exp(-0.5f * (local.x * local.x + local.y * local.y + local.z * local.z)));
          total += weights.back();
        }
    if (total <= 0) continue;
    const float scale =
        static_cast<float>(shape::extinctionArea(puff) / (total * std::pow(static_cast<double>(cell_), 3)));
    size_t next = 0;
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
          values_[(static_cast<size_t>(z) * ny_ + y) * nx_ + x] += scale * weights[next++];
  }
}

float ExtinctionGrid::sample(const std::vector<float>& field, const glm::vec3& point) const {
  const glm::vec3 p = (point - lower_) / cell_ - 0.5f;
  const glm::vec3 f = glm::floor(p), t = p - f;
  const glm::ivec3 first(f);
  if (first.x >= 0 && first.y >= 0 && first.z >= 0 && first.x + 1 < nx_ && first.y + 1 < ny_ &&
      first.z + 1 < nz_) {
    const size_t slice = static_cast<size_t>(nx_) * ny_;
    const float* c = &field[(static_cast<size_t>(first.z) * ny_ + first.y) * nx_ + first.x];
    const auto plane = [&](const float* q) {
      return glm::mix(glm::mix(q[0], q[1], t.x), glm::mix(q[nx_], q[nx_ + 1], t.x), t.y);
    };
    return glm::mix(plane(c), plane(c + slice), t.z);
  }
  const auto at = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= nx_ || y >= ny_ || z >= nz_) return 0.0f;
    return field[(static_cast<size_t>(z) * ny_ + y) * nx_ + x];
  };
  const auto along = [&](int j, int k) { return glm::mix(at(first.x, j, k), at(first.x + 1, j, k), t.x); };
  const auto plane = [&](int k) { return glm::mix(along(first.y, k), along(first.y + 1, k), t.y); };
  return glm::mix(plane(first.z), plane(first.z + 1), t.z);
}

float ExtinctionGrid::extinction(const glm::vec3& point) const { return sample(values_, point); }

glm::vec3 ExtinctionGrid::gradient(const glm::vec3& point) const {
  glm::vec3 out;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 step(0);
    step[axis] = 0.75f * cell_;
    out[axis] = extinction(point + step) - extinction(point - step);
  }
  return out;
}

}  // namespace cloudgen::light
