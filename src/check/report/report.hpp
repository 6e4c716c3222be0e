// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "check/validation.hpp"

namespace cloudgen::check {

/// A file and what was found in it.
struct CheckedFile {
  std::string file;
  ValidationResult result;
  bool unreadable = false;  ///< it could not be opened, or is of no known kind
};

struct Totals {
  std::size_t files = 0, invalid = 0, errors = 0, warnings = 0;
};

Totals totalsOf(std::span<const CheckedFile> files);

/// One object, as schemas/validate.schema.json says. Text that is no UTF-8 is replaced.
std::string jsonReport(std::span<const CheckedFile> files);

/// JUnit XML as CI servers read it: a test case a file, one failure with every error of it.
std::string junitReport(std::span<const CheckedFile> files);

/// A log in SARIF 2.1.0 (OASIS), as code hosts read it: a result a finding. `version` is cloudgen's.
std::string sarifReport(std::span<const CheckedFile> files, std::string_view version);

}  // namespace cloudgen::check
