// SPDX-License-Identifier: Apache-2.0
#include "cli/verification.hpp"

#include "base/error.hpp"
#include "cli/fidelity_maps.hpp"
#include "cli/fidelity_report.hpp"

namespace cloudgen::cli {

check::WrittenScene readWritten(const std::filesystem::path& folder, const std::string& format,
                                const base::Progress& progress) {
  const auto splats = folder / "scene.splats.glb", x3d = folder / "scene.x3d", glb = folder / "scene.glb",
             pack = folder / "scene.cgpack";
  const bool hasSplats = std::filesystem::exists(splats), hasX3d = std::filesystem::exists(x3d);
  progress.step("verify: read", 0);
  std::string chosen = format;
  if (format == "auto") chosen = std::filesystem::exists(pack) ? "pack" : hasSplats ? "splats" : hasX3d ? "x3d" : "glb";
  if (format == "auto" && chosen == "glb" && !std::filesystem::exists(glb))
    throw base::InputError(folder.string(), "has no scene.cgpack, scene.splats.glb, scene.x3d or scene.glb",
                           "build it with --formats pack, x3d, splats or glb");
  if (chosen == "pack") return check::readPackScene(pack);
  if (chosen == "x3d") return check::readX3dScene(x3d, progress);
  if (chosen == "glb") return check::readGlbScene(glb);
  check::WrittenScene scene = check::readSplatScene(splats);
  if (format == "auto" && hasX3d) scene.clouds = check::readX3dScene(x3d, progress).clouds;
  return scene;
}

nlohmann::ordered_json verifyWritten(const std::filesystem::path& folder, const base::LocalFrame& frame,
                                     double groundMeters, const field::Source& model,
                                     const field::Source* typing, const base::Progress& progress) {
  const check::Tolerances tolerances;
  check::WrittenScene scene = readWritten(folder, "auto", progress);
  scene.groundMeters = groundMeters;
  const check::Fidelity fidelity = check::compareWithModel(scene, frame, model, typing, tolerances, progress);
  std::filesystem::create_directory(folder / "verify");
  writeFidelityMaps(fidelity, model.grid(), frame.box(), folder / "verify");
  return fidelityJson(fidelity, tolerances);
}

}  // namespace cloudgen::cli
