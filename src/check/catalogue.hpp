// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// A kind of file that can be validated, told by how its name ends.
struct FileKind {
  std::string_view ending;  ///< ".x3d"; case does not count
  std::string_view description;
  ValidationResult (*validate)(const std::filesystem::path& file, const ChosenSchema& schema,
                               const base::Progress& progress);
};

/// Every kind, one line each.
std::span<const FileKind> fileKinds();

/// The kind of a file by its name, or null.
const FileKind* fileKind(const std::filesystem::path& file);

/// The endings of all kinds, for messages.
std::string knownEndings();

/// Validates a file as what its name says. `schema` is for XML files only. Throws InputError if the file
/// is missing, unreadable or of no known kind; what is wrong in the file is a finding.
ValidationResult validateFile(const std::filesystem::path& file, const ChosenSchema& schema,
                              const base::Progress& progress);

}  // namespace cloudgen::check
