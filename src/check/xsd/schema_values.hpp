// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "check/xsd/pattern.hpp"

namespace cloudgen::check {

/// For each element of a schema, the attributes whose type is text under one pattern: lists of numbers, in X3D.
/// libxml2 tries such a pattern with a stack of choices; here it is an automaton. A value that it accepts can be
/// shown to libxml2 as any other text that the pattern accepts: the verdict is the same.
class SchemaValues {
 public:
  using Attributes = std::map<std::string, std::shared_ptr<const Pattern>, std::less<>>;

  SchemaValues() = default;
  /// Reads what a schema and its includes say. Empty where that is not plain enough to be sure of: parts of the
  /// schema that are imported or redefined, keys, elements of one name and two types, types derived by restriction.
  explicit SchemaValues(const std::filesystem::path& schema);

  /// The attributes of an element, or null.
  const Attributes* of(std::string_view element) const;

 private:
  std::map<std::string, Attributes, std::less<>> elements_;
};

}  // namespace cloudgen::check
