// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/lines.hpp"

namespace cloudgen::motion {

/// Where the values of a lattice stand: on a cell's lower faces along one axis, or in its middle.
enum class Stand { FaceX, FaceY, FaceZ, Middle };

/// The velocity of cells per step on the faces of a box that closes on itself along x and z.
struct Flow {
  const Lattice* faces;    ///< three: along x, y, z
  float stepsPerVelocity;  ///< cells that a velocity of 1 goes in a step
};

/// What a lattice holds after a step in the flow: back along it, with the correction of MacCormack (Selle et al.
/// 2008, "An unconditionally stable MacCormack method"), never beyond the values that it came from.
Lattice carried(const Lattice& lattice, Stand stand, const Flow& flow);

/// Between the values, in units of cells from value (0, 0, 0): linear; closed along x and z, held at the ends of y.
float valueAt(const Lattice& lattice, float x, float y, float z);

}  // namespace cloudgen::motion
