// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace cloudgen::check {
namespace {

constexpr float kMostDeviations = 4;       // 0.03 % of a Gaussian lies beyond
constexpr float kFewestDeviations = 3.2f;  // 0.6 %: many faint blobs together are not faint
constexpr float kFaintest = 1e-3f;         // optical depth that is followed outwards
/// Share of its area that a card must show.
constexpr float kEdgeOn = 0.05f;

float reachOf(float opticalDepth) {
  const float ratio = std::max(1.0f, opticalDepth / kFaintest);
  return std::clamp(std::sqrt(2 * std::log(ratio)), kFewestDeviations, kMostDeviations);
}

/// Metres that a ray moves sideways for a metre up.
glm::vec2 leanOf(const View& view) { return glm::vec2(view.toViewer.x, view.toViewer.z) / view.toViewer.y; }

glm::vec2 castVector(const glm::vec3& vector, const View& view) {
  return glm::vec2(vector.x, vector.z) - vector.y * leanOf(view);
}

glm::vec2 castPoint(const glm::vec3& point, const View& view) {
  return glm::vec2(point.x, point.z) - (point.y - static_cast<float>(view.levelMeters)) * leanOf(view);
}

Footprint footprintOfVolume(const Blob& blob, const View& view) {
  const auto& s = blob.shape;
  const glm::dmat3 covariance(s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]);
  // What a place on the level is made of: x and z less the lean times y.
  const glm::dvec2 lean(leanOf(view));
  const glm::dvec3 alongX(1, -lean.x, 0), alongZ(0, -lean.y, 1), upwards(0, 1, 0);
  const auto between = [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, covariance * b); };
  const double xx = between(alongX, alongX), xz = between(alongX, alongZ), zz = between(alongZ, alongZ);
  const double determinant = std::max(xx * zz - xz * xz, 1e-12);
  // The Cholesky factor of the covariance on the level, turned round.
  const double a = std::sqrt(std::max(xx, 1e-6)), b = xz / a, c = std::sqrt(determinant) / a;
  Footprint out;
  out.place = castPoint(blob.center, view);
  out.toDeviations =
      glm::mat2(static_cast<float>(1 / a), static_cast<float>(-b / (a * c)), 0.0f, static_cast<float>(1 / c));
  out.opticalDepth = static_cast<float>(blob.strength / (2 * std::numbers::pi * std::sqrt(determinant) *
                                                         std::abs(static_cast<double>(view.toViewer.y))));
  out.reach = reachOf(out.opticalDepth);
  out.height = blob.center.y;
  const double yx = between(upwards, alongX), yz = between(upwards, alongZ);
  const double slopeX = (zz * yx - xz * yz) / determinant, slopeZ = (xx * yz - xz * yx) / determinant;
  out.heightSlope = {static_cast<float>(slopeX), static_cast<float>(slopeZ)};
  out.heightDeviation =
      static_cast<float>(std::sqrt(std::max(0.0, between(upwards, upwards) - slopeX * yx - slopeZ * yz)));
  return out;
}

/// A card with its axes as they lie in the scene.
Footprint footprintOfCard(const Blob& blob, const glm::vec3& center, const glm::vec3& right,
                          const glm::vec3& up, const View& view) {
  Footprint out;
  out.place = castPoint(center, view);
  out.reach = kCardReach;
  out.card = true;
  out.height = center.y;
  const glm::vec3 normal = glm::cross(right, up);
  const float shown = glm::dot(normal, view.toViewer);
  if (!(std::abs(shown) > kEdgeOn * glm::length(normal)) || !(shown > 0 ? blob.front : blob.back)) return out;
  const glm::mat2 axes(castVector(right, view), castVector(up, view));
  out.narrowing = blob.narrowing;
  out.opticalDepth =
      blob.narrowing < 1 ? blob.strength * kWithinCard / (blob.narrowing * blob.narrowing) : blob.strength;
  out.toDeviations = glm::inverse(axes);
  out.heightSlope = glm::vec2(right.y, up.y) * out.toDeviations;
  return out;
}

Footprint footprintOfTurning(const Blob& blob, const Pivot& pivot, const View& view) {
  const auto turned = [&](const glm::vec3& own) {
    return pivot.scale * (own.x * view.right + own.y * view.up + own.z * view.toViewer);
  };
  Footprint out =
      footprintOfCard(blob, pivot.place + turned(blob.center), turned(blob.right()), turned(blob.up()), view);
  out.height = pivot.place.y + pivot.scale * blob.center.y;
  out.heightSlope = glm::vec2(0);
  out.heightDeviation = blob.narrowing * pivot.scale * std::hypot(blob.right().y, blob.up().y);
  return out;
}

}  // namespace

View viewFrom(double zenithDegrees, double azimuthDegrees, double levelMeters) {
  const double zenith = zenithDegrees * std::numbers::pi / 180,
               azimuth = azimuthDegrees * std::numbers::pi / 180;
  return viewAlong(glm::vec3(glm::dvec3(std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                                        -std::sin(zenith) * std::cos(azimuth))),
                   levelMeters);
}

View viewAlong(const glm::vec3& toViewer, double levelMeters) {
  View view;
  const float flat = std::hypot(toViewer.x, toViewer.z);
  view.toViewer = toViewer;
  // Straight above or below there is no up but north.
  if (flat > 1e-6f) view.right = glm::vec3(toViewer.z, 0, -toViewer.x) / flat;
  view.up = glm::cross(view.toViewer, view.right);
  view.levelMeters = levelMeters;
  return view;
}

glm::vec2 Footprint::halfSides() const {
  const glm::mat2 axes = glm::inverse(toDeviations);
  return reach * glm::sqrt(axes[0] * axes[0] + axes[1] * axes[1]);
}

Footprint footprintOf(const Blob& blob, std::span<const Pivot> pivots, const View& view) {
  Footprint out = blob.kind == BlobKind::Volume ? footprintOfVolume(blob, view)
                  : blob.kind == BlobKind::Card
                      ? footprintOfCard(blob, blob.center, blob.right(), blob.up(), view)
                      : footprintOfTurning(blob, pivots[blob.pivot], view);
  out.opacity = blob.opacity;
  return out;
}

bool isSeen(const Footprint& footprint) {
  const glm::mat2& m = footprint.toDeviations;
  const float all = footprint.place.x + footprint.place.y + m[0][0] + m[0][1] + m[1][0] + m[1][1] +
                    footprint.opticalDepth + footprint.height + footprint.heightSlope.x +
                    footprint.heightSlope.y + footprint.heightDeviation;
  if (!std::isfinite(all) || !(footprint.opticalDepth > 0) || !(footprint.reach > 0)) return false;
  const glm::vec2 half = footprint.halfSides();
  return std::isfinite(half.x) && std::isfinite(half.y);
}

std::vector<Footprint> footprintsOf(std::span<const Blob> blobs, std::span<const Pivot> pivots,
                                    const View& view) {
  std::vector<Footprint> footprints;
  footprints.reserve(blobs.size());
  for (const Blob& blob : blobs)
    if (const Footprint footprint = footprintOf(blob, pivots, view); isSeen(footprint))
      footprints.push_back(footprint);
  return footprints;
}

}  // namespace cloudgen::check
