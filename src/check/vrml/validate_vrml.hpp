// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// Validates ClassicVRML (.x3dv) or VRML97 (.wrl), told by the header line, in one pass of constant memory:
/// form, nodes, fields, values, prototypes, and the same rules as for X3D. The schema is not used. Throws
/// InputError if the file cannot be read, InterruptedError on cancel.
ValidationResult validateVrml(const std::filesystem::path& file, const ChosenSchema& schema,
                              const base::Progress& progress);

/// The same for text in memory; relative urls start at `folder`, or are not looked for.
ValidationResult validateVrmlText(std::string_view text, const std::string& name,
                                  const std::filesystem::path& folder = {},
                                  const base::Progress& progress = {});

}  // namespace cloudgen::check
