// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/x3d.hpp"

#include "writer/copy_textures.hpp"
#include "writer/x3d/clouds.hpp"
#include "writer/x3d/environment.hpp"
#include "writer/x3d/geo_scene.hpp"
#include "writer/x3d/vrml97_clouds.hpp"

namespace cloudgen::writer {
namespace {

void writeScene(const scene::Scene& scene, const Destination& destination, Encoding encoding,
                const char* file) {
  const bool vrml97 = encoding == Encoding::Vrml97;  // all its clouds are pictures
  const auto atlases = vrml97 ? std::vector<image::SpriteAtlas>{} : copyTextures(scene, destination.folder);
  if (vrml97) makeTexturesFolder(destination.folder);
  const Stage stage = stageOf(scene);
  const auto nodes = nodeWriter(encoding, destination.folder / file);
  QuadShapes shapes(*nodes, atlases);
  const HeadEntries head = headOf(scene, stage);

  nodes->start(head);
  std::vector<glm::vec3> flight;
  for (const glm::dvec3& place : destination.flight) flight.emplace_back(scene.frame.toScene(place.x, place.y, place.z));
  writeEnvironment(*nodes, scene, stage, head, flight);
  (vrml97 ? writeVrml97Clouds : writeClouds)(*nodes, shapes, scene, stage, destination.folder, destination.progress);
  nodes->finish();
}

}  // namespace

void writeX3d(const scene::Scene& scene, const Destination& destination) {
  writeScene(scene, destination, Encoding::Xml, "scene.x3d");
  if (destination.x3d.onGlobe) writeGeoScene(scene, stageOf(scene), destination.folder);
}

void writeClassicVrml(const scene::Scene& scene, const Destination& destination) {
  writeScene(scene, destination, Encoding::Classic, "scene.x3dv");
}

void writeVrml97(const scene::Scene& scene, const Destination& destination) {
  writeScene(scene, destination, Encoding::Vrml97, "scene.wrl");
}

}  // namespace cloudgen::writer
