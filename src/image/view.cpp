// SPDX-License-Identifier: Apache-2.0
#include "image/view.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace cloudgen::image {
namespace {

/// Right, up, back; looking straight up or down, north is up.
glm::dmat3 axesWithBack(const glm::dvec3& back) {
  const glm::dvec3 upward = std::abs(back.y) > 0.9999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(upward, back));
  return {right, glm::cross(back, right), back};
}

}  // namespace

Ray View::rayAt(double x, double y) const {
  const double right = (x - 0.5 * width) / focal, up = (0.5 * height - y) / focal;
  if (parallel) return {eye + axes[0] * right + axes[1] * up, -axes[2]};
  return {eye, glm::normalize(axes * glm::dvec3(right, up, -1.0))};
}

View viewOf(const Camera& camera) {
  return {.eye = camera.eye,
          .axes = axesWithBack(glm::normalize(camera.eye - camera.target)),
          .focal = 0.5 * camera.height / std::tan(0.5 * glm::radians(camera.verticalFieldDegrees)),
          .width = camera.width,
          .height = camera.height};
}

View parallelView(const glm::dvec3& center, const glm::dvec3& back, double halfMeters, double distance,
                  int pixels) {
  return {.eye = center + back * distance,
          .axes = axesWithBack(back),
          .focal = 0.5 * pixels / halfMeters,
          .parallel = true,
          .width = pixels,
          .height = pixels};
}

}  // namespace cloudgen::image
