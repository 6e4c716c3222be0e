// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "image/picture.hpp"

namespace cloudgen::writer {

/// What has less alpha is hardly seen.
inline constexpr unsigned char kSeenAlpha = 3;

/// What a pixel shows; colour and nearness have alpha multiplied into them.
struct PaintedPixel {
  glm::vec3 color{0};
  float alpha = 0, nearness = 0;
  float opticalDepth = 0;
};

/// What a picture shows as a surface: vertices of a grid over it, row by row from the top.
struct Relief {
  int columns = 0, rows = 0;        ///< cells
  std::vector<float> nearness;      ///< mean place of what is seen about a vertex, along towards, metres
  std::vector<float> opticalDepth;  ///< at a vertex; the cells that are shown hold all of the picture's
  std::vector<std::array<int, 2>> shown;  ///< column and row of cells where something is seen, far ones first

  std::size_t vertex(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
           static_cast<std::size_t>(column);
  }
};

/// Where a picture was cut out of a canvas.
struct Cutting {
  std::span<const PaintedPixel> canvas;
  int canvasWidth = 0;
  glm::ivec2 corner{0};  ///< of the picture, upper left

  const PaintedPixel& at(int x, int y) const {
    return canvas[static_cast<std::size_t>(corner.y + y) * static_cast<std::size_t>(canvasWidth) +
                  static_cast<std::size_t>(corner.x + x)];
  }
};

/// The relief of a picture, so many cells along its longer side; where nothing is seen it goes on as it does
/// beside, or lies at `surface`.
Relief reliefOf(const image::ByteImage& picture, float surface, const Cutting& cutting, int cells);

}  // namespace cloudgen::writer
