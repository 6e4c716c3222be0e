// SPDX-License-Identifier: Apache-2.0
#include "light/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "light/layer.hpp"
#include "light/octaves.hpp"
#include "light/sweep.hpp"
#include "light/undersides.hpp"

namespace cloudgen::light {
namespace {

constexpr int kRings = 3;

/// What is seen of a puff is its skin: its own body, out to a little over a deviation, does not shade it, nor
/// do the first 0.6 of optical depth, through which one sees.
constexpr float kSkin = 1.2f, kSeenDepth = 0.6f;
/// Diffuse light takes a longer way through a slab than the straight one; with the means below over half of
/// the sphere, these factors of the depths bring a slab back to the two-stream solution: for what comes to
/// the skin, mostly from about the sun, and for what goes on behind it to all sides.
constexpr float kDiffusivity = 0.80f, kDiffusivityBehind = 0.6f;
/// How much of what comes to a skin has lost its direction. All of these are set by the path tracer of the
/// tests: spheres, slabs and heaps.
constexpr float kSpread = 0.93f;
/// Thinning of the depths for what goes on nearly straight (most of a forward peak), by which a puff also
/// knows where outside is.
constexpr float kClear = 0.5f;
/// Drops are large: nearly all of the sunlight that meets rain goes on through it, little to the sides.
constexpr float kSunOfRain = 0.3f;
/// PuffTransfer::upward of what begins to be a level top.
constexpr float kLevelFrom = 0.75f;

/// What light goes through to a cloud's puffs: the cloud, and, for a piece of a layer, what lies about it.
class Medium {
 public:
  Medium(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid)
      : sweep_(grid), layer_(grid), share_(layerShare(puffs, grid)), cell_(grid.cellMeters()) {}

  float cellMeters() const { return cell_; }
  /// As layerShare().
  float layer() const { return share_; }
  void sweepTowards(const glm::vec3& direction) {
    sweep_.towards(direction);
    rise_ = direction.y;
  }
  /// Optical depth from a point to the outside along the direction of the last sweep.
  float depthFrom(const glm::vec3& point) const {
    const float alone = sweep_.at(point);
    return share_ > 0 ? glm::mix(alone, layer_.depthFrom(point.y, rise_), share_) : alone;
  }

 private:
  DepthSweep sweep_;
  Layer layer_;
  float share_, cell_, rise_ = 1;
};

/// Standard deviation along a ray through the middle of a puff, as wide as the cells hold it: that of a flat one is
/// short on slanting rays, too, which leave it for its neighbours.
float reachAlong(const shape::Puff& puff, const glm::vec3& direction, float cellMeters) {
  const glm::vec3 held = glm::max(puff.sigma, glm::vec3(0.42f * cellMeters));
  return 1 / glm::length((glm::conjugate(puff.rotation) * direction) / held);
}

PuffDepths depthsTowards(Medium& medium, std::span<const shape::Puff> puffs, const glm::vec3& direction) {
  medium.sweepTowards(direction);
  PuffDepths depths;
  for (const shape::Puff& puff : puffs) {
    const float reach = kSkin * reachAlong(puff, direction, medium.cellMeters());
    depths.skin.push_back(medium.depthFrom(puff.center + reach * direction));
    depths.middle.push_back(medium.depthFrom(puff.center));
  }
  return depths;
}

/// Of the depth from a skin, what hides it.
float hiding(float skinDepth) { return std::max(0.0f, skinDepth - kSeenDepth); }

/// ((1 + cos) / 2)^3: like the cosine of a matt surface, its mean over the sphere is a quarter, so that under
/// an even light from everywhere nothing is lost; it turns around the edge as light in a cloud does, and
/// three degrees of harmonics hold it.
float facing(float cosine) {
  const float half = 0.5f + 0.5f * cosine;
  return half * half * half;
}

/// The lattice of directions, and the share that each has in the diffuse light about each and to its side.
struct Lattice {
  std::vector<glm::vec3> directions = opposedDirections(kRings);
  HarmonicFit fit{directions};
  std::vector<std::vector<float>> lobes, sides;

