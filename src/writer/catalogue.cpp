// SPDX-License-Identifier: Apache-2.0
#include "writer/catalogue.hpp"

#include <array>
#include <cstdint>

#include "base/error.hpp"
#include "base/text.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/impostors/impostors.hpp"
#include "writer/pack/pack.hpp"
#include "writer/page/page.hpp"
#include "writer/ply/ply.hpp"
#include "writer/tiles3d/tiles3d.hpp"
#include "writer/x3d/x3d.hpp"

namespace cloudgen::writer {
namespace {

/// Clouds that are nodes of their own, each with its animation: viewers compute all of them for every frame.
constexpr std::size_t kMostMovingNodes = 4000;

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> kFormats{
      {"x3d", "X3D XML, portable profile", {"scene.x3d"}, writeX3d, false, false, kMostMovingNodes},
      {"x3dv", "X3D in the ClassicVRML encoding", {"scene.x3dv"}, writeClassicVrml, false, false, kMostMovingNodes},
      {"vrml", "VRML97", {"scene.wrl"}, writeVrml97, false, false, kMostMovingNodes},
      {"splats", "Gaussian splats: glTF with KHR_gaussian_splatting", {"scene.splats.glb"}, writeSplats},
      {"ply", "Gaussian splats as splat tools read them", {"scene.splats.ply"}, writePly, true},
      {"glb", "core glTF 2.0: clouds as pictures on their relief", {"scene.glb"}, writeCards, false, false, kMostMovingNodes},
      {"pack", "realtime runtime pack (FlatBuffers)", {"scene.cgpack"}, writePack, false, false, SIZE_MAX},
      {"tiles", "3D Tiles 1.1: a quadtree of splats or cards on the globe", {"tileset.json"}, writeTiles, true, false, SIZE_MAX},
      {"impostors", "pictures of each cloud from all sides, with depth", {"impostors.json"}, writeImpostors, true},
      {"page", "a page that opens in any browser (shows the pack)", {"index.html"}, writePage, false, true},
  };
  return kFormats;
}

std::span<const std::pair<std::string_view, std::string_view>> formatsNotBuilt() {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 1> kLater{
      {{"vdb", "OpenVDB volume"}}};
  return kLater;
}

std::vector<const Format*> chosenFormats(const std::string& list) {
  std::vector<std::string> wanted;
  if (list.empty() || list == "default")
    for (const Format& format : formats()) {
      if (!format.onlyOnRequest) wanted.emplace_back(format.name);
    }
  else
    wanted = base::split(list, ',');
  std::vector<std::string> known;
  for (const Format& format : formats()) known.emplace_back(format.name);
  for (const std::string& name : wanted) {
    for (const auto& [later, what] : formatsNotBuilt())
      if (name == later)
        throw base::NotBuiltError("--formats " + name, std::string(what) + " is not part of this build",
                                  "leave it out; `cloudgen formats` lists what is");
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string nearest = base::nearestWord(name, known);
      throw base::UsageError(
          "--formats " + name, "is not a known format",
          nearest.empty() ? "`cloudgen formats` lists them" : "did you mean " + nearest + "?");
    }
  }
  std::vector<const Format*> chosen;
  for (const Format& format : formats())
    if (std::find(wanted.begin(), wanted.end(), format.name) != wanted.end()) chosen.push_back(&format);
  return chosen;
}

}  // namespace cloudgen::writer
