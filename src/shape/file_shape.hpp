// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "base/volume.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {

/// A shape that came from a file, ready to be made into puffs of any number and size.
struct FileShape {
  std::string kind;           ///< "mesh", "lsystem" or "volume"
  double widthOverDepth = 1;  ///< its own proportion; the width is that of a disc that spans as much ground
  /// Puffs that fill the width (a disc of it spans as much ground) and the depth of the request. May be
  /// called from any thread.
  std::function<RawShape(const Recipe&, const ShapeRequest&)> shape;
  /// Of a volume alone: how far the optical depth of puffs that fill a width and depth (metres) is from the
  /// volume's, seen from above, along x and along z: the root of the mean squared difference over a raster,
  /// as a share of that of the volume's optical depth.
  std::function<std::array<double, 3>(std::span<const Puff>, double, double)> opticalDepthErrors;
};

/// From a box of cells: puffs of the moments of its parts.
FileShape shapeFromVolume(const base::Volume& volume);

/// The shape of a recipe whose form is File and whose file is opened.
RawShape shapeFromFile(const Recipe& recipe, const ShapeRequest& request);

/// From a triangle mesh, whatever its state: one that is open, crosses itself or is no surface is wrapped
/// first. Throws InputError that names `where`: no volume at all.
FileShape shapeFromMesh(const base::Mesh& mesh, const std::string& where);

/// From the text of an L-system (shape/grammar.hpp). Throws InputError.
FileShape shapeFromGrammar(const std::string& json, const std::string& where);

/// Cuts a shape off flat at a twelfth of its depth: what hangs lower gathers there, as a cloud does at its
/// condensation level.
void flattenBase(std::vector<Puff>& puffs, double depthMeters);

}  // namespace cloudgen::shape
