// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "check/rules/field_facts.hpp"
#include "check/text_hash.hpp"

namespace cloudgen::check {

struct Definition;

/// A node while it is open, as the rules see it.
struct NodeRecord {
  const NodeKind* kind = nullptr;  ///< null: not in the table
  std::string type;
  Position where;
  std::string def, use, container;
  std::vector<FieldFacts> facts;
  /// Of the children in one field: how many, and how many points or colours the last of them has (if known).
  struct Children {
    std::string field;
    std::uint64_t count = 0;
    std::optional<std::uint64_t> tuples;
  };
  std::vector<Children> children;
  /// Fields that the document gives to a script, shader or prototype; null: none, or unknown.
  std::shared_ptr<std::vector<FieldKind>> ownFields;

  Definition* definition = nullptr;  ///< what its DEF defined

  /// Empty again, with the memory it has.
  void clear() {
    kind = nullptr, definition = nullptr;
    type.clear(), def.clear(), use.clear(), container.clear();
    facts.clear(), children.clear(), ownFields.reset();
  }
  const Children* in(std::string_view field) const {
    for (const Children& candidate : children)
      if (candidate.field == field) return &candidate;
    return nullptr;
  }
  const FieldFacts* fact(std::string_view field) const {
    for (const FieldFacts& candidate : facts)
      if (candidate.field->name == field) return &candidate;
    return nullptr;
  }
};

/// What a DEF stands for.
struct Definition {
  const std::string* type = nullptr;  ///< null: not known
  const NodeKind* kind = nullptr;
  Position where;
  bool open = true;                     ///< its node is not closed yet
  std::optional<std::uint64_t> tuples;  ///< points or colours in it
  std::shared_ptr<const std::vector<FieldKind>> ownFields;
};

struct MissingUse {
  std::string name, type;
  Position where;
};

struct Route {
  std::string fromNode, fromField, toNode, toField;
  Position where;
};

/// The rules about one finished node: those of checkGeometry, and lod-range, lod-levels, switch-choice,
/// rotation-axis, scale-zero, key-count, key-order, color-count of a background.
void checkNode(const NodeRecord& node, FindingList& findings);

/// The rules about a finished geometry: index-range, index-count, index-triangles, index-face, vertex-count,
/// texcoord-count, normal-count, color-count, grid-height-count.
void checkGeometry(const NodeRecord& node, FindingList& findings);

/// geo-system: what a geoSystem says of the Earth's shape and of its coordinates (ISO/IEC 19775-1, 25.2.2).
void checkGeoSystem(const std::vector<std::string>& strings, Position where, FindingList& findings);

/// The rules about urls: url-missing, url-outside.
class UrlRules {
 public:
  /// `folder` is where relative urls start; if empty, no file is looked for.
  explicit UrlRules(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// `value` is an MFString of alternatives.
  void check(std::string_view value, Position where, FindingList& findings);

 private:
  std::filesystem::path folder_;
  /// Values with nothing to say about: a scene names the same texture a thousand times.
  std::unordered_set<std::string, TextHash, std::equal_to<>> sound_;
};

}  // namespace cloudgen::check
