// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// Validates an X3D file in XML encoding against a schema (our profile,
/// base::dataDir()/schemas/cloudgen-x3d.xsd, if none is given) and the rules that no schema can state, in one
/// pass and constant memory. Opens nothing but the file and the schema. Throws InputError if one of them
/// cannot be read, InterruptedError on cancel; whatever is wrong in the file is a finding.
ValidationResult validateX3d(const std::filesystem::path& file, const ChosenSchema& schema,
                             const base::Progress& progress);

/// The same for a scene in memory. `name` stands in the findings; relative urls start at `folder`, or are not
/// looked for.
ValidationResult validateX3dText(std::string_view text, const std::string& name, const XmlSchema& schema,
                                 const std::filesystem::path& folder = {});

}  // namespace cloudgen::check
