// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace cloudgen::check {

/// Hands over where the vertices and splats of a GLB stand, in the axes of glTF (y up): those of its default
/// scene, through the transforms of its nodes and their instances. Throws InputError, naming `where`, if it
/// is something else.
void visitContentPoints(std::string_view bytes, const std::string& where,
                        const std::function<void(const glm::dvec3&)>& visit);

}  // namespace cloudgen::check
