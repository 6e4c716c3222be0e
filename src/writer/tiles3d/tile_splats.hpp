// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "writer/gltf/glb_file.hpp"
#include "writer/gltf/splat.hpp"
#include "writer/tiles3d/placed_puff.hpp"
#include "writer/tiles3d/placement.hpp"

namespace cloudgen::writer::tiles3d {

inline constexpr const char* kPackedExtension = "KHR_gaussian_splatting_compression_spz_2";

/// The puffs as splats on a plane, in Morton order of their places; `sun` shines as seen from the plane.
std::vector<gltf::Splat> splatsOn(const TilePlane& plane, const Placement& placement,
                                  std::span<const PlacedPuff> puffs, const light::Sun& sun);

/// Adds a node of splats packed as SPZ. Where some are denser than a byte of opacity tells, the node's extras
/// have "opticalDepths": a buffer view with a byte b each, exp(offset + scale b / 255) along the shortest axis.
/// They stand there because of a property table CesiumJS would make a texture.
void addPackedSplats(gltf::GlbFile& file, const std::string& name, std::span<const gltf::Splat> splats,
                     glm::vec3 sunDirection, int degree);

/// Adds a node of splats as plain columns; they must outlive the file.
void addPlainSplats(gltf::GlbFile& file, const std::string& name, std::span<const gltf::Splat> splats,
                    glm::vec3 sunDirection, int degree);

}  // namespace cloudgen::writer::tiles3d
