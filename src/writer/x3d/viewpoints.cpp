// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/viewpoints.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace cloudgen::writer {
namespace {

constexpr float kEyeHeightMeters = 1.7f;

/// Unit vector from the clouds to a viewer who stands 50 degrees beside the sun and sees them at an
/// elevation: lit and shaded sides.
glm::vec3 towardsViewer(const light::Sun& sun, double elevationDegrees) {
  const double azimuth = (sun.azimuthDegrees + 50) * std::numbers::pi / 180;
  const double elevation = elevationDegrees * std::numbers::pi / 180;
  return glm::vec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                   -std::cos(azimuth) * std::cos(elevation));
}

}  // namespace

glm::vec4 rotationTowards(const glm::vec3& eye, const glm::vec3& target) {
  const glm::vec3 d = glm::normalize(target - eye);
  const float across = std::hypot(d.x, d.z);
  const float yaw = across > 1e-6f ? std::atan2(-d.x, -d.z) : 0.0f, pitch = std::atan2(d.y, across);
  const glm::quat turn = glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
  const float sine = glm::length(glm::vec3(turn.x, turn.y, turn.z));
  if (sine < 1e-6f) return {0, 1, 0, 0};
  return glm::vec4(glm::vec3(turn.x, turn.y, turn.z) / sine, 2 * std::atan2(sine, turn.w));
}

std::vector<View> viewsOf(const scene::Scene& scene, const Stage& stage) {
  const float depth = std::max(stage.focusTop - stage.focusBase, 200.0f);
  const float heightAbove =
      std::max(stage.focusBase - scene::groundAt(scene, stage.focus.x, stage.focus.z), 0.0f);
  // Near enough that a cloud of mean width is some hundred pixels wide, far enough to have a dozen in view.
  const float reach =
      std::clamp(6 * stage.cloudWidth, 3 * depth, std::max(1.2f * stage.extent, 3.1f * depth));
  const glm::vec3 middle = 0.5f * (stage.lower + stage.upper);

  std::vector<View> views;
  views.push_back(
      {"View_Overview", "Overview", stage.focus + reach * towardsViewer(scene.sun, 24), stage.focus});
  const float away = std::max(2.2f * (heightAbove + 0.5f * depth), 1.5f * stage.cloudWidth);
  glm::vec3 ground = stage.focus + away * towardsViewer(scene.sun, 0);
  ground.y = scene::groundAt(scene, ground.x, ground.z) + kEyeHeightMeters;
  views.push_back({"View_Ground", "From the ground", ground, stage.focus});
  views.push_back({"View_Top", "From above", stage.focus + glm::vec3(0, reach, 0), stage.focus});
  views.push_back({"View_Whole", "Whole scene",
                   glm::vec3(middle.x, 0, middle.z) + 1.25f * stage.extent * towardsViewer(scene.sun, 40),
                   glm::vec3(middle.x, stage.focus.y, middle.z)});
  for (View& view : views) {
    view.eye.y = std::max(view.eye.y, scene::groundAt(scene, view.eye.x, view.eye.z) + kEyeHeightMeters);
    view.rotation = rotationTowards(view.eye, view.target);
  }
  return views;
}

}  // namespace cloudgen::writer
