// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "image/picture.hpp"
#include "writer/x3d/cloud_parts.hpp"
#include "writer/x3d/sprite_sheet.hpp"

namespace cloudgen::writer {

/// From where a cloud is looked at: along -z of these axes, from far off, y up.
struct ViewAxes {
  glm::vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

/// Sides that pictures of clouds are taken from: eight azimuths, clockwise from north, a little from above,
/// so that they do for viewers on the ground and in an aeroplane; then from straight above, north up.
inline constexpr int kAzimuths = 8, kViews = kAzimuths + 1, kFromAbove = kAzimuths;
inline constexpr float kElevationDegrees = 12;
ViewAxes viewAxes(int view);

/// What a viewer sees of a cloud: straight alpha, sRGB, nothing at the border.
struct CardPicture {
  image::ByteImage pixels;
  glm::vec2 lower{0}, upper{0};  ///< corners, along the axes of the view
};

/// Draws the parts of a cloud as viewers blend them, at so many metres a pixel; coarser where it would be
/// larger than kMostPictureSide. Without pixels if nothing is seen.
CardPicture pictureOf(const std::vector<CloudPart>& parts, const SpriteSheet& sprites, int spritePixels,
                      const ViewAxes& view, float metersPerPixel);

inline constexpr int kMostPictureSide = 256;

}  // namespace cloudgen::writer
