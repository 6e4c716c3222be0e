// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "light/extinction_grid.hpp"
#include "light/harmonics.hpp"
#include "light/optics.hpp"
#include "shape/puff.hpp"

namespace cloudgen::light {

/// How a puff answers to light, whatever the sun: radiances relative to a white surface that faces the light
/// squarely. Baked once for a cloud; a sun or a heading then costs a dot product.
struct PuffTransfer {
  Harmonics sun{};       ///< all orders of scattering, of the direction towards the sun
  Harmonics through{};   ///< what of the beam comes nearly straight to the skin
  float sky = 0;         ///< under an even sky of radiance 1 above the horizon
  float ground = 0;      ///< over ground of radiance 1; sky + ground is 1 for what does not absorb
  float upward = 0;      ///< how far the outside about it lies above (1) or below (-1)
  float visibility = 0;  ///< mean transmittance to the outside, 0 for what is hidden all around
};

/// A cloud's puffs, in their order, and how its bright faces answer to a high sun.
struct CloudTransfer {
  std::vector<PuffTransfer> puffs;
  float bright =
      1;  ///< an eleventh of what is seen answers more, under the sun of a lattice that suits it best
  ScatteredOnce once;  ///< how unevenly it sends out sunlight: less towards the sun, the thinner it is
};

/// The same for one direction of the sun, not fitted.
struct SunAnswer {
  float sun = 0, through = 0;
  ScatteredOnce once;
};

/// Optical depths of every puff along one direction: from a little outside of its skin, and from its middle.
struct PuffDepths {
  std::vector<float> skin, middle;
};

/// What lies about the puffs of a cloud: depths along each direction of the lattice, and how much the cloud is
/// a piece of a layer (layerShare). With all extinction multiplied, the depths are.
struct CloudDepths {
  std::vector<PuffDepths> towards;
  float layer = 0;
};

/// By sweeps in 48 directions through the medium of `grid`.
CloudDepths depthsIn(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid);

/// Transfer of each puff of a cloud in which depths are `denser` times those given: octaves of the reduced
/// depths (1 - `asymmetry`) tau before and behind the puff, and how squarely its skin faces the light.
CloudTransfer bakeTransfer(std::span<const shape::Puff> puffs, const CloudDepths& depths, float asymmetry,
                           float denser = 1);
/// The same inside the medium of `grid`.
CloudTransfer bakeTransfer(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid, float asymmetry);

/// 1 for a puff that looks down from a thick cloud, 0 for one that looks up or is of a thin one.
float undersideOf(const CloudTransfer& cloud, const PuffTransfer& transfer);

/// Area of a puff, as far as it hides what is behind it and is seen.
float shownArea(const shape::Puff& puff, const PuffTransfer& transfer);
/// What of it weighs in the tone of its cloud: rain has a tone of its own.
float seenArea(const shape::Puff& puff, const PuffTransfer& transfer);

/// 1 for a puff that is a level top of a cloud, 0 for one that faces another way or is of a cloud so thin that it has
/// no faces.
float levelOf(const CloudTransfer& cloud, const PuffTransfer& transfer);

/// The answers to one direction towards the sun without the fit, by two sweeps.
std::vector<SunAnswer> bakeSun(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                               float asymmetry, const glm::vec3& sunDirection);

}  // namespace cloudgen::light
