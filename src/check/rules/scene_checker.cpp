// SPDX-License-Identifier: Apache-2.0
#include "check/rules/scene_checker.hpp"

#include "check/rules/profiles.hpp"

namespace cloudgen::check {
namespace {

constexpr int kVrml97 = 20;

std::string place(Position where) { return fmt::format("line {}", where.line); }

/// Where in the parent the node could go.
std::string containerHint(const NodeKind& parent, const NodeKind& node) {
  for (const FieldKind& field : parent.fields)
    if (field.takesNodes() && node.fits(field) && field.access != Access::InputOnly &&
        field.access != Access::OutputOnly)
      return fmt::format("its containerField here is {}", field.name);
  return fmt::format("{} has no field for it: put it into another node", parent.name);
}

bool mayStandInScene(const NodeKind& kind) {
  return kind.is("X3DChildNode") || kind.is("X3DMetadataObject") || kind.name == "LayerSet";
}

}  // namespace

SceneChecker::SceneChecker(FindingList& findings, std::filesystem::path folder)
    : findings_(findings), urls_(std::move(folder)), components_(componentsOf("Full")) {
  push().type = "Scene";
  scopes_.emplace_back();
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
  NodeRecord& parent = top();
  NodeRecord& node = push();
  node.type = type;
  node.kind = nodeKind(type);
  node.where = where;
  node.container = container;
  placeInParent(node, parent);
  if (node.kind) needComponent(node);
}

NodeRecord& SceneChecker::push() {
  if (depth_ == open_.size()) open_.emplace_back();
  open_[depth_].clear();
  return open_[depth_++];
}

void SceneChecker::placeInParent(NodeRecord& node, NodeRecord& parent) {
  const bool isScene = depth_ == 2;  // the node is open already
  const bool inSet = parent.type == "MetadataSet";
  if (node.container.empty() && node.kind) node.container = inSet ? "value" : node.kind->container;
  if (node.container.empty() && (isScene || (parent.kind && parent.kind->field("children"))))
    node.container = "children";
  std::uint64_t count = 0;
  if (const auto* siblings = parent.in(node.container))
    count = ++parent.children[static_cast<std::size_t>(siblings - parent.children.data())].count;
  else
    parent.children.push_back({node.container, count = 1, {}});
  if (!node.kind) return;
  if (isScene) {
    if (!mayStandInScene(*node.kind))
      findings_.error(node.where, "container-field",
                      fmt::format("{} cannot stand in the scene itself", node.type),
                      "put it into the node that it belongs to");
    else if (node.container != node.kind->container)
      findings_.error(node.where, "container-field",
                      fmt::format("the scene has no field {}", excerpt(node.container)),
                      fmt::format("leave containerField out: it is {}", node.kind->container));
    return;
  }
  if (!parent.kind) return;
  const FieldKind* field = parent.kind->field(node.container);
  if (!field || !field->takesNodes() || !node.kind->fits(*field))
    findings_.error(node.where, "container-field",
                    fmt::format("{} does not take {} as {}", parent.type, node.type, excerpt(node.container)),
                    containerHint(*parent.kind, *node.kind));
  else if (field->access == Access::InputOnly || field->access == Access::OutputOnly)
    findings_.error(node.where, "container-field",
                    fmt::format("{} of {} cannot be given in a file", field->name, parent.type),
                    containerHint(*parent.kind, *node.kind));
  else if (field->type == "SFNode" && count > 1)
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
  NodeRecord& node = top();
  node.def = def;
  auto& names = scopes_.back().names;
  Definition definition;
  if (node.kind)
    definition.type = &node.kind->name;
  else if (!node.type.empty())
    definition.type = &*types_.insert(node.type).first;
  definition.kind = node.kind, definition.where = node.where, definition.ownFields = node.ownFields;
  const auto [found, isNew] = names.add(node.def, definition);
  node.definition = found;
  if (isNew) return;
  const std::string message = fmt::format("the name {} is taken since {}", excerpt(def), place(found->where));
  if (version_ == kVrml97) {
    findings_.warning(where, "def-duplicate", message,
                      "later USEs mean this node; give it a name of its own");
    *found = definition;
  } else {
    node.def.clear();
    node.definition = nullptr;
    findings_.error(where, "def-duplicate", message, "give the node a name of its own");
  }
}

void SceneChecker::use(std::string_view name, Position where) {
  NodeRecord& node = top();
  node.use = name;
  const auto& names = scopes_.back().names;
  const Definition* found = names.find(name);
  if (!found) {
    if (scopes_.back().missing.size() < FindingList::kLimit)
      scopes_.back().missing.push_back({std::string(name), node.type, where});
  } else if (found->open && node.def != name) {
    findings_.error(where, "use-cycle", fmt::format("{} contains itself", excerpt(name)),
                    "a node cannot be used within itself");
  } else if (found->type && *found->type != node.type) {
    findings_.error(
        where, "use-type",
        fmt::format("{} is a {} ({}), not a {}", excerpt(name), *found->type, place(found->where), node.type),
        "USE the name of a node of the same type");
  }
}

void SceneChecker::field(std::string_view name, std::string_view value, Position where) {
  NodeRecord& node = top();
  const FieldKind* kind = currentField(name);
  if (!kind || kind->takesNodes()) return;
  if (node.kind) node.facts.push_back(readField(*kind, value, where, findings_));
  if (kind->type != "MFString" || (node.kind && !node.facts.back().readable)) return;
  const bool isUrl = name == "url" || name.ends_with("Url");
  if (!isUrl && name != "geoSystem") return;
  const bool holdsScript = node.kind && node.kind->isOpen;  // in place of an address
  if (isUrl && !holdsScript) urls_.check(value, where, findings_);
  if (isUrl) return;
  std::vector<std::string> strings;
  splitStrings(value, strings);
  checkGeoSystem(strings, where, findings_);
}

void SceneChecker::end() {
  const NodeRecord& node = top();
  pop();  // its memory stays until the next begins
  const auto& names = scopes_.back().names;
  std::optional<std::uint64_t> tuples;
  if (node.kind && !node.kind->tuplesField.empty()) {
    const FieldFacts* facts = node.fact(node.kind->tuplesField);
    if (!facts || facts->readable) tuples = facts ? facts->tuples : 0;
  }
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
    const Definition* found = names.find(node.use);
    tuples = !found ? std::nullopt : found->tuples;
  } else if (node.kind) {
    checkNode(node, findings_);
  }
  if (node.definition) {
    node.definition->open = false;
    node.definition->tuples = tuples;
    node.definition->ownFields = node.ownFields;
  }
  for (NodeRecord::Children& siblings : top().children)
    if (siblings.field == node.container) siblings.tuples = tuples;
}

