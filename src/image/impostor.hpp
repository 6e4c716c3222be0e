// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "image/picture.hpp"
#include "light/puff_light.hpp"
#include "light/sky.hpp"
#include "shape/puff.hpp"

namespace cloudgen::image {

struct ImpostorOptions {
  int viewsAcross = 8;  ///< views x views directions of the upper hemisphere
  int tilePixels = 64;  ///< side of a view
  bool detail = true;   ///< as RenderOptions::detail
};

/// Pictures of a cloud from viewsAcross^2 directions, tile (i, j) column i, row j from the top, each with
/// parallel rays over a square of twice the radius about the centre, up being up. At 20 pixels or more on the
/// screen a viewer blends the three nearest; below, one does.
struct ImpostorAtlas {
  int viewsAcross = 0, tilePixels = 0;
  glm::vec3 center{0};
  float radiusMeters = 0;  ///< of the sphere that holds every puff out to where it is cut
  /// RGBA of viewsAcross x tilePixels squared: display-encoded, straight alpha. A pixel's breadth of every
  /// tile's border has alpha zero, and colour is defined under zero alpha.
  ByteImage color;
  /// Where the cloud is seen to lie, row by row as `color`: 0 nearest to the eye on the sphere, 65535
  /// farthest; 65535 where nothing is.
  std::vector<std::uint16_t> depth;
};

/// The depths as a PNG of one channel of 16 bits.
std::string depthPng(const ImpostorAtlas& atlas);

/// The direction from a cloud towards the eye of a view, by the hemi-octahedral map (Cigolle et al. 2014, "A
/// survey of efficient representations for independent unit vectors"; y up): u, v in -1..1 to a unit vector
/// with y >= 0.
glm::dvec3 hemiOctahedron(const glm::dvec2& uv);
/// Its inverse; directions from below the horizon are taken as at it.
glm::dvec2 onHemiOctahedron(const glm::dvec3& direction);

/// Direction of the view in tile (column, row): the first and last lie on the horizon.
glm::dvec3 impostorDirection(int column, int row, int viewsAcross);

/// Draws the views with the volume renderer. `lights` has one entry a puff. Empty atlas (radius 0) for no
/// puffs. The same bytes for any number of threads.
ImpostorAtlas bakeImpostor(std::span<const shape::Puff> puffs, std::span<const light::PuffLight> lights,
                           const light::Sun& sun, const ImpostorOptions& options,
                           const base::Progress& progress);

}  // namespace cloudgen::image