  Lattice() {
    for (const glm::vec3& direction : directions) {
      lobes.push_back(lobeAbout(direction));
      sides.push_back(sideTowards(direction));
    }
  }
  /// Weights of sum 1 by the square of the cosine, over half of the sphere.
  std::vector<float> lobeAbout(const glm::vec3& direction) const {
    return shares([&](const glm::vec3& other) {
      const float cosine = std::max(0.0f, glm::dot(direction, other));
      return cosine * cosine;
    });
  }
  /// Even weights of sum 1 over half of the sphere, without a hard border that would show in the harmonics.
  std::vector<float> sideTowards(const glm::vec3& direction) const {
    return shares(
        [&](const glm::vec3& other) { return glm::smoothstep(-0.35f, 0.4f, glm::dot(direction, other)); });
  }

 private:
  template <class Weight>
  std::vector<float> shares(Weight&& weight) const {
    std::vector<float> out;
    float sum = 0;
    for (const glm::vec3& other : directions) {
      out.push_back(weight(other));
      sum += out.back();
    }
    for (float& share : out) share /= sum;
    return out;
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

  /// What of the depth to the middle is left at the skin, where its normal leaves the cloud: ways aslant to
  /// it are in the skin for longer than those along it.
  float skinDepth(const glm::vec3& direction, float alongDirection, float toMiddle) const {
    constexpr float kMostAslant = 0.25f;
    const float cosine = glm::dot(normal, direction);
    const float outwards = glm::dot(normal, normal) * glm::smoothstep(-0.1f, 0.3f, cosine);
    const float aslant = 1 + outwards * (1 / std::clamp(cosine, kMostAslant, 1.0f) - 1);
    return std::max(0.0f, toMiddle - aslant * (toMiddle - alongDirection));
  }
};

/// Where the outside lies for what is seen of a puff. A heap's top faces the sun with one side and not with the other;
/// a layer as a whole is level, and of it whatever looks up a little is a level top.
float upwardOf(float upward, float layer) {
  const float from = glm::mix(kLevelFrom, -0.1f, layer), to = glm::mix(1.0f, 0.4f, layer);
  const float share = std::clamp((upward - from) / (to - from), 0.0f, 1.0f);
  return share > 0 ? std::max(upward, glm::mix(kLevelFrom, 1.0f, share)) : upward;
}

std::vector<Place> placesOf(std::span<const shape::Puff> puffs, const CloudDepths& depths, float denser,
                            float reduction, std::vector<PuffTransfer>& transfers) {
  const auto& directions = lattice().directions;
  const auto hidingAt = [&](std::size_t j, std::size_t p) { return hiding(denser * depths.towards[j].skin[p]); };
  std::vector<Place> places(puffs.size());
  std::vector<float> open(puffs.size());
  for (std::size_t j = 0; j < directions.size(); ++j)
    for (std::size_t p = 0; p < puffs.size(); ++p) {
      const float clear = std::exp(-kClear * hidingAt(j, p));
      places[p].clear.push_back(clear);
      places[p].normal += clear * directions[j];
      open[p] += clear;
      transfers[p].visibility += std::exp(-hidingAt(j, p)) / static_cast<float>(directions.size());
    }
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    glm::vec3& normal = places[p].normal;
    normal *= 2.0f / (open[p] + 1e-12f);
    if (glm::dot(normal, normal) > 1) normal = glm::normalize(normal);
    transfers[p].upward = upwardOf(normal.y, std::max(depths.layer, layerShare(puffs[p])));
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const float middle = denser * depths.towards[j].middle[p];
      const float skin = places[p].skinDepth(directions[j], hidingAt(j, p), middle);
      places[p].direct.push_back(transmitted(reduction * skin));
      places[p].skin.push_back(transmitted(kDiffusivity * reduction * skin));
      places[p].middle.push_back(transmitted(kDiffusivityBehind * reduction * middle));
    }
  }
  return places;
}

/// Mean over a lobe.
float about(const std::vector<float>& shares, const std::vector<float>& values) {
  float sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += shares[i] * values[i];
  return sum;
}

/// What is let through towards a puff and on from it, by all orders, along the light of one sun.
struct Beam {
  float before = 1, behind = 1;
  /// Depths in a row add up: 2 / transmitted = 2 + tau'.
  float through() const { return 1.0f / (1.0f / before + 1.0f / behind - 1.0f); }
};

/// How a cloud as a whole holds the light that comes along one direction, mean of its puffs by their extinction: they
/// light each other, so that the wisps of a thick cloud and the thin end of an anvil are as white as it is.
class Thickness {
 public:
  explicit Thickness(float reduction) : reduction_(reduction) {}

