// SPDX-License-Identifier: Apache-2.0
#include "cli/verification.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/time.hpp"
#include "check/tiles3d/content_path.hpp"
#include "cli/fidelity_maps.hpp"
#include "cli/fidelity_report.hpp"

namespace cloudgen::cli {
namespace {

/// The tileset of a time, as the first of a sky that moves names it.
std::filesystem::path tilesetAt(const std::filesystem::path& first, double seconds) {
  const auto tileset = nlohmann::json::parse(base::readFile(first), nullptr, false);
  if (!tileset.is_object()) throw base::InputError(first.string(), "is no JSON object", "is it a tileset of cloudgen?");
  const auto times = tileset.value(nlohmann::json::json_pointer("/asset/extras/times"), nlohmann::json::array());
  std::optional<base::UtcTime> start;
  for (const auto& time : times) {
    const auto valid = base::utcFromIso(time.value("valid_time", ""));
    if (!start) start = valid;
    if (valid && static_cast<double>(valid->seconds - start->seconds) == seconds)
      return first.parent_path() / check::contentPath(time.value("uri", ""));
  }
  throw base::InputError(first.string(), "has no tileset of that time", "name one of its asset.extras.times");
}

}  // namespace

check::WrittenScene readWritten(const std::filesystem::path& folder, const std::string& format,
                                const base::LocalFrame& frame, const base::Progress& progress, double seconds) {
  const auto splats = folder / "scene.splats.glb", x3d = folder / "scene.x3d", glb = folder / "scene.glb",
             pack = folder / "scene.cgpack", tiles = folder / "tileset.json";
  const auto isThere = [](const std::filesystem::path& file) { return std::filesystem::exists(file); };
  const bool hasX3d = isThere(x3d);
  progress.step("verify: read", 0);
  std::string chosen = format;
  if (format == "auto")
    chosen = isThere(pack) ? "pack" : isThere(splats) ? "splats" : hasX3d ? "x3d" : isThere(glb) ? "glb" : "tiles";
  if (format == "auto" && chosen == "tiles" && !isThere(tiles))
    throw base::InputError(folder.string(), "has no scene.cgpack, scene.splats.glb, scene.x3d, scene.glb or tileset.json",
                           "build it with --formats pack, x3d, splats, glb or tiles");
  if (chosen == "pack") return check::readPackScene(pack, seconds);
  if (chosen == "x3d") return check::readX3dScene(x3d, progress, seconds);
  if (chosen == "glb") return check::readGlbScene(glb, seconds);
  if (chosen == "tiles" && seconds != 0) return check::readTileScene(tilesetAt(tiles, seconds), frame, progress);
  if (seconds != 0)
    throw base::InputError(folder.string(), "moves, but its " + chosen + " stands still at the first time",
                           "read the pack (--format pack), or compare with the first time");
  if (chosen == "ply") return check::readPlyScene(folder / "scene.splats.ply");
  check::WrittenScene scene =
      chosen == "tiles" ? check::readTileScene(tiles, frame, progress) : check::readSplatScene(splats);
  if (format == "auto" && hasX3d) scene.clouds = check::readX3dScene(x3d, progress).clouds;
  return scene;
}

nlohmann::ordered_json verifyWritten(const std::filesystem::path& folder, const base::LocalFrame& frame,
                                     double groundMeters, const field::Source& model,
                                     const field::Source* typing, const base::Progress& progress) {
  const check::Tolerances tolerances;
  check::WrittenScene scene = readWritten(folder, "auto", frame, progress);
  scene.groundMeters = groundMeters;
  const check::Fidelity fidelity = check::compareWithModel(scene, frame, model, typing, tolerances, progress);
  std::filesystem::create_directory(folder / "verify");
  writeFidelityMaps(fidelity, model.grid(), frame.box(), folder / "verify");
  return fidelityJson(fidelity, tolerances);
}

}  // namespace cloudgen::cli
