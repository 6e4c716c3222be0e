// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Writes scene.splats.glb: every puff of every cloud as a Gaussian splat (KHR_gaussian_splatting, ratified
/// text), lit by spherical harmonics up to the degree of SplatOptions, made and written piece by piece. One point
/// primitive a tile (at most 16 tiles, at most 200,000 splats each) under a node at the tile's centre; splats in
/// Morton order; those below an opacity of 0.004 are left out. Throws OutputError if the file cannot be written or
/// would pass glTF's 4 GiB.
void writeSplats(const scene::Scene& scene, const Destination& destination);

/// Writes scene.glb: glTF 2.0 without splats. One mesh of unlit pictures a lit archetype, upright and level, placed
/// by EXT_mesh_gpu_instancing, whose attribute _COLOR_0 dims clouds in the shadow of others, or by a node a cloud
/// (CardOptions); the pictures of a genus are painted from its puffs into one embedded texture; a node "ground" is
/// the ground with its shadows. Throws OutputError as above.
void writeCards(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
