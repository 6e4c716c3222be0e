// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "base/genus.hpp"
#include "writer/x3d/node_writer.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// Faces that one Shape holds at most: it keeps every attribute under 100,000 values, which readers stay fast
/// with.
inline constexpr std::size_t kFacesPerShape = 16000;

/// Writes quads as Shapes with the texture of their genus. The Appearance of a genus is defined by its first
/// Shape and used by the others: viewers then load the texture once.
class QuadShapes {
 public:
  QuadShapes(NodeWriter& nodes, const std::vector<image::SpriteAtlas>& atlases)
      : nodes_(nodes), atlases_(atlases) {}

  /// One Shape in the open node's children, more of them if there are more than kFacesPerShape faces; none
  /// for no face. Colours are unlit: an RGBA colour a vertex and no Material. The optical depth of quads stands
  /// beside them, in order (0 where alpha tells it), if some are so dense that alpha cannot. Not for VRML97, which
  /// knows no opacity a vertex.
  void write(base::Genus genus, const QuadMesh& mesh);

  /// The same with a texture of its own, whose Appearance is named `look`; in VRML97 the quads are opaque but for it.
  void writePictures(const std::string& look, const std::string& texture, const QuadMesh& mesh);

  const std::vector<image::SpriteAtlas>& atlases() const { return atlases_; }
  const image::SpriteAtlas& atlas(base::Genus genus) const { return image::atlasOf(atlases_, genus); }

 private:
  /// Names of an Appearance and of its texture, and the texture's file.
  struct Look {
    std::string name, textureName, file;
  };
  void shapes(const Look& look, const QuadMesh& mesh);
  void appearance(const Look& look);
  void texture(const Look& look);
  void shape(const Look& look, const QuadMesh& mesh, std::span<const std::uint32_t> faces);

  NodeWriter& nodes_;
  const std::vector<image::SpriteAtlas>& atlases_;
  std::set<std::string> defined_;
};

}  // namespace cloudgen::writer
