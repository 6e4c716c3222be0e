// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Writes impostors.json (schemas/impostors.schema.json) and impostors/: for every archetype and heading an atlas of
/// pictures from the directions of the upper hemisphere (image::bakeImpostor) under the scene's sun, and its depths;
/// and for every cloud which atlas it is drawn with, where and how large. For engines that draw far clouds as
/// pictures. Throws OutputError.
void writeImpostors(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
