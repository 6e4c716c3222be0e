// SPDX-License-Identifier: Apache-2.0
#include "cli/verification.hpp"

#include "base/error.hpp"
#include "cli/fidelity_maps.hpp"
#include "cli/fidelity_report.hpp"

namespace cloudgen::cli {

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
  if (seconds != 0)
    throw base::InputError(folder.string(), "moves, but its " + chosen + " stands still at the first time",
                           "read the pack (--format pack), or compare with the first time");
  if (chosen == "x3d") return check::readX3dScene(x3d, progress);
  if (chosen == "glb") return check::readGlbScene(glb);
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
