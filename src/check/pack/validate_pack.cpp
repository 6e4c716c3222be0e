// SPDX-License-Identifier: Apache-2.0
#include "check/pack/validate_pack.hpp"


#include "base/file.hpp"
#include "check/pack/pack_rules.hpp"

namespace cloudgen::check {

ValidationResult validatePack(const std::filesystem::path& file, const ChosenSchema&,
                              const base::Progress& progress) {
  progress.step("validate", 0);
  return validatePack(base::readFile(file), file.string());
}

ValidationResult validatePack(std::string_view bytes, const std::string& where) {
  ValidationResult result;
  result.bytes = bytes.size();
  FindingList findings(where, result);
  std::string problem;
  const pack::RuntimePack* root = packIn(bytes, problem);
  if (!root) {
    findings.error({}, "pack-bytes", "the file " + problem, "write it again with: cloudgen build --formats pack");
    return result;
  }
  PackRules(*root, bytes.data(), findings).check();
  return result;
}

}  // namespace cloudgen::check
