// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "writer/x3d/picture_quads.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/sheets.hpp"
#include "writer/x3d/tile_tree.hpp"

namespace cloudgen::writer {

/// Clouds of a square are flat on it if it is wide and many times as wide as they reach up: it is a sheet
/// from afar.
bool isFlat(const TileNode& tile);

/// The squares of one file from afar, all their pictures in one texture: sheets of the flat ones, and of the
/// clouds of the others what they are from all sides.
class FilePictures {
 public:
  /// `name` is that of the texture's file.
  FilePictures(const scene::Scene& scene, const std::vector<const TileNode*>& squares,
               const PictureSize& size, std::string name);

  /// Writes a square as it is from afar: its sheet, or its clouds' pictures as one Shape.
  void writeSquare(QuadShapes& shapes, const TileNode& tile) const;
  /// Writes the texture, if there is a picture. Throws OutputError.
  void texture(const std::filesystem::path& folder) const;

 private:
  struct Cloud {
    std::uint32_t lit = 0;
    CloudPictures pictures;
    std::size_t first = 0;
  };
  void paintClouds(const std::set<std::uint32_t>& lit, const PictureSize& size);
  void write(QuadShapes& shapes, const QuadMesh& mesh) const;

  const scene::Scene& scene_;
  std::string name_;
  std::map<const TileNode*, Sheet> sheets_;
  std::map<const TileNode*, std::size_t> sheetPlaces_;
  std::map<std::uint32_t, Cloud> clouds_;
  std::optional<PictureAtlas> atlas_;
  bool isEmpty_ = true;
};

}  // namespace cloudgen::writer
