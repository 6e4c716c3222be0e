// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/read_tiles.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/geocentric.hpp"
#include "base/gzip.hpp"
#include "check/tiles3d/content_path.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr int kDeepest = 100;
constexpr std::uint64_t kMostTilesetBytes = 256u << 20, kMostContentBytes = std::uint64_t{1} << 32;

class Reader {
 public:
  Reader(const std::filesystem::path& file, const base::Progress& progress,
         const std::function<void(const GlobeSplat&)>& visit)
      : file_(file), progress_(progress), visit_(visit) {}

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
    readSplats(plain(file, kMostContentBytes), file.string(), [&](const ReadSplat& splat) {
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

  const std::filesystem::path& file_;
  const base::Progress& progress_;
  const std::function<void(const GlobeSplat&)>& visit_;
};

}  // namespace

void readTiles(const std::filesystem::path& file, const base::Progress& progress,
               const std::function<void(const GlobeSplat&)>& visit) {
  Reader reader(file, progress, visit);
  try {
    reader.read();
  } catch (const json::exception& error) {
    reader.fail(std::string("is no tileset that can be read (") + error.what() + ")");
  }
}

}  // namespace cloudgen::check
