// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// Validates a runtime pack: its bytes by the verifier of FlatBuffers, then what they mean: indices within their
/// arrays, numbers finite, boxes around what they hold, runs of tiles that share out all clouds, pictures that
/// are PNG, arrays at multiples of 16 bytes. Throws InputError if the file cannot be read.
ValidationResult validatePack(const std::filesystem::path& file, const ChosenSchema& schema,
                              const base::Progress& progress);

/// The same from bytes; `where` names them in findings.
ValidationResult validatePack(std::string_view bytes, const std::string& where);

}  // namespace cloudgen::check
