// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "writer/pictures/cloud_pictures.hpp"
#include "writer/pictures/picture_atlas.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

/// Archetypes as textured pictures in one texture: what CloudMeshes are where colours have no opacity. What
/// lies level, or one that turns to the viewer about its middle.
class TurningPictures {
 public:
  /// Of these instances. `name` is that of the texture's file.
  TurningPictures(const scene::Scene& scene, std::span<const std::uint32_t> instances, std::string name);

  /// Writes the cloud of an instance, in its own metres; those that share it use what the first has defined.
  void write(NodeWriter& nodes, QuadShapes& shapes, const scene::Instance& instance);
  /// Writes the texture, if there is a picture. Throws OutputError.
  void texture(const std::filesystem::path& folder) const;

 private:
  /// Archetype and step of shadow. That is painted: by the standard of VRML97 no colour reaches a texture.
  using Look = std::pair<std::uint32_t, int>;
  struct Whole {
    NearPictures near;
    std::size_t first = 0;  ///< place in the atlas
    bool isDefined = false;
  };
  Look lookOf(const scene::Instance& instance) const;

  const scene::Scene& scene_;
  std::string name_;
  std::map<Look, Whole> wholes_;
  std::optional<PictureAtlas> atlas_;
};

}  // namespace cloudgen::writer
