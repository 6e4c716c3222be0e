// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "check/rules/field_facts.hpp"
#include "check/rules/node_record.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// The rules between the parts of a scene that no schema can state, for any encoding (XML, ClassicVRML,
/// VRML97). A reader of the encoding calls begin, name, field and end in the order of the file; nothing but
/// names and counts is kept.
class SceneChecker {
 public:
  /// `folder` is where relative urls start; if empty, no file is looked for.
  SceneChecker(FindingList& findings, std::filesystem::path folder);

  /// The X3D statement: version times ten (33, 40; 20 is VRML97, which has no profiles) and profile.
  void document(int version, std::string_view profile, Position where);
  void component(std::string_view name, int level);

  /// A node begins. `container` is the field of the parent that it is written into; empty if the encoding
  /// leaves it open.
  void begin(std::string_view type, Position where, std::string_view container);
  void define(std::string_view def, Position where);
  void use(std::string_view name, Position where);
  void field(std::string_view name, std::string_view value, Position where);
  void end();

  void route(Route route) { scopes_.back().routes.push_back(std::move(route)); }
  /// A name that something outside of the scene stands behind (IMPORT).
  void foreignName(std::string_view name);
  /// A prototype's body has names of its own.
  void beginScope() { scopes_.emplace_back(); }
  void endScope();

  /// The type of the node of a name defined so far; empty if there is none.
  std::string typeOf(std::string_view name) const;
  /// The kind of the node that is open, or null.
  const NodeKind* current() const { return open_.back().kind; }
  /// After the last node: what needs the whole scene.
  void finish();

 private:
  struct Scope {
    std::map<std::string, Definition, std::less<>> names;
    std::vector<MissingUse> missing;
    std::vector<Route> routes;
  };

  void placeInParent(NodeRecord& node);
  void needComponent(const NodeRecord& node);
  void resolve(const Scope& scope);
  void checkRoute(const Route& route, const Scope& scope);

  FindingList& findings_;
  std::filesystem::path folder_;
  int version_ = 40;
  std::map<std::string, int, std::less<>> components_;
  std::vector<NodeRecord> open_;  ///< the first stands for the scene itself
  std::vector<Scope> scopes_;
};

}  // namespace cloudgen::check
