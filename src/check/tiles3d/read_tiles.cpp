// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/read_tiles.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/geocentric.hpp"
#include "base/gzip.hpp"
#include "check/gltf/glb_parts.hpp"
#include "check/tiles3d/content_path.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr int kDeepest = 100;
constexpr std::uint64_t kMostTilesetBytes = 256u << 20, kMostContentBytes = std::uint64_t{1} << 32;

class Reader {
 public:
  Reader(const std::filesystem::path& file, const base::Progress& progress,
         const std::function<void(const GlobeSplat&)>& visit, const VisitMesh& visitMesh)
      : file_(file), progress_(progress), visit_(visit), visitMesh_(visitMesh) {}

  void read() {
    const json tileset = json::parse(plain(file_, kMostTilesetBytes));
    visitTile(tileset.at("root"), glm::dmat4(1), false, 0);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw base::InputError(file_.string(), what, "name a tileset.json that cloudgen wrote, or its folder");
  }

 private:
  static std::string plain(const std::filesystem::path& file, std::uint64_t limitBytes) {
    std::string bytes = base::readFile(file, limitBytes);
    return base::isGzip(bytes) ? base::unzipped(bytes, file.string(), limitBytes) : bytes;
  }

  void visitTile(const json& tile, const glm::dmat4& parent, bool adds, int depth) {
    if (depth > kDeepest) fail("has tiles within tiles too deep");
    progress_.step("verify: read", 0);
    glm::dmat4 toEarth = parent;
    if (tile.contains("transform")) {
      glm::dmat4 own(1);
      for (int i = 0; i < 16; ++i) own[i / 4][i % 4] = tile["transform"].at(static_cast<std::size_t>(i));
      toEarth = parent * own;
    }
    if (tile.contains("refine")) adds = tile["refine"] == "ADD";
    const json children = tile.value("children", json::array());
    if (tile.contains("content") && (adds || children.empty()))
      visitContent(tile["content"].at("uri").get<std::string>(), toEarth);
    for (const json& child : children) visitTile(child, toEarth, adds, depth + 1);
  }

  void visitContent(const std::string& uri, const glm::dmat4& toEarth) const {
    const std::string path = contentPath(uri);
    if (path.empty()) fail("names a content that is no path within its folder");
    const auto file = file_.parent_path() / path;
    const std::string bytes = plain(file, kMostContentBytes);
    if (!holdsSplats(bytes, file.string())) {
      // From y up to z up, as 3D Tiles take glTF.
      const glm::dmat4 upright(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
      readPictureMeshes(bytes, file.string(), [&](const MeshNode& node) {
        if (visitMesh_) visitMesh_(node, toEarth * upright);
      });
      return;
    }
    readSplats(bytes, file.string(), [&](const ReadSplat& splat) {
      GlobeSplat out;
      out.center = glm::dvec3(toEarth * glm::dvec4(base::zUp(splat.center), 1));
      const glm::mat3 axes = glm::mat3_cast(glm::normalize(splat.rotation));
      for (int axis = 0; axis < 3; ++axis)
        out.halfAxes[axis] = glm::dmat3(toEarth) * base::zUp(glm::dvec3(axes[axis] * splat.sigma[axis]));
      out.opacity = splat.opacity;
      out.opticalDepth = splat.opticalDepth;
      visit_(out);
    });
  }

  static bool holdsSplats(std::string_view bytes, const std::string& where) {
    const GlbParts glb(bytes, where, "is it binary glTF?");
    const json used = glb.root().value("extensionsUsed", json::array());
    return std::find(used.begin(), used.end(), "KHR_gaussian_splatting") != used.end();
  }

  const std::filesystem::path& file_;
  const base::Progress& progress_;
  const std::function<void(const GlobeSplat&)>& visit_;
  const VisitMesh& visitMesh_;
};

}  // namespace

void readTiles(const std::filesystem::path& file, const base::Progress& progress,
               const std::function<void(const GlobeSplat&)>& visit, const VisitMesh& visitMesh) {
  Reader reader(file, progress, visit, visitMesh);
  try {
    reader.read();
  } catch (const json::exception& error) {
    reader.fail(std::string("is no tileset that can be read (") + error.what() + ")");
  }
}

}  // namespace cloudgen::check
