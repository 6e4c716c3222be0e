// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/rules/field_facts.hpp"

namespace cloudgen::check {

/// A node while it is open, as the rules see it.
struct NodeRecord {
  const NodeKind* kind = nullptr;  ///< null: not in the table
  std::string type;
  Position where;
  std::string def, use, container;
  std::vector<FieldFacts> facts;
  /// Of the children in one field: how many, and how many points or colours the last of them has (if known).
  struct Children {
    std::uint64_t count = 0;
    std::optional<std::uint64_t> tuples;
  };
  std::map<std::string, Children, std::less<>> children;

  const FieldFacts* fact(std::string_view field) const {
    for (const FieldFacts& candidate : facts)
      if (candidate.field->name == field) return &candidate;
    return nullptr;
  }
};

/// What a DEF stands for.
struct Definition {
  std::string type;
  const NodeKind* kind = nullptr;
  Position where;
  bool open = true;                     ///< its node is not closed yet
  std::optional<std::uint64_t> tuples;  ///< points or colours in it
};

struct MissingUse {
  std::string name, type;
  Position where;
};

struct Route {
  std::string fromNode, fromField, toNode, toField;
  Position where;
};

/// The rules about one finished node: index-range, index-triangles, index-face, texcoord-count, color-count,
/// lod-range, lod-levels, switch-choice, rotation-axis, scale-zero, key-count, key-order.
void checkNode(const NodeRecord& node, FindingList& findings);

/// The rules about urls: url-missing, url-outside. `strings` are the alternatives of one url field.
void checkUrl(const std::vector<std::string>& strings, Position where, const std::filesystem::path& folder,
              FindingList& findings);

}  // namespace cloudgen::check
