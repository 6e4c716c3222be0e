// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/validate_vrml.hpp"

#include "check/vrml/vrml_reader.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

ValidationResult validateVrmlText(std::string_view text, const std::string& name, const fs::path& folder,
                                  const base::Progress& progress) {
  ByteSource source(text);
  ValidationResult result;
  FindingList findings(name, result);
  VrmlReader(source, findings, folder, progress).read();
  return result;
}

ValidationResult validateVrml(const fs::path& file, const ChosenSchema&, const base::Progress& progress) {
  ByteSource source(file);
  ValidationResult result;
  FindingList findings(file.string(), result);
  const fs::path folder = file.parent_path();
  VrmlReader(source, findings, folder.empty() ? fs::path(".") : folder, progress).read();
  return result;
}

}  // namespace cloudgen::check
