// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "check/fidelity/card_scene.hpp"
#include "check/gltf/read_meshes.hpp"

namespace cloudgen::check {

/// Adds the cards of a mesh: vertices that triangles join are of one card, its alpha their mean. Without both sides
/// cards show those that their triangles turn to. Of a relief the cells that state an optical depth, whatever side
/// they show: a column meets half of a cloud where it enters, half where it leaves.
void addCardsOf(const PictureMesh& mesh, std::vector<Card>& cards);

}  // namespace cloudgen::check