  void add(const Beam& beam, float weight) {
    const float reduced = 2.0f / beam.through() - 2.0f;
    opacity_ += weight * -std::expm1(-reduced / reduction_);
    diffused_ += weight * -std::expm1(-reduced * (1.1f + 2 * reduced));
    weight_ += weight;
  }
  /// Share of the beam that is scattered at all.
  float opacity() const { return (opacity_ + 1e-9f) / (weight_ + 1e-9f); }
  /// Share that loses its direction: of little in thin clouds, as most of what they scatter goes on forward.
  float diffused() const { return diffused_ / (weight_ + 1e-9f); }

 private:
  float reduction_, opacity_ = 0, diffused_ = 0, weight_ = 0;
};

/// The beams of every direction of the lattice, one a puff.
std::vector<std::vector<Beam>> beamsThrough(const std::vector<Place>& places) {
  const Lattice& even = lattice();
  const std::size_t count = even.directions.size();
  std::vector<std::vector<Beam>> beams(count);
  for (std::size_t j = 0; j < count; ++j)
    for (const Place& place : places)
      beams[j].push_back({kSpread * about(even.lobes[j], place.skin) + (1 - kSpread) * place.direct[j],
                          about(even.sides[(j + count / 2) % count], place.middle)});
  return beams;
}

/// Along the shortest way through the cloud.
Thickness thinnest(std::span<const shape::Puff> puffs, const std::vector<std::vector<Beam>>& beams, float reduction) {
  std::vector<Thickness> along;
  for (const auto& ofDirection : beams) {
    along.emplace_back(reduction);
    for (std::size_t p = 0; p < puffs.size(); ++p)
      if (!puffs[p].rain)
        along.back().add(ofDirection[p], static_cast<float>(shape::extinctionArea(puffs[p])));
  }
  return *std::min_element(along.begin(), along.end(),
                           [](const auto& a, const auto& b) { return a.diffused() < b.diffused(); });
}

/// A skin that faces the sun shows what comes back, one that faces away what comes through; relative to what
/// a viewer sees of the cloud, its opacity.
SunAnswer answer(const Place& place, const glm::vec3& direction, const Beam& beam, float clear,
                 const Thickness& cloud) {
  const float strength = glm::length(place.normal);
  const glm::vec3 normal = place.normal / (strength + 1e-12f);
  const float cosine = glm::dot(normal, direction);
  const float towards = 0.25f + strength * (facing(cosine) - 0.25f),
              away = 0.25f + strength * (facing(-cosine) - 0.25f);
  return {
      (towards * (beam.before - beam.through()) + away * beam.before * cloud.diffused()) / cloud.opacity(),
      clear,
      {}};
}

/// What has not lost its direction was scattered once, or nearly.
ScatteredOnce onceOf(const Thickness& cloud, float asymmetry) {
  const ScatteredOnce thin = scatteredOnce(asymmetry);
  return {glm::mix(thin.even, 1.0f, cloud.diffused()), glm::mix(thin.towards, 0.0f, cloud.diffused())};
}

/// 1 for a cloud that has a top and an underside to tell apart, 0 for one so thin that light goes on through it.
float facesOf(const ScatteredOnce& once) {
  constexpr float kHasFaces = 0.4f;  ///< of the light that is not sent on: sheets of an optical depth of 5 have it
  return std::clamp((1 - once.towards) / kHasFaces, 0.0f, 1.0f);
}

float lookingDown(const PuffTransfer& transfer) { return glm::smoothstep(0.0f, 0.7f, -transfer.upward); }

/// The answer that an eleventh of the seen area exceeds, under the best of 12 suns. Undersides, which may let more
/// through than tops send back, are exposed by themselves.
float brightAnswer(std::span<const shape::Puff> puffs, std::span<const PuffTransfer> transfers,
                   const ScatteredOnce& once) {
  float brightest = 1e-3f;
  std::vector<std::pair<float, float>> answers(puffs.size());
  for (const glm::vec3& direction : opposedDirections(2)) {
    if (direction.y < 0) break;
    const Harmonics harmonics = harmonicsOf(direction);
    double left = 0;
    for (std::size_t i = 0; i < puffs.size(); ++i) {
      answers[i] = {dot(transfers[i].sun, harmonics),
                    (1 - facesOf(once) * lookingDown(transfers[i])) * seenArea(puffs[i], transfers[i])};
      left += 0.09 * answers[i].second;
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

float levelOf(const CloudTransfer& cloud, const PuffTransfer& transfer) {
  return facesOf(cloud.once) * glm::smoothstep(kLevelFrom, 1.0f, transfer.upward);
}

float undersideOf(const CloudTransfer& cloud, const PuffTransfer& transfer) {
  return std::max(0.0f, 1 - cloud.once.towards) * lookingDown(transfer);
}

float seenArea(const shape::Puff& puff, const PuffTransfer& transfer) {
  return puff.rain ? 0 : shownArea(puff, transfer);
}

float shownArea(const shape::Puff& puff, const PuffTransfer& transfer) {
  return puff.sigma.x * puff.sigma.z * -std::expm1(-shape::frontalOpticalDepth(puff)) * transfer.visibility;
}

CloudDepths depthsIn(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid) {
  Medium medium(puffs, grid);
  CloudDepths depths;
  depths.layer = medium.layer();
  for (const glm::vec3& direction : lattice().directions)
    depths.towards.push_back(depthsTowards(medium, puffs, direction));
  return depths;
}

CloudTransfer bakeTransfer(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid, float asymmetry) {
  return bakeTransfer(puffs, depthsIn(puffs, grid), asymmetry);
}

CloudTransfer bakeTransfer(std::span<const shape::Puff> puffs, const CloudDepths& depths, float asymmetry,
                           float denser) {
  const Lattice& even = lattice();
  const std::size_t count = even.directions.size();
  std::vector<PuffTransfer> transfers(puffs.size());
  const std::vector<Place> places = placesOf(puffs, depths, denser, 1.0f - asymmetry, transfers);
  const std::vector<std::vector<Beam>> beams = beamsThrough(places);
  const Thickness cloud = thinnest(puffs, beams, 1.0f - asymmetry);
  std::vector<float> sun(count), through(count);
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    PuffTransfer& transfer = transfers[p];
    float all = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const SunAnswer one = answer(places[p], even.directions[j], beams[j][p], places[p].clear[j], cloud);
      sun[j] = one.sun;
      through[j] = one.through;
      (even.directions[j].y > 0 ? transfer.sky : transfer.ground) += one.sun;
      all += one.sun;
    }
    if (puffs[p].rain)
      for (float& one : sun) one *= kSunOfRain;
    transfer.sun = even.fit(sun);
    transfer.through = even.fit(through);
    // Light from everywhere comes out of a cloud as it went in.
    if (all > 0) {
      transfer.sky /= all;
      transfer.ground /= all;
    }
  }
  const Undersides undersides(puffs, transfers);
  for (std::size_t k = 0; k < kHarmonics; ++k)
    undersides.even(transfers, [k](PuffTransfer& transfer) -> float& { return transfer.sun[k]; });
  undersides.even(transfers, [](PuffTransfer& transfer) -> float& { return transfer.sky; });
  undersides.even(transfers, [](PuffTransfer& transfer) -> float& { return transfer.ground; });
  const ScatteredOnce once = onceOf(cloud, asymmetry);
  const float bright = brightAnswer(puffs, transfers, once);
  return {std::move(transfers), bright, once};
}

std::vector<SunAnswer> bakeSun(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                               float asymmetry, const glm::vec3& sunDirection) {
  std::vector<PuffTransfer> transfers(puffs.size());
  const float reduction = 1.0f - asymmetry;
  const std::vector<Place> places = placesOf(puffs, depthsIn(puffs, grid), 1, reduction, transfers);
  const std::vector<float> front = lattice().lobeAbout(sunDirection),
                           back = lattice().sideTowards(-sunDirection);
  Medium medium(puffs, grid);
  const PuffDepths depths = depthsTowards(medium, puffs, sunDirection);
  const Thickness cloud = thinnest(puffs, beamsThrough(places), reduction);
  std::vector<SunAnswer> answers;
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    const float skin = hiding(depths.skin[p]);
    const float direct = transmitted(reduction * places[p].skinDepth(sunDirection, skin, depths.middle[p]));
    const Beam beam{kSpread * about(front, places[p].skin) + (1 - kSpread) * direct,
                    about(back, places[p].middle)};
    answers.push_back(answer(places[p], sunDirection, beam, std::exp(-kClear * skin), cloud));
    if (puffs[p].rain) answers.back().sun *= kSunOfRain;
    answers.back().once = onceOf(cloud, asymmetry);
  }
  Undersides(puffs, transfers).even(answers, [](SunAnswer& one) -> float& { return one.sun; });
  return answers;
}

}  // namespace cloudgen::light
