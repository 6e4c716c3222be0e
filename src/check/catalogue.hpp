// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// A kind of file that can be validated, told by its extension.
struct FileKind {
  std::string_view extension;  ///< ".x3d"
  std::string_view description;
  ValidationResult (*validate)(const std::filesystem::path& file,
                               const std::optional<std::filesystem::path>& schema,
                               const base::Progress& progress);
};

/// Every kind, one line each.
std::span<const FileKind> fileKinds();

/// Validates a file as what its extension says. `schema` is for XML files only. Throws InputError if the file
/// is missing, unreadable or of no known kind; what is wrong in the file is a finding.
ValidationResult validateFile(const std::filesystem::path& file,
                              const std::optional<std::filesystem::path>& schema,
                              const base::Progress& progress);

}  // namespace cloudgen::check
