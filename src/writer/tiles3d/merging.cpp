// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/merging.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <tuple>

namespace cloudgen::writer::tiles3d {
namespace {

float widest(const shape::Puff& puff) { return std::max({puff.sigma.x, puff.sigma.y, puff.sigma.z}); }

/// What a puff of that optical depth in its middle covers, to the square of its deviation and 2 pi: the integral of
/// 1 - exp(-optical depth) over its Gaussian (Ein, the entire exponential integral).
double coverOf(double opticalDepth) {
  if (opticalDepth < 0.01) return opticalDepth * (1 - opticalDepth / 4);
  return std::numbers::egamma + std::log(opticalDepth) - std::expint(-opticalDepth);
}

/// The optical depth that covers so much.
double opticalDepthThatCovers(double cover) {
  double least = cover, most = cover * std::exp(std::min(cover, 100.0));
  for (int pass = 0; pass < 40; ++pass) {
    const double middle = std::sqrt(least * most);
    (coverOf(middle) > cover ? most : least) = middle;
  }
  return std::sqrt(least * most);
}

/// As wide as that at its widest, and as much thinner as covers the same.
shape::Puff widenedTo(shape::Puff puff, float sigma) {
  const float by = sigma / widest(puff);
  const double opticalDepth = shape::frontalOpticalDepth(puff);
  if (by <= 1 || !(opticalDepth > 0)) return puff;
  const double thinner = opticalDepthThatCovers(coverOf(opticalDepth) / (by * by)) / opticalDepth;
  puff.sigma *= by;
  puff.extinctionPerMeter *= static_cast<float>(thinner) / by;
  return puff;
}

using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

}  // namespace

LitPuff joined(std::span<const LitPuff> puffs) {
  glm::dvec3 mean(0), variance(0), color(0);
  double covered = 0, forward = 0;
  const auto squareMeters = [](const shape::Puff& puff) {
    return coverOf(shape::frontalOpticalDepth(puff)) * puff.sigma.x * puff.sigma.z;
  };
  for (const LitPuff& one : puffs) {
    const double cover = squareMeters(one.puff);
    covered += cover;
    mean += cover * glm::dvec3(one.puff.center);
    color += cover * glm::dvec3(one.light.color);
    forward += cover * static_cast<double>(one.light.forward);
  }
  if (covered <= 0) return puffs.front();
  mean /= covered;
  for (const LitPuff& one : puffs) {
    const shape::Bounds own = shape::boundsOf(std::span(&one.puff, 1), 1);
    const glm::dvec3 half = 0.5 * glm::dvec3(own.upper - own.lower),
                     away = glm::dvec3(one.puff.center) - mean;
    variance += squareMeters(one.puff) / covered * (half * half + away * away);
  }
  LitPuff out{
      puffs.front().puff,
      {glm::vec3(color / covered), static_cast<float>(forward / covered)},
      std::ranges::max_element(puffs, {}, [&](const LitPuff& one) { return squareMeters(one.puff); })->genus};
  out.puff.center = mean;
  out.puff.rotation = glm::quat(1, 0, 0, 0);
  out.puff.sigma = glm::sqrt(variance);
  const double opticalDepth = covered / (out.puff.sigma.x * out.puff.sigma.z);
  const float thinnest = std::min({out.puff.sigma.x, out.puff.sigma.y, out.puff.sigma.z});
  out.puff.extinctionPerMeter = static_cast<float>(opticalDepth) / shape::centralOpticalDepth(1, thinnest);
  return out;
}

std::vector<LitPuff> mergedWithin(std::vector<LitPuff> puffs, double errorMeters) {
  const auto leastSigma = static_cast<float>(kLeastSigmaOfError * errorMeters);
  const auto cellOf = [side = errorMeters / 4](const glm::dvec3& place) {
    const glm::dvec3 whole = glm::floor(place / side);
    return Cell{static_cast<std::int64_t>(whole.y), static_cast<std::int64_t>(whole.z),
                static_cast<std::int64_t>(whole.x)};
  };
  std::vector<LitPuff> out, near;
  std::vector<std::pair<Cell, std::size_t>> small;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    if (widest(puffs[i].puff) < leastSigma)
      small.emplace_back(cellOf(puffs[i].puff.center), i);
    else
      out.push_back(puffs[i]);
  }
  std::sort(small.begin(), small.end());
  for (std::size_t i = 0; i < small.size(); ++i) {
    near.push_back(puffs[small[i].second]);
    if (i + 1 < small.size() && small[i + 1].first == small[i].first) continue;
    out.push_back(near.size() == 1 ? near.front() : joined(near));
    out.back().puff = widenedTo(out.back().puff, leastSigma);
    near.clear();
  }
  return out;
}

}  // namespace cloudgen::writer::tiles3d
