// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "image/picture.hpp"

namespace cloudgen::writer {

/// A texture as viewers see it through a filter: halved again and again, each level looked up between its
/// texels. Colours are sRGB code values that alpha has been multiplied into.
class SpriteSheet {
 public:
  /// `image` has four channels, straight alpha.
  explicit SpriteSheet(const image::ByteImage& image);

  struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels;  ///< row by row from the top

    /// The texture at a place, 0..1 from the lower left.
    glm::vec4 at(const glm::vec2& place) const;
    const glm::vec4& texel(int x, int y) const;
  };

  /// The level for pixels that are so many times as wide as a texel of the finest.
  const Level& level(float texelsPerPixel) const;
  int width() const { return levels_.front().width; }

 private:
  std::vector<Level> levels_;
};

}  // namespace cloudgen::writer
