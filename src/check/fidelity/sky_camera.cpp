// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/sky_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/thread.hpp"
#include "check/fidelity/even_places.hpp"
#include "check/fidelity/ray_field.hpp"

namespace cloudgen::check {
namespace {

constexpr int kCameras = 12, kRays = 400;
constexpr float kLeastAbove = 20;   ///< metres
constexpr float kMostRepeats = 3;   ///< of the box to each side
constexpr double kAround = 20'000;  ///< metres

double zenithReach() { return std::tan(kSkyZenithDegrees * std::numbers::pi / 180); }

/// Rays of equal solid angle, by where they cross a plane 1 m above the camera.
std::vector<glm::vec2> skyRays() {
  const double lowest = std::cos(kSkyZenithDegrees * std::numbers::pi / 180);
  std::vector<glm::vec2> rays;
  for (int i = 0; i < kRays; ++i) {
    const glm::dvec2 place = evenPlace(i);
    const double up = 1 - place.x * (1 - lowest), around = 2 * std::numbers::pi * place.y,
                 flat = std::sqrt(1 - up * up) / up;
    rays.emplace_back(flat * std::cos(around), flat * std::sin(around));
  }
  return rays;
}

glm::vec3 middleOf(const Blob& blob, std::span<const Pivot> pivots) {
  return blob.kind == BlobKind::Turning ? pivots[blob.pivot].place : blob.center;
}

/// Standard deviation that it has in no direction more than.
float widthOf(const Blob& blob, std::span<const Pivot> pivots) {
  if (blob.kind == BlobKind::Volume) return std::sqrt(blob.shape[0] + blob.shape[3] + blob.shape[5]);
  const float half = glm::length(blob.right()) + glm::length(blob.up());
  return blob.kind == BlobKind::Turning ? pivots[blob.pivot].scale * (half + glm::length(blob.center)) : half;
}

/// The sky over a place of the scene.
double skyCoverAt(const WrittenScene& scene, const glm::vec3& camera, const glm::vec2& side) {
  RayField sky(skyRays());
  const auto reach = static_cast<float>(zenithReach());
  for (const Blob& blob : scene.blobs) {
    const glm::vec3 middle = middleOf(blob, scene.pivots);
    const float above = middle.y - camera.y;
    if (!(above > kLeastAbove)) continue;
    const float farthest = reach * above + 4 * widthOf(blob, scene.pivots);
    const glm::vec2 off = glm::vec2(middle.x, middle.z) - glm::vec2(camera.x, camera.z);
    const auto within = [](const glm::vec2& repeats) {
      return glm::ivec2(glm::clamp(repeats, -kMostRepeats, kMostRepeats));
    };
    const glm::ivec2 first = within(glm::ceil((-farthest - off) / side)),
                     last = within(glm::floor((farthest - off) / side));
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) {
        const glm::vec2 away = off + glm::vec2(column, row) * side;
        const View view = viewAlong(-glm::normalize(glm::vec3(away.x, above, away.y)), camera.y);
        if (const Footprint seen = footprintOf(blob, scene.pivots, view); isSeen(seen))
          sky.add(seen, away / above, above);
      }
  }
  return sky.cover();
}

/// Of the columns whose middle is near, else of the nearest one.
double modelCoverAround(const glm::dvec3& camera, std::span<const ModelColumn> columns,
                        std::span<const glm::dvec2> middles) {
  double area = 0, covered = 0, nearest = 1e30, nearestCover = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double distance = glm::distance(middles[i], glm::dvec2(camera.x, camera.z));
    if (distance < nearest) nearest = distance, nearestCover = columns[i].view.cover;
    if (distance > kAround) continue;
    area += columns[i].squareMeters;
    covered += columns[i].squareMeters * columns[i].view.cover;
  }
  return area > 0 ? covered / area : nearestCover;
}

}  // namespace

int octasOf(double cover) {
  if (!(cover > 0)) return 0;
  if (cover >= 1) return 8;
  return std::clamp(static_cast<int>(std::lround(8 * cover)), 1, 7);
}

std::vector<SkyReport> lookUp(const WrittenScene& scene, const base::LocalFrame& frame,
                              std::span<const ModelColumn> columns, const base::Progress& progress) {
  progress.step("verify: sky cameras", 0);
  const base::GeoBox& box = frame.box();
  const glm::vec2 side(glm::max(frame.upperCorner() - frame.lowerCorner(), glm::dvec2(1)));
  std::vector<glm::dvec2> middles;
  for (const ModelColumn& column : columns) {
    const glm::dvec3 middle = frame.toScene(column.longitudeDegrees, column.latitudeDegrees, 0);
    middles.emplace_back(middle.x, middle.z);
  }
  std::vector<SkyReport> reports(kCameras);
  std::vector<glm::vec3> cameras;
  for (int i = 0; i < kCameras; ++i) {
    const glm::dvec2 place = evenPlace(i);
    SkyReport& report = reports[static_cast<std::size_t>(i)];
    report.longitudeDegrees = base::wrappedLongitude(box.west + place.x * box.width());
    report.latitudeDegrees = box.south + place.y * box.height();
    const glm::dvec3 camera =
        frame.toScene(report.longitudeDegrees, report.latitudeDegrees, scene.groundMeters);
    report.modelCover = modelCoverAround(camera, columns, middles);
    cameras.emplace_back(camera);
  }
  base::parallelFor(reports.size(),
                    [&](std::size_t i) { reports[i].skyCover = skyCoverAt(scene, cameras[i], side); });
  progress.step("verify: sky cameras", 1);
  return reports;
}

}  // namespace cloudgen::check
