// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// A light structural check of binary glTF 2.0: container, JSON, buffer views, accessors, meshes, references,
/// extensions, values of indices and positions. It does not replace the Khronos validator. The schema is not
/// used. Throws InputError if the file cannot be read, InterruptedError on cancel.
ValidationResult validateGlb(const std::filesystem::path& file, const ChosenSchema& schema,
                             const base::Progress& progress);

/// The same for bytes in memory.
ValidationResult validateGlbBytes(std::string_view bytes, const std::string& name,
                                  const base::Progress& progress = {});

}  // namespace cloudgen::check
