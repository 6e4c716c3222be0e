// SPDX-License-Identifier: Apache-2.0
#include "image/march.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "image/heap_noise.hpp"

namespace cloudgen::image {
namespace {

constexpr float kReach2 = 9.0f, kAtReach = 0.011109f;  // exp(-9/2): what is cut, so that no edge is seen
constexpr float kKept = 0.97068f;                      // of the optical depth through the centre after that
constexpr float kOpaque = 0.004f;                      // what shines through less is black
constexpr float kLightAnew = 0.08f;  // the light is looked at again after this share of what was open
constexpr float kMeanLight = 0.94f;
constexpr int kMostSamples = 1500;
constexpr float kStep = 0.6f;   // of a crossing's deviation: sums of Gaussians are exact to 1e-5 at 0.9
constexpr float kSolid = 6.0f;  // overlapping puffs: no noise reaches so deep

/// exp of a number from -87 to 0, to 2e-5 of itself: the polynomial of 2^f on [0, 1) by Chebyshev nodes.
float fastExp(float x) {
  const float y = std::max(x * 1.44269504f, -126.0f);
  const float whole = std::floor(y), f = y - whole;
  const float power = 1.0f + f * (0.69304432f + f * (0.24013642f + f * (0.05200242f + f * 0.01481680f)));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(power) + (static_cast<std::int32_t>(whole) << 23));
}

/// Gaussian that ends at three deviations, with the optical depth of one that does not.
float bell(float squaredDeviations) {
  return squaredDeviations < kReach2 ? std::max(0.0f, fastExp(-0.5f * squaredDeviations) - kAtReach) / kKept
                                     : 0.0f;
}

float step01(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

March::March(std::span<const Blob> blobs, const View& view, const VolumeOptions& options, const Ray& ray,
             const Haze& haze)
    : blobs_(blobs),
      options_(options),
      haze_(haze),
      noise_(heapNoise()),
      eye_(view.eye),
      origin_(ray.origin - view.eye),
      direction_(ray.direction),
      pixelAtOrigin_(static_cast<float>(view.pixelMeters(0))),
      pixelPerMeter_(static_cast<float>(view.pixelMeters(1) - view.pixelMeters(0))) {}

bool March::startsLater(const Crossing& a, const Crossing& b) { return a.start > b.start; }

void March::meet(std::uint32_t index, float after) {
  const Blob& blob = blobs_[index];
  const glm::vec3 along = blob.toUnit * direction_, center = blob.toUnit * (blob.center - origin_);
  const float inverse2 = 1.0f / glm::dot(along, along), middle = glm::dot(along, center) * inverse2;
  const glm::vec3 aside = center - middle * along;
  const float closest2 = glm::dot(aside, aside);
  if (closest2 >= kReach2) return;
  const float deviation = std::sqrt(inverse2), half = deviation * std::sqrt(kReach2 - closest2);
  if (middle + half <= after) return;
  waiting_.push_back({index, middle, deviation, closest2, middle - half, middle + half});
  std::push_heap(waiting_.begin(), waiting_.end(), startsLater);
}

void March::beginNext() {
  std::pop_heap(waiting_.begin(), waiting_.end(), startsLater);
  crossings_.push_back(waiting_.back());
  waiting_.pop_back();
}

void March::addThread(Field& field, const Blob& blob, float extinction, const glm::vec3& point) {
  const float thread = glm::dot(blob.fibre, blob.fibre);
  if (!(thread > 0)) return;
  field.thread += extinction * thread;
  field.alongThread += extinction * glm::dot(point - blob.center, blob.fibre) * blob.fibre;
}

March::Field March::fieldOnRay(float distance) const {
  Field field;
  const glm::vec3 point = origin_ + direction_ * distance;
  for (const Crossing& crossing : crossings_) {
    const float a = (distance - crossing.middle) / crossing.deviation;
    const Blob& blob = blobs_[crossing.blob];
    const float extinction = blob.extinction * bell(crossing.closest2 + a * a);
    if (!(extinction > 0)) continue;
    field.extinction += extinction;
    field.own += extinction * blob.extinction;
    field.scale += extinction * blob.scale;
    field.billow += extinction * blob.billow;
    addThread(field, blob, extinction, point);
    field.deviation += extinction * crossing.deviation;
    field.ice += extinction * blob.ice;
    field.color += extinction * blob.color;
  }
  return field;
}

March::Field March::fieldAt(const glm::vec3& point) const {
  Field field;
  for (const Crossing& crossing : crossings_) {
    const Blob& blob = blobs_[crossing.blob];
    const glm::vec3 away = blob.toUnit * (point - blob.center);
    const float extinction = blob.extinction * bell(glm::dot(away, away));
    if (!(extinction > 0)) continue;
    field.extinction += extinction;
    field.own += extinction * blob.extinction;
    field.scale += extinction * blob.scale;
    field.billow += extinction * blob.billow;
    addThread(field, blob, extinction, point);
  }
  return field;
}

/// Extinction with the noise: heaps lose their skin where the noise is low and are denser within, sheets only
/// vary.
float March::eaten(const Field& field, const glm::vec3& point, float shortest) const {
  const float extinction = field.extinction;
  if (!(extinction > 0)) return 0;
  const float scale = field.scale / extinction, billow = field.billow / extinction;
  const float thread = field.thread / extinction;
  // How many puffs overlap here, as if all were alike: 1 in the middle of a single one. Fibres are seen in
  // many.
  const float overlap = extinction * extinction / (field.own * (1 + 8 * thread));
  if (overlap > kSolid) return extinction;
  const float longest = 5.0f * scale * (1 - 0.75f * thread);
  // Along threads the noise is drawn out.
  constexpr float kDrawnOut = 0.9f;
  const glm::vec3 place = eye_ + point - kDrawnOut * field.alongThread / extinction;
  const float noise = shortest < longest ? noise_.octaves(place, longest, shortest) : 0.5f;
  const float edge = 3.0f * (1 - noise) * (1 - noise);
  const float heap = 1.5f * step01(edge, 1.25f * edge + 0.25f, overlap),
              sheet = glm::mix(0.65f + 0.7f * noise, 2.0f * step01(0.12f, 0.88f, noise), thread);
  const float share = glm::mix(sheet, heap, billow);
  return extinction * glm::mix(share, 1.0f, step01(0.6f * kSolid, kSolid, overlap));
}

/// How much the light of a heap's puffs changes by what lies between a place and the sun within a few puff
/// widths, about 1 in the mean.
float March::lightAt(const glm::vec3& point, float scale, float shortest) const {
  // Puffs of a pixel show no relief: their mean.
  const float seen = step01(0.5f, 1.1f, scale / shortest);
  if (seen <= 0) return kMeanLight;
  constexpr std::array<float, 3> kAt{0.35f, 1.2f, 2.6f}, kLong{0.7f, 1.1f, 1.7f};
  float depth = 0;
  for (size_t i = 0; i < kAt.size(); ++i) {
    const glm::vec3 there = point + options_.sunDirection * (kAt[i] * scale);
    depth += kLong[i] * scale * eaten(fieldAt(there), there, std::max(shortest, 0.3f * scale));
  }
  const float sun = 1.25f * (0.2f + 0.8f * fastExp(-0.42f * depth));
  return glm::mix(kMeanLight, glm::mix(1.0f, sun, options_.sunShare), seen);
}

Gathered March::run(float far, float jitter) {
  Gathered out;
  float distance = 0, weight = 0, step = 0, light = 1, unlit = 1;
  std::uint32_t next = 0;
  int samples = 0;
  while (distance < far && out.open > kOpaque && samples < kMostSamples) {
    const auto meetUntil = [&](float there) {
      while (next < blobs_.size() && blobs_[next].enter <= there) meet(next++, distance);
    };
    meetUntil(distance);
    std::erase_if(crossings_, [&](const Crossing& crossing) { return crossing.end <= distance; });
    while (!waiting_.empty() && waiting_.front().start <= distance) beginNext();
    if (crossings_.empty()) {
      // Nothing here: on to where something begins.
      if (waiting_.empty() && next == blobs_.size()) break;
      distance = std::min(waiting_.empty() ? 1e30f : waiting_.front().start,
                          next < blobs_.size() ? std::max(blobs_[next].enter, distance) : 1e30f);
      step = 0;
      continue;
    }
    ++samples;
    // No longer than fits the narrowest crossing on the way: a thread within a veil must not be stepped over.
    const bool first = step == 0;
    if (first) step = 1e6f;
    for (const Crossing& crossing : crossings_) step = std::min(step, kStep * crossing.deviation);
    meetUntil(distance + step);
    while (!waiting_.empty() && waiting_.front().start < distance + step) {
      step = std::min(step, waiting_.front().start - distance + kStep * waiting_.front().deviation);
      beginNext();
    }
    step = std::max(step * (first ? 0.45f + 0.55f * jitter : 1.0f),
                    0.3f * (pixelAtOrigin_ + pixelPerMeter_ * distance));
    step = std::min(step, std::max(far - distance, 1e-3f));
    const float at = distance + 0.5f * step;
    const Field field = fieldOnRay(at);
    float longest = 1e6f;
    if (field.extinction > 0) {
      const float scale = field.scale / field.extinction, billow = field.billow / field.extinction;
      const float shortest = 1.6f * (pixelAtOrigin_ + pixelPerMeter_ * at);
      const glm::vec3 point = origin_ + direction_ * at;
      const float extinction = options_.detail ? eaten(field, point, shortest) : field.extinction;
      const float absorbed = out.open * -std::expm1(-extinction * step);
      if (absorbed > 1e-5f) {
        unlit += absorbed;
        if (options_.detail && billow > 0.02f && unlit > kLightAnew * out.open) {
          light = lightAt(point, scale, shortest);
          unlit = 0;
        }
        const float clarity = clarityThrough(haze_, direction_.y, at);
        out.radiance +=
            absorbed *
            glm::mix(haze_.color, glm::mix(1.0f, light, billow) * field.color / field.extinction, clarity);
        out.distance += absorbed * at;
        weight += absorbed;
        const float ice = field.ice / field.extinction;
        out.ice += ice * extinction * step;
        out.water += (1 - ice) * extinction * step;
        out.open -= absorbed;
      }
      // The noise of heaps is finer than they are.
      if (options_.detail && billow > 0.1f) longest = 0.32f * field.deviation / field.extinction;
    }
    distance += step;
    step = longest;
  }
  if (out.open <= kOpaque) {
    // What is left unseen is as bright as the rest.
    out.radiance /= 1 - out.open;
    out.open = 0;
  }
  if (weight > 0) out.distance /= weight;
  return out;
}

}  // namespace cloudgen::image
