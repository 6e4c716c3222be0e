// SPDX-License-Identifier: Apache-2.0
#include "check/catalogue.hpp"

#include <array>

#include "base/error.hpp"
#include "base/text.hpp"
#include "check/gltf/validate_glb.hpp"
#include "check/pack/validate_pack.hpp"
#include "check/ply/validate_ply.hpp"
#include "check/tiles3d/validate_tileset.hpp"
#include "check/vrml/validate_vrml.hpp"
#include "check/xsd/validate_x3d.hpp"

namespace cloudgen::check {

std::span<const FileKind> fileKinds() {
  static constexpr std::array<FileKind, 7> kKinds{{
      {".x3d", "X3D in XML encoding", validateX3d},
      {".glb", "binary glTF 2.0, Gaussian splats too", validateGlb},
      {".cgpack", "realtime runtime pack", validatePack},
      {".ply", "Gaussian splats in PLY", validatePly},
      {".wrl", "VRML97", validateVrml},
      {"tileset.json", "3D Tiles 1.1, with what it names", validateTileset},
      {".x3dv", "X3D in ClassicVRML encoding", validateVrml},
  }};
  return kKinds;
}

const FileKind* fileKind(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  for (const FileKind& kind : fileKinds()) {
    const std::size_t length = kind.ending.size();
    if (name.size() >= length && base::equalIgnoringCase(name.substr(name.size() - length), kind.ending))
      return &kind;
  }
  return nullptr;
}

std::string knownEndings() {
  std::string known;
  for (const FileKind& kind : fileKinds())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", kind.ending);
  return known;
}

ValidationResult validateFile(const std::filesystem::path& file, const ChosenSchema& schema,
                              const base::Progress& progress) {
  if (const FileKind* kind = fileKind(file)) return kind->validate(file, schema, progress);
  throw base::InputError(file.string(), "is of no kind that can be validated", "known are " + knownEndings());
}

}  // namespace cloudgen::check