void SceneChecker::foreignName(std::string_view name) {
  scopes_.back().names.add(name, Definition{nullptr, nullptr, {}, false, {}, nullptr});
}

std::string SceneChecker::typeOf(std::string_view name) const {
  const Definition* found = scopes_.back().names.find(name);
  return found && found->type ? *found->type : std::string();
}

const FieldKind* SceneChecker::currentField(std::string_view name) const {
  const NodeRecord& node = top();
  if (const FieldKind* field = node.kind ? node.kind->field(name) : nullptr) return field;
  if (node.ownFields)
    for (const FieldKind& field : *node.ownFields)
      if (field.name == name) return &field;
  return nullptr;
}

void SceneChecker::beginBody() {
  scopes_.emplace_back();
  beginAnything();
}

void SceneChecker::endBody() {
  endAnything();
  resolve(scopes_.back());
  scopes_.pop_back();
}

void SceneChecker::prototype(std::string_view name) {
  declared_ = std::make_shared<std::vector<FieldKind>>();
  scopes_.back().prototypes[std::string(name)] = declared_;
}

void SceneChecker::interfaceField(FieldKind field) {
  if (declared_) declared_->push_back(std::move(field));
}

SceneChecker::Fields SceneChecker::fieldsOf(std::string_view prototype) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
    if (const auto found = scope->prototypes.find(prototype); found != scope->prototypes.end())
      return found->second;
  return nullptr;
}

void SceneChecker::instanceOf(std::string_view prototype, Position where) {
  top().ownFields = fieldsOf(prototype);
  if (!top().ownFields)
    findings_.error(where, "proto-missing", fmt::format("there is no prototype named {}", excerpt(prototype)),
                    "declare it before it is used; upper and lower case count");
}

void SceneChecker::ownField(FieldKind field) {
  auto& fields = top().ownFields;
  if (!fields) fields = std::make_shared<std::vector<FieldKind>>();
  fields->push_back(std::move(field));
}

void SceneChecker::finish() {
  resolve(scopes_.back());
  findings_.sort();
}

void SceneChecker::resolve(const Scope& scope) {
  for (const MissingUse& use : scope.missing) {
    const Definition* later = scope.names.find(use.name);
    if (!later)
      findings_.error(use.where, "use-missing", fmt::format("there is no node named {}", excerpt(use.name)),
                      "DEF the node before it is used; upper and lower case count");
    else
      findings_.error(
          use.where, "use-forward",
          fmt::format("{} is used before it is defined ({})", excerpt(use.name), place(later->where)),
          "define the node at its first use");
  }
  for (const Route& route : scope.routes) checkRoute(route, scope);
}

}  // namespace cloudgen::check
