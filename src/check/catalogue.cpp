// SPDX-License-Identifier: Apache-2.0
#include "check/catalogue.hpp"

#include <array>

#include "base/error.hpp"
#include "base/text.hpp"
#include "check/gltf/validate_glb.hpp"
#include "check/vrml/validate_vrml.hpp"
#include "check/xsd/validate_x3d.hpp"

namespace cloudgen::check {

std::span<const FileKind> fileKinds() {
  static constexpr std::array<FileKind, 4> kKinds{{
      {".x3d", "X3D in XML encoding", validateX3d},
      {".glb", "binary glTF 2.0", validateGlb},
      {".wrl", "VRML97", validateVrml},
      {".x3dv", "X3D in ClassicVRML encoding", validateVrml},
  }};
  return kKinds;
}

ValidationResult validateFile(const std::filesystem::path& file,
                              const std::optional<std::filesystem::path>& schema,
                              const base::Progress& progress) {
  const std::string extension = file.extension().string();
  std::string known;
  for (const FileKind& kind : fileKinds()) {
    if (base::equalIgnoringCase(kind.extension, extension)) return kind.validate(file, schema, progress);
    known += known.empty() ? "" : ", ";
    known += kind.extension;
  }
  throw base::InputError(file.string(), "is of no kind that can be validated", "known are " + known);
}

}  // namespace cloudgen::check
