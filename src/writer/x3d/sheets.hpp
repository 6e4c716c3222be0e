// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/picture.hpp"
#include "scene/scene.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// The clouds of a square as a level picture from above: far off, where clouds are flat against how far they
/// reach, a viewer sees hardly more, and blends one pixel instead of dozens of cards over each other.
struct Sheet {
  image::ByteImage picture;         ///< straight alpha, sRGB, its rows to the south; nothing at the border
  float height = 0;                 ///< of what is seen, metres
  glm::vec2 lower{0}, upper{0};     ///< corners: x and z, metres
  std::vector<glm::ivec4> patches;  ///< left, top, right, bottom of what is not empty, in pixels
};

/// Paints the puffs of instances (their far puffs, or one puff where they have none), so many pixels a side.
Sheet sheetOf(const scene::Scene& scene, std::span<const std::uint32_t> instances, int pixels);

/// Sheets in one texture, side by side.
class SheetAtlas {
 public:
  /// Of pictures of so many pixels a side.
  SheetAtlas(std::span<const Sheet> sheets, int pixels);
  const image::ByteImage& texture() const { return texture_; }
  /// The patches of a sheet, both their faces.
  QuadMesh meshOf(const Sheet& sheet, std::size_t index) const;

 private:
  std::size_t across_ = 1;
  image::ByteImage texture_;
};

}  // namespace cloudgen::writer
