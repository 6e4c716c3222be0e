// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>

#include "writer/x3d/cloud_meshes.hpp"
#include "writer/x3d/cloud_parts.hpp"
#include "writer/x3d/film_nodes.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

/// Where a cloud is drawn for those who are not near it.
enum class Beyond : unsigned char { Here, Elsewhere };

/// How far away from its middle a cloud is drawn in full where that is wanted `reachMeters` away: a little of its own
/// size, metres of its archetype.
float nearRange(const scene::Scene& scene, const scene::Instance& instance, float reachMeters);

/// Writes clouds of one file as nodes: a Transform with the cloud's record as metadata around its lit
/// archetype, which the first cloud that needs it defines and the others use.
class CloudNodes {
 public:
  /// Pictures finer than `finestWhole` are only of clouds that are also in full: `whole` leaves them to `near`
  /// elsewhere.
  CloudNodes(NodeWriter& nodes, QuadShapes& shapes, FilmNodes& film, const scene::Scene& scene,
             const Coverings& coverings, const CloudMeshes& meshes, MeshFineness finestWhole)
      : nodes_(nodes),
        shapes_(shapes),
        film_(film),
        scene_(scene),
        coverings_(coverings),
        meshes_(meshes),
        finestWhole_(finestWhole) {}

  /// A cloud that is seen in full by who is almost in it, and as pictures of its parts by who is near: as far
  /// away as `reachMeters` (in the archetype's metres), or a little of its own size. Beyond it is one
  /// picture, unless that is drawn elsewhere.
  void near(std::uint32_t instance, float reachMeters, Beyond beyond);
  /// A cloud as one picture, without its record; drawn by those who are near, too, or from where on `near`
  /// leaves it to.
  void whole(std::uint32_t instance, std::optional<float> reachMeters);
  /// A cloud in one level of detail.
  void fixed(std::uint32_t instance, CloudDetail detail);

 private:
  void open(std::uint32_t instance);
  std::string nameOf(const scene::Instance& instance) const;
  void openLevels(const scene::Instance& instance, const std::string& def, std::span<const float> ranges);
  /// How far away its pictures begin, by MeshFineness.
  std::array<float, 3> beginningsOf(const scene::Instance& instance, float reachMeters) const;
  void empty();
  void picture(const scene::Instance& instance, MeshFineness fineness);
  std::vector<CloudPart> partsIn(const scene::Instance& instance, CloudDetail detail) const;
  void parts(base::Genus genus, const std::vector<CloudPart>& parts, const std::string& def);

  NodeWriter& nodes_;
  QuadShapes& shapes_;
  FilmNodes& film_;
  const scene::Scene& scene_;
  const Coverings& coverings_;
  const CloudMeshes& meshes_;
  MeshFineness finestWhole_;
  std::set<std::string> defined_;
};

}  // namespace cloudgen::writer
