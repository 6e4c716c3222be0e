// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/mesh.hpp"

namespace cloudgen::shape {

/// A closed surface without crossings, its triangles counter-clockwise seen from outside, in ever fewer
/// triangles: each level has half of the one before, the last about a dozen.
std::vector<base::Mesh> simplifiedSolids(const base::Mesh& mesh, std::size_t mostTriangles,
                                         const std::string& where);

}  // namespace cloudgen::shape
