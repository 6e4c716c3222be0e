// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/validate_tileset.hpp"

#include <glm/matrix.hpp>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/gzip.hpp"
#include "check/gltf/glb_parts.hpp"
#include "check/gltf/gltf_elements.hpp"
#include "check/gltf/validate_glb.hpp"
#include "check/tiles3d/content_path.hpp"
#include "check/tiles3d/content_points.hpp"
#include "check/tiles3d/tile_metadata.hpp"
#include "check/tiles3d/tile_volume.hpp"

namespace cloudgen::check {
namespace {

constexpr std::uint64_t kMostTilesetBytes = 256u << 20, kMostContentBytes = std::uint64_t{1} << 32;
constexpr int kDepthLimit = 256;
/// A point may be so far outside its volume: packed positions of a large tile are rounded to a metre or so.
constexpr double kContentSlackMeters = 2;

/// What a tile hands down to its children.
struct Above {
  glm::dmat4 toEarth{1};
  TileVolume volume;
  double error = 0;
  bool hasVolume = false;
};

bool isNumber(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

class TilesetChecker {
 public:
  TilesetChecker(const Json& tileset, const ContentReader& contents, FindingList& findings,
                 const base::Progress& progress)
      : tileset_(tileset), contents_(contents), findings_(findings), progress_(progress) {}

  void run() {
    checkAsset();
    checkExtensions();
    const double error = errorOf(tileset_, "the tileset");
    const Json& root = member(tileset_, "root");
    if (!root.is_object()) return report("tiles-required", "the tileset has no root", "every tileset has one tile");
    Above above;
    above.error = error;
    if (!root.contains("refine"))
      report("tiles-refine", "the root has no refine", "write \"REPLACE\" or \"ADD\"");
    checkTile(root, "root", above);
    findings_.result().elements = findings_.result().nodes;
  }

 private:
  void report(std::string_view rule, std::string message, std::string hint) {
    findings_.error({}, rule, std::move(message), std::move(hint));
  }

  void checkAsset() {
    const Json& version = member(member(tileset_, "asset"), "version");
    if (version != "1.1" && version != "1.0")
      report("tiles-asset", "asset.version is neither \"1.1\" nor \"1.0\"", "every tileset says so");
  }

  void checkExtensions() {
    std::set<std::string> declared;
    for (const Json& name : list(tileset_, "extensionsUsed"))
      if (name.is_string()) declared.insert(name.get<std::string>());
    for (const Json& name : list(tileset_, "extensionsRequired"))
      if (!name.is_string() || !declared.contains(name.get<std::string>()))
        report("tiles-extension", "extensionsRequired names what extensionsUsed does not", "name it in both");
    const Json& own = member(tileset_, "extensions");
    if (own.is_object())
      for (const auto& [name, ignored] : own.items())
        if (!declared.contains(name))
          report("tiles-extension", excerpt(name) + " is used but not in extensionsUsed", "name it there");
    const Json& gltf = member(own, "3DTILES_content_gltf");
    if (!gltf.is_object()) return;
    declaresGltf_ = true;
    for (const Json& name : list(gltf, "extensionsUsed"))
      if (name.is_string()) gltfExtensions_.insert(name.get<std::string>());
    for (const Json& name : list(gltf, "extensionsRequired"))
      if (!name.is_string() || !gltfExtensions_.contains(name.get<std::string>()))
        report("tiles-extension", "3DTILES_content_gltf requires an extension that it does not use",
               "name it in both");
  }

  double errorOf(const Json& of, const std::string& where) {
    const Json& error = member(of, "geometricError");
    if (isNumber(error) && error.get<double>() >= 0) return error;
    report(error.is_null() ? "tiles-required" : "tiles-error",
           where + (error.is_null() ? " has no geometricError" : ": geometricError is no number of 0 or more"),
           "say in metres what is lost if it is not refined");
    return 0;
  }

  void checkTile(const Json& tile, const std::string& where, const Above& above) {
    if (findings_.full()) return;
    progress_.step("validate", 0);
    ++findings_.result().nodes;
    if (!tile.is_object()) return report("tiles-required", where + " is no object", "write a tile");
    Above own;
    own.error = errorOf(tile, where);
    if (own.error > above.error * (1 + 1e-9))
      report("tiles-error", fmt::format("{}: geometricError is {}, above its parent's {}", where, own.error, above.error),
             "errors fall from the root to the leaves");
    checkRefine(tile, where);
    own.toEarth = above.toEarth * transformOf(tile, where);
    checkVolume(tile, where, above, own);
    checkContents(tile, where, own);
    checkMetadata(member(tile, "metadata"), where + ".metadata");
    if (tile.contains("implicitTiling"))
      return findings_.warning({}, "tiles-unread", where + " has implicit tiles", "they are not looked into");
    if (tile.contains("children") && (!tile["children"].is_array() || tile["children"].empty()))
      report("tiles-required", where + ": children is no list of tiles", "leave it out where there are none");
    const Json& children = list(tile, "children");
    for (std::size_t i = 0; i < children.size(); ++i)
      checkTile(children[i], fmt::format("{}.children[{}]", where, i), own);
  }

  void checkRefine(const Json& tile, const std::string& where) {
    const Json& refine = member(tile, "refine");
    if (!refine.is_null() && refine != "REPLACE" && refine != "ADD")
      report("tiles-refine", where + ": refine is neither REPLACE nor ADD", "write one of both, in capitals");
  }

  glm::dmat4 transformOf(const Json& tile, const std::string& where) {
    glm::dmat4 matrix(1);
    if (!tile.contains("transform")) return matrix;
    const Json& values = tile["transform"];
    const bool isMatrix = values.is_array() && values.size() == 16 && std::ranges::all_of(values, isNumber);
    for (int i = 0; isMatrix && i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
    const bool isAffine = matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1;
    if (isMatrix && isAffine && std::abs(glm::determinant(glm::dmat3(matrix))) > 1e-12) return matrix;
    report("tiles-transform", where + ": transform is no affine matrix of 16 numbers that can be inverted",
           "write it column by column");
    return glm::dmat4(1);
  }

  void checkVolume(const Json& tile, const std::string& where, const Above& above, Above& own) {
    if (!tile.contains("boundingVolume"))
      return report("tiles-required", where + " has no boundingVolume", "every tile has one");
    const std::string fault = readVolume(tile["boundingVolume"], own.toEarth, own.volume);
    own.hasVolume = fault.empty();
    if (!own.hasVolume) return report("tiles-volume", where + ": boundingVolume " + fault, "see 3D Tiles 1.1, Bounding volumes");
    if (above.hasVolume && !test_.holds(above.volume, own.volume))
      report("tiles-volume", where + " reaches out of the volume of its parent", "children lie within their parents");
  }

  void checkContents(const Json& tile, const std::string& where, const Above& own) {
    if (tile.contains("content") && tile.contains("contents"))
      report("tiles-content", where + " has content and contents", "keep one of both");
    if (tile.contains("content")) checkContent(tile["content"], where + ".content", own);
    if (tile.contains("contents") && list(tile, "contents").empty())
      report("tiles-content", where + ": contents is no list of contents", "leave it out where there are none");
    const Json& contents = list(tile, "contents");
    for (std::size_t i = 0; i < contents.size(); ++i)
      checkContent(contents[i], fmt::format("{}.contents[{}]", where, i), own);
  }

  void checkContent(const Json& content, const std::string& where, const Above& own) {
    const Json& uri = member(content, "uri");
    if (!uri.is_string()) return report("tiles-content", where + " has no uri", "name a file");
    const std::string path = contentPath(uri.get<std::string>());
    if (path.empty())
      return report("tiles-path", where + ": uri " + excerpt(uri.get<std::string>()) + " is no path within the folder of the tileset",
                    "keep contents beside or below tileset.json");
    Above inner = own;
    if (content.contains("boundingVolume")) {
      const std::string fault = readVolume(content["boundingVolume"], own.toEarth, inner.volume);
      if (!fault.empty()) return report("tiles-volume", where + ": boundingVolume " + fault, "see 3D Tiles 1.1, Bounding volumes");
      if (own.hasVolume && !test_.holds(own.volume, inner.volume))
        report("tiles-volume", where + " reaches out of the volume of its tile", "contents lie within their tiles");
      inner.hasVolume = true;
    }
    checkMetadata(member(content, "metadata"), where + ".metadata");
    try {
      checkBytes(contents_(path), path, where, inner);
    } catch (const base::InputError& error) {
      report("tiles-content", where + ": " + error.where() + " " + error.problem(), error.hint());
    }
  }

  void checkBytes(std::string bytes, const std::string& path, const std::string& where, const Above& own) {
    if (base::isGzip(bytes)) bytes = base::unzipped(bytes, path, kMostContentBytes);
    findings_.result().bytes += bytes.size();
    if (!bytes.starts_with("glTF"))
      return findings_.warning({}, "tiles-unread", where + ": " + excerpt(path) + " is no binary glTF",
                               "it is not looked into");
    const ValidationResult inside = validateGlbBytes(bytes, path, progress_);
    for (const Finding& finding : inside.findings)
      (finding.severity == Severity::Error ? report(finding.rule, path + ": " + finding.message, finding.hint)
                                           : findings_.warning({}, finding.rule, path + ": " + finding.message, finding.hint));
    if (!inside.valid()) return;
    checkGltfExtensions(bytes, path);
    if (!own.hasVolume) return;
    std::size_t outside = 0, all = 0;
    visitContentPoints(bytes, path, [&](const glm::dvec3& point) {
      ++all;
      const glm::dvec3 earth(own.toEarth * glm::dvec4(base::zUp(point), 1));
      if (!test_.holds(own.volume, earth, kContentSlackMeters)) ++outside;
    });
    if (outside > 0)
      report("tiles-content", fmt::format("{}: {} of the {} points of {} lie outside its volume", where, outside, all, excerpt(path)),
             "widen the volume, or move the content");
  }

  /// 3DTILES_content_gltf tells what the contents need, if it is there.
  void checkGltfExtensions(std::string_view bytes, const std::string& path) {
    if (!declaresGltf_) return;
    const GlbParts glb(bytes, path, "is it binary glTF?");
    for (const Json& name : list(glb.root(), "extensionsRequired"))
      if (name.is_string() && !gltfExtensions_.contains(name.get<std::string>()))
        report("tiles-extension", path + " requires " + excerpt(name.get<std::string>()) + ", which 3DTILES_content_gltf does not tell",
               "name it there in extensionsUsed");
  }

  void checkMetadata(const Json& metadata, const std::string& where) {
    if (metadata.is_null()) return;
    const std::string fault = metadataFault(metadata, member(tileset_, "schema"));
    if (!fault.empty() && !tileset_.contains("schemaUri"))
      report("tiles-metadata", where + " " + fault, "see the schema of the tileset");
  }

  const Json& tileset_;
  const ContentReader& contents_;
  FindingList& findings_;
  const base::Progress& progress_;
  VolumeTest test_;
  std::set<std::string> gltfExtensions_;
  bool declaresGltf_ = false;
};

}  // namespace

ValidationResult validateTilesetBytes(std::string_view bytes, const std::string& name,
                                      const ContentReader& contents, const base::Progress& progress) {
  ValidationResult result;
  result.bytes = bytes.size();
  FindingList findings(name, result);
  std::string plain;
  if (base::isGzip(bytes)) {
    try {
      plain = base::unzipped(bytes, name, kMostTilesetBytes);
      bytes = plain;
    } catch (const base::InputError& error) {
      findings.error({}, "tiles-json", "the file " + error.problem(), error.hint());
      return result;
    }
  }
  bool tooDeep = false;
  const auto limitDepth = [&](int depth, Json::parse_event_t, Json&) {
    tooDeep |= depth > kDepthLimit;
    return !tooDeep;
  };
  const Json tileset = Json::parse(bytes, limitDepth, false);
  if (!tooDeep && tileset.is_object())
    TilesetChecker(tileset, contents, findings, progress).run();
  else
    findings.error({}, "tiles-json", tooDeep ? "the JSON is nested too deep" : "the file is no JSON object",
                   "write it again");
  return result;
}

ValidationResult validateTileset(const std::filesystem::path& file, const ChosenSchema&,
                                 const base::Progress& progress) {
  const auto folder = file.parent_path();
  return validateTilesetBytes(
      base::readFile(file, kMostTilesetBytes), file.string(),
      [&](const std::string& path) { return base::readFile(folder / path, kMostContentBytes); }, progress);
}

}  // namespace cloudgen::check
