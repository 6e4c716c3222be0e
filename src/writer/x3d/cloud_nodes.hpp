// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "writer/x3d/cloud_parts.hpp"
#include "writer/x3d/file_pictures.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

/// Writes clouds of one file as nodes: a Transform with the cloud's record as metadata around its lit
/// archetype, which the first cloud that needs it defines and the others use.
class CloudNodes {
 public:
  /// `pictures` may be null where no cloud is written in levels.
  CloudNodes(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Coverings& coverings,
             const FilePictures* pictures)
      : nodes_(nodes), shapes_(shapes), scene_(scene), coverings_(coverings), pictures_(pictures) {}

  /// A cloud that is seen in full from up to `rangeMeters` away (in the archetype's metres, at least), beyond
  /// it as its pictures.
  void inLevels(std::uint32_t instance, float rangeMeters);
  /// A cloud in one level of detail.
  void fixed(std::uint32_t instance, CloudDetail detail);

 private:
  void open(std::uint32_t instance);
  void record(const scene::CloudRecord& cloud);
  std::string nameOf(const scene::Instance& instance) const;
  void parts(const scene::Instance& instance, CloudDetail detail, const std::string& def);

  NodeWriter& nodes_;
  QuadShapes& shapes_;
  const scene::Scene& scene_;
  const Coverings& coverings_;
  const FilePictures* pictures_;
  std::set<std::string> defined_;
};

}  // namespace cloudgen::writer
