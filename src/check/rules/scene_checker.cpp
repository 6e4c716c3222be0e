// SPDX-License-Identifier: Apache-2.0
#include "check/rules/scene_checker.hpp"

#include <tuple>

#include "check/rules/profiles.hpp"

namespace cloudgen::check {
namespace {

constexpr int kVrml97 = 20;

bool isNodeField(const FieldKind& field) { return field.type == "SFNode" || field.type == "MFNode"; }

std::string place(Position where) { return fmt::format("line {}", where.line); }

/// The field that a route's end names: "x", "set_x" or "x_changed" for an inputOutput field x.
const FieldKind* routedField(const NodeKind& kind, std::string_view name, bool isSource) {
  if (const FieldKind* exact = kind.field(name)) return exact;
  constexpr std::string_view kSet = "set_", kChanged = "_changed";
  if (isSource ? !name.ends_with(kChanged) : !name.starts_with(kSet)) return nullptr;
  const FieldKind* plain =
      kind.field(isSource ? name.substr(0, name.size() - kChanged.size()) : name.substr(kSet.size()));
  return plain && plain->access == Access::InputOutput ? plain : nullptr;
}

}  // namespace

SceneChecker::SceneChecker(FindingList& findings, std::filesystem::path folder)
    : findings_(findings), folder_(std::move(folder)), components_(componentsOf("Full")) {
  open_.emplace_back();
  open_.back().type = "Scene";
  beginScope();
}

void SceneChecker::document(int version, std::string_view profile, Position where) {
  version_ = version;
  components_ = componentsOf(profile);
  open_.front().where = where;
}

void SceneChecker::component(std::string_view name, int level) {
  int& known = components_[std::string(name)];
  known = std::max(known, level);
}

void SceneChecker::begin(std::string_view type, Position where, std::string_view container) {
  ++findings_.result().nodes;
  NodeRecord node;
  node.type = type;
  node.kind = nodeKind(type);
  node.where = where;
  node.container = container;
  placeInParent(node);
  if (node.kind) needComponent(node);
  open_.push_back(std::move(node));
}

void SceneChecker::placeInParent(NodeRecord& node) {
  NodeRecord& parent = open_.back();
  const bool isScene = open_.size() == 1;
  const bool inSet = parent.type == "MetadataSet";
  if (node.container.empty() && node.kind) node.container = inSet ? "value" : node.kind->container;
  if (node.container.empty() && (isScene || (parent.kind && parent.kind->field("children"))))
    node.container = "children";
  auto& children = parent.children[node.container];
  ++children.count;
  if (isScene) {
    if (node.kind && node.kind->role != "child" && node.kind->role != "metadata")
      findings_.error(node.where, "container-field",
                      fmt::format("{} cannot stand in the scene itself", node.type),
                      "put it into the node that it belongs to");
    else if (node.kind && node.container != node.kind->container)
      findings_.error(node.where, "container-field",
                      fmt::format("the scene has no field {}", excerpt(node.container)),
                      fmt::format("leave containerField out: it is {}", node.kind->container));
    return;
  }
  if (!parent.kind || !node.kind) return;
  const FieldKind* field = parent.kind->field(node.container);
  if (!field || !isNodeField(*field) || field->accepts != node.kind->role)
    findings_.error(node.where, "container-field",
                    fmt::format("{} does not take {} as {}", parent.type, node.type, excerpt(node.container)),
                    fmt::format("{} goes to a field {} of its parent", node.type, node.kind->container));
  else if (field->type == "SFNode" && children.count > 1)
    findings_.error(node.where, "node-twice", fmt::format("{} has a second {}", parent.type, node.container),
                    "the field takes one node");
}

void SceneChecker::needComponent(const NodeRecord& node) {
  const NodeKind& kind = *node.kind;
  if (kind.version > version_)
    findings_.error(
        node.where, "version",
        fmt::format("{} is not part of {}", kind.name,
                    version_ == kVrml97 ? "VRML97" : fmt::format("X3D {}.{}", version_ / 10, version_ % 10)),
        fmt::format("it came with X3D {}.{}", kind.version / 10, kind.version % 10));
  if (version_ == kVrml97) return;
  int& level = components_[kind.component];
  if (level >= kind.level) return;
  findings_.error(node.where, "profile-component",
                  fmt::format("{} needs component {} level {}, the document declares level {}", kind.name,
                              kind.component, kind.level, level),
                  fmt::format("add <component name=\"{}\" level=\"{}\"/>, or a higher profile",
                              kind.component, kind.level));
  level = kind.level;  // said once
}

void SceneChecker::define(std::string_view def, Position where) {
  NodeRecord& node = open_.back();
  node.def = def;
  auto& names = scopes_.back().names;
  const auto [found, isNew] =
      names.try_emplace(node.def, Definition{node.type, node.kind, node.where, true, {}});
  if (isNew) return;
  const std::string message =
      fmt::format("the name {} is taken since {}", excerpt(def), place(found->second.where));
  if (version_ == kVrml97) {
    findings_.warning(where, "def-duplicate", message,
                      "later USEs mean this node; give it a name of its own");
    found->second = Definition{node.type, node.kind, node.where, true, {}};
  } else {
    node.def.clear();
    findings_.error(where, "def-duplicate", message, "give the node a name of its own");
  }
}

void SceneChecker::use(std::string_view name, Position where) {
  NodeRecord& node = open_.back();
  node.use = name;
  const auto& names = scopes_.back().names;
  const auto found = names.find(name);
  if (found == names.end()) {
    scopes_.back().missing.push_back({std::string(name), node.type, where});
  } else if (found->second.open && node.def != name) {
    findings_.error(where, "use-cycle", fmt::format("{} contains itself", excerpt(name)),
                    "a node cannot be used within itself");
  } else if (!found->second.type.empty() && found->second.type != node.type) {
    findings_.error(where, "use-type",
                    fmt::format("{} is a {} ({}), not a {}", excerpt(name), found->second.type,
                                place(found->second.where), node.type),
                    "USE the name of a node of the same type");
  }
}

void SceneChecker::field(std::string_view name, std::string_view value, Position where) {
  NodeRecord& node = open_.back();
  const FieldKind* kind = node.kind ? node.kind->field(name) : nullptr;
  if (!kind || isNodeField(*kind)) return;
  node.facts.push_back(readField(*kind, value, where, findings_));
  const bool isUrl = kind->type == "MFString" && (name == "url" || name.ends_with("Url"));
  if (!isUrl || !node.facts.back().readable) return;
  std::vector<std::string> strings;
  splitStrings(value, strings);
  checkUrl(strings, where, folder_, findings_);
}

void SceneChecker::end() {
  const NodeRecord node = std::move(open_.back());
  open_.pop_back();
  auto& names = scopes_.back().names;
  std::optional<std::uint64_t> tuples;
  for (const FieldFacts& facts : node.facts)
    if (facts.field->name == "point" || facts.field->name == "color")
      if (facts.readable) tuples = facts.tuples;
  const bool holdsTuples = node.kind && (node.kind->role == "coord" || node.kind->role == "texCoord" ||
                                         node.kind->role == "color");
  if (holdsTuples && node.facts.empty()) tuples = 0;
  if (!node.use.empty()) {
    if (!node.def.empty())
      findings_.error(
          node.where, "def-with-use",
          fmt::format("the node has both DEF {} and USE {}", excerpt(node.def), excerpt(node.use)),
          "a USE is the node itself: it has no name of its own");
    if (!node.facts.empty() || !node.children.empty())
      findings_.error(node.where, "use-content",
                      fmt::format("USE {} has fields or children of its own", excerpt(node.use)),
                      "a USE shares the whole node: leave them out");
    const auto found = names.find(node.use);
    tuples = found == names.end() ? std::nullopt : found->second.tuples;
  } else if (node.kind) {
    checkNode(node, findings_);
  }
  if (const auto found = names.find(node.def); !node.def.empty() && found != names.end()) {
    found->second.open = false;
    found->second.tuples = tuples;
  }
  open_.back().children[node.container].tuples = tuples;
}

void SceneChecker::foreignName(std::string_view name) {
  scopes_.back().names.try_emplace(std::string(name), Definition{"", nullptr, {}, false, {}});
}

std::string SceneChecker::typeOf(std::string_view name) const {
  const auto found = scopes_.back().names.find(name);
  return found == scopes_.back().names.end() ? std::string() : found->second.type;
}

void SceneChecker::endScope() {
  if (scopes_.size() == 1) return;
  resolve(scopes_.back());
  scopes_.pop_back();
}

void SceneChecker::finish() {
  resolve(scopes_.back());
  findings_.sort();
}

void SceneChecker::resolve(const Scope& scope) {
  for (const MissingUse& use : scope.missing) {
    const auto later = scope.names.find(use.name);
    if (later == scope.names.end())
      findings_.error(use.where, "use-missing", fmt::format("there is no node named {}", excerpt(use.name)),
                      "DEF the node before it is used; upper and lower case count");
    else
      findings_.error(
          use.where, "use-forward",
          fmt::format("{} is used before it is defined ({})", excerpt(use.name), place(later->second.where)),
          "define the node at its first use");
  }
  for (const Route& route : scope.routes) checkRoute(route, scope);
}

void SceneChecker::checkRoute(const Route& route, const Scope& scope) {
  const FieldKind* ends[2] = {nullptr, nullptr};
  for (const bool isSource : {true, false}) {
    const std::string& name = isSource ? route.fromNode : route.toNode;
    const std::string& field = isSource ? route.fromField : route.toField;
    const auto found = scope.names.find(name);
    if (found == scope.names.end()) {
      findings_.error(route.where, "route-node", fmt::format("there is no node named {}", excerpt(name)),
                      "routes join nodes that have a DEF");
      continue;
    }
    const Definition& node = found->second;
    if (std::tie(node.where.line, node.where.column) > std::tie(route.where.line, route.where.column))
      findings_.error(route.where, "route-forward",
                      fmt::format("{} is defined after the route ({})", excerpt(name), place(node.where)),
                      "move the ROUTE behind both nodes");
    if (!node.kind) continue;
    const FieldKind* kind = routedField(*node.kind, field, isSource);
    if (!kind) {
      findings_.error(route.where, "route-field",
                      fmt::format("{} {} has no field {}", node.type, excerpt(name), excerpt(field)),
                      "see the fields of the node in the specification");
      continue;
    }
    if (kind->access != Access::InputOutput &&
        kind->access != (isSource ? Access::OutputOnly : Access::InputOnly))
      findings_.error(route.where, "route-access",
                      fmt::format("{}.{} {}", name, field, isSource ? "sends no events" : "takes no events"),
                      isSource ? "route from an outputOnly or inputOutput field"
                               : "route to an inputOnly or inputOutput field");
    ends[isSource ? 0 : 1] = kind;
  }
  if (ends[0] && ends[1] && ends[0]->type != ends[1]->type)
    findings_.error(route.where, "route-type",
                    fmt::format("{}.{} is an {}, {}.{} an {}", route.fromNode, route.fromField, ends[0]->type,
                                route.toNode, route.toField, ends[1]->type),
                    "both ends of a route have the same type");
}

}  // namespace cloudgen::check
