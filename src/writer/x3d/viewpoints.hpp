// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>

#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// A place to look from. The rotation is axis and angle, from looking along -Z.
struct View {
  std::string name, description;
  glm::vec3 eye{0}, target{0};
  glm::vec4 rotation{0, 1, 0, 0};
};

/// Overview (oblique, on the densest clouds), ground (at eye height, looking up to them), top, and the whole
/// scene.
std::vector<View> viewsOf(const scene::Scene& scene, const Stage& stage);

/// Axis and angle (radians) that turn a viewer who looks along -Z with +Y up towards a target, the head kept
/// upright; straight down, north is up.
glm::vec4 rotationTowards(const glm::vec3& eye, const glm::vec3& target);

}  // namespace cloudgen::writer
