// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "check/rules/field_facts.hpp"
#include "check/rules/name_table.hpp"
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

  void route(Route route);
  /// A name that something outside of the scene stands behind (IMPORT).
  void foreignName(std::string_view name);

  /// A part begins in which any node may stand: the value of a field that the document itself declares.
  void beginAnything() { push(); }
  void endAnything() { pop(); }
  /// A prototype's body has names of its own, and any node may be its first.
  void beginBody();
  void endBody();
  /// A prototype of this name can be used from now on; interface fields that follow are its own.
  void prototype(std::string_view name);
  void interfaceField(FieldKind field);
  /// The open node is an instance of a prototype.
  void instanceOf(std::string_view prototype, Position where);
  /// The open node, a script or shader, has this field.
  void ownField(FieldKind field);

  /// The type of the node of a name defined so far; empty if there is none.
  std::string typeOf(std::string_view name) const;
  /// The kind of the node that is open, or null.
  const NodeKind* current() const { return top().kind; }
  const FieldKind* currentField(std::string_view name) const;
  bool isPrototype(std::string_view name) const { return fieldsOf(name) != nullptr; }
  /// After the last node: what needs the whole scene.
  void finish();

 private:
  using Fields = std::shared_ptr<std::vector<FieldKind>>;

  struct Scope {
    NameTable<Definition> names;
    std::map<std::string, Fields, std::less<>> prototypes;
    std::vector<MissingUse> missing;
    std::vector<Route> routes;  ///< whose nodes are not there yet
  };

  NodeRecord& push();
  void pop() { --depth_; }
  NodeRecord& top() { return open_[depth_ - 1]; }
  const NodeRecord& top() const { return open_[depth_ - 1]; }
  void placeInParent(NodeRecord& node, NodeRecord& parent);
  void needComponent(const NodeRecord& node);
  Fields fieldsOf(std::string_view prototype) const;
  void resolve(const Scope& scope);
  void checkRoute(const Route& route, const Scope& scope);
  const FieldKind* checkRouteEnd(const Route& route, bool isSource, const Scope& scope);

  FindingList& findings_;
  UrlRules urls_;
  int version_ = 40;
  std::map<std::string, int, std::less<>> components_;
  /// The first stands for the scene itself. Those from depth_ on are closed and keep their memory for the
  /// next.
  std::deque<NodeRecord> open_;
  std::size_t depth_ = 0;
  std::vector<Scope> scopes_;
  std::set<std::string, std::less<>> types_;  ///< of named nodes
  Fields declared_;                           ///< of the prototype whose interface is read
};

}  // namespace cloudgen::check
