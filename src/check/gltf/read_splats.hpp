// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/height_field.hpp"

namespace cloudgen::check {

/// A splat as a viewer sees it: scene position, colours display-encoded.
struct ReadSplat {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opacity = 0;
  float opticalDepth = 0;  ///< along the shortest axis: as stated, where that agrees with the opacity
  glm::vec3 color{0};                    ///< degree 0: what it shows from every side
  std::array<glm::vec3, 3> harmonics{};  ///< degree-1 coefficients, zero if the file has none
};

struct SplatFile {
  std::vector<ReadSplat> splats;
  base::HeightField terrain;                                 ///< from the asset's extras; empty if not there
  double sunAzimuthDegrees = 180, sunElevationDegrees = 45;  ///< from the asset's extras, if there
  float moonlight = 1;                                       ///< the same: how bright nights are shown
};

/// Reads a .glb of KHR_gaussian_splatting primitives, with float attributes or packed as SPZ, in nodes that are
/// only moved and scaled, as cloudgen writes them. Throws InputError where the file is something else or reaches outside its bounds.
SplatFile readSplats(const std::filesystem::path& file);

/// The same from the bytes of a file; `where` names it in messages.
SplatFile readSplats(std::string_view bytes, const std::string& where);

/// The same, but hands every splat over instead of keeping it.
SplatFile readSplats(std::string_view bytes, const std::string& where,
                     const std::function<void(const ReadSplat&)>& visit);

}  // namespace cloudgen::check
