// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// Checks splats in PLY: ply-header (the properties that splat tools need, as many bytes as it says) and
/// ply-splats (finite numbers, deviations of a size that can be, rotations that are none of no length). The
/// schema is not used. Throws InputError if the file cannot be read, InterruptedError on cancel.
ValidationResult validatePly(const std::filesystem::path& file, const ChosenSchema& schema,
                             const base::Progress& progress);

/// The same for bytes in memory.
ValidationResult validatePlyBytes(std::string_view bytes, const std::string& name,
                                  const base::Progress& progress = {});

}  // namespace cloudgen::check
