// SPDX-License-Identifier: Apache-2.0
#include "light/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "light/octaves.hpp"
#include "light/sweep.hpp"

namespace cloudgen::light {
namespace {

constexpr int kRings = 3;

/// What is seen of a puff is its skin: its own body, out to a little over a deviation, does not shade it, nor
/// do the first 0.6 of optical depth, through which one sees.
constexpr float kSkin = 1.2f, kSeenDepth = 0.6f;
/// Diffuse light takes a longer way through a slab than the straight one; with the cosine-weighted mean over
/// a hemisphere, this factor of the depths brings a slab back to the two-stream solution.
constexpr float kDiffusivity = 0.69f;
/// How much of what comes to a skin has lost its direction. All of these are set by the path tracer of the
/// tests: spheres, slabs and heaps.
constexpr float kSpread = 0.93f;
/// Thinning of the depths for what goes on nearly straight (most of a forward peak), by which a puff also
/// knows where outside is.
constexpr float kClear = 0.5f;

/// Standard deviation of a puff along a direction of the cloud.
float reachAlong(const shape::Puff& puff, const glm::vec3& direction) {
  return glm::length(puff.sigma * (glm::conjugate(puff.rotation) * direction));
}

/// Depths of every puff along a direction: from its skin, and from its middle.
struct Depths {
  std::vector<float> skin, middle;
};

Depths depthsTowards(DepthSweep& sweep, std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                     const glm::vec3& direction) {
  sweep.towards(direction);
  Depths depths;
  for (const shape::Puff& puff : puffs) {
    const float reach = std::max(kSkin * reachAlong(puff, direction), 0.5f * grid.cellMeters());
    depths.skin.push_back(std::max(0.0f, sweep.at(puff.center + reach * direction) - kSeenDepth));
    depths.middle.push_back(sweep.at(puff.center));
  }
  return depths;
}

/// ((1 + cos) / 2)^3: like the cosine of a matt surface, its mean over the sphere is a quarter, so that under
/// an even light from everywhere nothing is lost; it turns around the edge as light in a cloud does, and
/// three degrees of harmonics hold it.
float facing(float cosine) {
  const float half = 0.5f + 0.5f * cosine;
  return half * half * half;
}

/// The lattice of directions, and the share that each has in the diffuse light about each.
struct Lattice {
  std::vector<glm::vec3> directions = opposedDirections(kRings);
  HarmonicFit fit{directions};
  std::vector<std::vector<float>> shares;

