// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "check/text_hash.hpp"
#include "check/xsd/pattern.hpp"

namespace cloudgen::check {

/// For each element of a schema, the attributes whose type is text under one pattern: lists of numbers, in
/// X3D. libxml2 tries such a pattern with a stack of choices; here it is an automaton. A value that it
/// accepts can be shown to libxml2 as any other text that the pattern accepts: the verdict is the same.
class SchemaValues {
 public:
  /// A pattern that is compiled when it is first asked for; of one type, shared by its attributes.
  class Type {
   public:
    explicit Type(std::string expression) : expression_(std::move(expression)) {}
    /// Null if the expression is not known to Pattern.
    const Pattern* pattern() const;

   private:
    std::string expression_;
    mutable std::optional<std::optional<Pattern>> pattern_;
  };
  struct Attribute {
    std::string name;
    std::shared_ptr<const Type> type;
  };
  using Attributes = std::vector<Attribute>;

  SchemaValues() = default;
  /// Reads what a schema and its includes say. Empty where that is not plain enough to be sure of: parts of
  /// the schema that are imported or redefined, keys, elements of one name and two types, types derived by
  /// restriction.
  explicit SchemaValues(const std::filesystem::path& schema);

  /// The attributes of an element, or null.
  const Attributes* of(std::string_view element) const;

 private:
  std::unordered_map<std::string, Attributes, TextHash, std::equal_to<>> elements_;
};

}  // namespace cloudgen::check
