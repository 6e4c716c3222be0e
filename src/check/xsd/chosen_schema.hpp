// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "check/xsd/xml_parser.hpp"

namespace cloudgen::check {

/// The schema that .x3d files are checked against, compiled when the first of them comes.
class ChosenSchema {
 public:
  /// cloudgen's own profile of X3D 4.0.
  ChosenSchema() = default;
  ChosenSchema(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws InputError if the file is missing or is no schema.
  const XmlSchema& compiled() const;

 private:
  std::optional<std::filesystem::path> file_;
  mutable std::optional<XmlSchema> schema_;
};

}  // namespace cloudgen::check