  Lattice() {
    for (const glm::vec3& direction : directions) shares.push_back(sharesAbout(direction));
  }
  /// Weights by the cosine, of sum 1.
  std::vector<float> sharesAbout(const glm::vec3& direction) const {
    std::vector<float> about;
    float sum = 0;
    for (const glm::vec3& other : directions) {
      about.push_back(std::max(0.0f, glm::dot(direction, other)));
      sum += about.back();
    }
    for (float& share : about) share /= sum;
    return about;
  }
};

const Lattice& lattice() {
  static const Lattice made;
  return made;
}

/// A puff between all directions: what reaches its skin and its middle from each, and where outside is.
struct Place {
  std::vector<float> direct;        ///< transmitted by all orders to the skin, on straight ways
  std::vector<float> skin, middle;  ///< and on the longer ways of diffuse light
  std::vector<float> clear;         ///< what of the beam comes straight to the skin
  glm::vec3 normal{0};              ///< mean direction to the outside, of length 1 on a flat skin
};

std::vector<Place> placesOf(std::span<const shape::Puff> puffs, DepthSweep& sweep, const ExtinctionGrid& grid,
                            float reduction, std::vector<PuffTransfer>& transfers) {
  const auto& directions = lattice().directions;
  std::vector<Place> places(puffs.size());
  std::vector<float> open(puffs.size());
  for (const glm::vec3& direction : directions) {
    const Depths depths = depthsTowards(sweep, puffs, grid, direction);
    for (std::size_t p = 0; p < puffs.size(); ++p) {
      places[p].direct.push_back(transmitted(reduction * depths.skin[p]));
      places[p].skin.push_back(transmitted(kDiffusivity * reduction * depths.skin[p]));
      places[p].middle.push_back(transmitted(kDiffusivity * reduction * depths.middle[p]));
      const float clear = std::exp(-kClear * depths.skin[p]);
      places[p].clear.push_back(clear);
      places[p].normal += clear * direction;
      open[p] += clear;
      transfers[p].visibility += std::exp(-depths.skin[p]) / static_cast<float>(directions.size());
    }
  }
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    glm::vec3& normal = places[p].normal;
    normal *= 2.0f / (open[p] + 1e-12f);
    if (glm::dot(normal, normal) > 1) normal = glm::normalize(normal);
  }
  return places;
}

/// Mean over a lobe.
float about(const std::vector<float>& shares, const std::vector<float>& values) {
  float sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += shares[i] * values[i];
  return sum;
}

/// A skin that faces the sun shows what comes back, one that faces away what comes through.
SunAnswer answer(const Place& place, const glm::vec3& direction, float before, float behind, float clear) {
  const float strength = glm::length(place.normal);
  const glm::vec3 normal = place.normal / (strength + 1e-12f);
  const float cosine = glm::dot(normal, direction);
  const float towards = 0.25f + strength * (facing(cosine) - 0.25f),
              away = 0.25f + strength * (facing(-cosine) - 0.25f);
  // Depths in a row add up: 2 / transmitted = 2 + tau'.
  const float through = 1.0f / (1.0f / before + 1.0f / behind - 1.0f);
  return {towards * (before - through) + away * before, clear};
}

/// The answer that a twelfth of the seen area exceeds, under the best of 12 suns.
float brightAnswer(std::span<const shape::Puff> puffs, std::span<const PuffTransfer> transfers) {
  float brightest = 1e-3f;
  std::vector<std::pair<float, float>> answers(puffs.size());
  for (const glm::vec3& direction : opposedDirections(2)) {
    if (direction.y < 0) break;
    const Harmonics harmonics = harmonicsOf(direction);
    double left = 0;
    for (std::size_t i = 0; i < puffs.size(); ++i) {
      answers[i] = {dot(transfers[i].sun, harmonics), seenArea(puffs[i], transfers[i])};
      left += 0.08 * answers[i].second;
    }
    std::sort(answers.begin(), answers.end(), std::greater<>());
    for (const auto& [answer, area] : answers)
      if ((left -= area) <= 0) {
        brightest = std::max(brightest, answer);
        break;
      }
  }
  return brightest;
}

}  // namespace

float seenArea(const shape::Puff& puff, const PuffTransfer& transfer) {
  return puff.sigma.x * puff.sigma.z * transfer.visibility;
}

CloudTransfer bakeTransfer(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid, float asymmetry) {
  const Lattice& even = lattice();
  const std::size_t count = even.directions.size();
  DepthSweep sweep(grid);
  std::vector<PuffTransfer> transfers(puffs.size());
  const std::vector<Place> places = placesOf(puffs, sweep, grid, 1.0f - asymmetry, transfers);
  std::vector<float> sun(count), through(count);
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    PuffTransfer& transfer = transfers[p];
    float all = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t opposite = (j + count / 2) % count;
      const float before =
          kSpread * about(even.shares[j], places[p].skin) + (1 - kSpread) * places[p].direct[j];
      const SunAnswer one = answer(places[p], even.directions[j], before,
                                   about(even.shares[opposite], places[p].middle), places[p].clear[j]);
      sun[j] = one.sun;
      through[j] = one.through;
      (even.directions[j].y > 0 ? transfer.sky : transfer.ground) += one.sun;
      all += one.sun;
    }
    transfer.sun = even.fit(sun);
    transfer.through = even.fit(through);
    // Light from everywhere comes out of a cloud as it went in.
    if (all > 0) {
      transfer.sky /= all;
      transfer.ground /= all;
    }
  }
  const float bright = brightAnswer(puffs, transfers);
  return {std::move(transfers), bright};
}

std::vector<SunAnswer> bakeSun(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                               float asymmetry, const glm::vec3& sunDirection) {
  DepthSweep sweep(grid);
  std::vector<PuffTransfer> unused(puffs.size());
  const float reduction = 1.0f - asymmetry;
  const std::vector<Place> places = placesOf(puffs, sweep, grid, reduction, unused);
  const std::vector<float> front = lattice().sharesAbout(sunDirection),
                           back = lattice().sharesAbout(-sunDirection);
  const Depths depths = depthsTowards(sweep, puffs, grid, sunDirection);
  std::vector<SunAnswer> answers;
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    const float direct = transmitted(reduction * depths.skin[p]);
    const float before = kSpread * about(front, places[p].skin) + (1 - kSpread) * direct;
    answers.push_back(answer(places[p], sunDirection, before, about(back, places[p].middle),
                             std::exp(-kClear * depths.skin[p])));
  }
  return answers;
}

}  // namespace cloudgen::light
