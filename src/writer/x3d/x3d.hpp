// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Writes scene.x3d (X3D 4.0, XML encoding) and textures/. Only nodes that X_ITE, X3DOM and view3dscene all
/// draw. On request also scene.geo.x3d, which has it on the globe.
void writeX3d(const scene::Scene& scene, const Destination& destination);

/// Writes scene.x3dv, the same nodes in the ClassicVRML encoding, and textures/.
void writeClassicVrml(const scene::Scene& scene, const Destination& destination);

/// Writes scene.wrl (VRML97: clouds as textured pictures that turn, WorldInfo in the place of metadata) and
/// textures/.
void writeVrml97(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
