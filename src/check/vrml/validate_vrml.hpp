// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// Validates ClassicVRML (.x3dv) or VRML97 (.wrl), told by the header line: form, known nodes and fields,
/// values, and the same rules as for X3D. Prototypes are not read. The schema is not used. Throws InputError
/// if the file cannot be read, InterruptedError on cancel.
ValidationResult validateVrml(const std::filesystem::path& file,
                              const std::optional<std::filesystem::path>& schema,
                              const base::Progress& progress);

/// The same for text in memory; relative urls start at `folder`, or are not looked for.
ValidationResult validateVrmlText(std::string_view text, const std::string& name,
                                  const std::filesystem::path& folder = {},
                                  const base::Progress& progress = {});

}  // namespace cloudgen::check
