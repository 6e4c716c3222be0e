// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/narrow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

/// One place of a lattice along an axis, and its share.
struct Node {
  float offsetMeters = 0, share = 1;
};

struct Lattice {
  float sigmaMeters = 0;
  std::vector<Node> nodes;
};

/// n Gaussians of deviation s, spaced no wider than 2 s, with the weights of n - 1 coin tosses have the variance
/// n s2 together.
Lattice latticeOf(float sigma) {
  constexpr float kFaintest = 0.02f;  // share, to the largest, below which a node is left out
  constexpr float kLittleMore = 1.25f;  // is drawn narrower: two pieces an axis for that would be eight in all
  if (sigma <= kLittleMore * kMostSigmaMeters) return {std::min(sigma, kMostSigmaMeters), {{}}};
  const float ratio = sigma / kMostSigmaMeters;
  const int tosses = static_cast<int>(std::ceil(ratio * ratio)) - 1;
  const float spread = std::sqrt(sigma * sigma - kMostSigmaMeters * kMostSigmaMeters);
  const float step = 2 * spread / std::sqrt(static_cast<float>(tosses));
  Lattice out{kMostSigmaMeters, {}};
  float sum = 0;
  const auto logShare = [&](int heads) {
    return -std::lgamma(heads + 1.0f) - std::lgamma(static_cast<float>(tosses - heads) + 1.0f);
  };
  // Farther off the middle a share is less than exp(-2 1.5^2), to the largest.
  const int middle = tosses / 2, reach = static_cast<int>(1.5f * std::sqrt(static_cast<float>(tosses))) + 2;
  for (int heads = std::max(0, middle - reach); heads <= std::min(tosses, middle + reach); ++heads) {
    const float share = std::exp(logShare(heads) - logShare(tosses / 2));
    if (share < kFaintest) continue;
    out.nodes.push_back({(static_cast<float>(heads) - 0.5f * static_cast<float>(tosses)) * step, share});
    sum += share;
  }
  for (Node& node : out.nodes) node.share /= sum;
  return out;
}

std::array<Lattice, 3> latticesOf(const shape::Puff& puff) {
  return {latticeOf(puff.sigma.x), latticeOf(puff.sigma.y), latticeOf(puff.sigma.z)};
}

}  // namespace

std::size_t narrowCount(const shape::Puff& puff) {
  const auto [x, y, z] = latticesOf(puff);
  return x.nodes.size() * y.nodes.size() * z.nodes.size();
}

void appendNarrow(const LitPuff& lit, std::vector<LitPuff>& out) {
  const auto [x, y, z] = latticesOf(lit.puff);
  const std::size_t first = out.size();
  const glm::vec3 sigma(x.sigmaMeters, y.sigmaMeters, z.sigmaMeters);
  const float denser = lit.puff.sigma.x * lit.puff.sigma.y * lit.puff.sigma.z / (sigma.x * sigma.y * sigma.z);
  float most = 0;
  for (const Node& a : x.nodes)
    for (const Node& b : y.nodes)
      for (const Node& c : z.nodes) {
        LitPuff part = lit;
        part.puff.center += lit.puff.rotation * glm::vec3(a.offsetMeters, b.offsetMeters, c.offsetMeters);
        part.puff.sigma = sigma;
        part.puff.extinctionPerMeter *= denser * a.share * b.share * c.share;
        most = std::max(most, part.puff.extinctionPerMeter);
        out.push_back(std::move(part));
      }
  double all = 0, kept = 0;
  const auto isFaint = [&](const LitPuff& part) {
    return gltf::splatOpacity(part.puff) < gltf::kLeastOpacity &&
           part.puff.extinctionPerMeter < 0.3f * most;
  };
  for (std::size_t i = first; i < out.size(); ++i) {
    const auto extinction = static_cast<double>(out[i].puff.extinctionPerMeter);
    all += extinction;
    if (!isFaint(out[i])) kept += extinction;
  }
  out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), isFaint), out.end());
  for (std::size_t i = first; i < out.size(); ++i)
    out[i].puff.extinctionPerMeter *= static_cast<float>(all / kept);
}

}  // namespace cloudgen::writer::tiles3d
