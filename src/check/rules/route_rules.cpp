// SPDX-License-Identifier: Apache-2.0
#include <tuple>

#include "check/rules/scene_checker.hpp"

namespace cloudgen::check {
namespace {

const FieldKind* fieldIn(const std::vector<FieldKind>& fields, std::string_view name) {
  for (const FieldKind& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

/// The field that a route's end names: "x", "set_x" or "x_changed" for an inputOutput field x.
const FieldKind* routedField(const std::vector<FieldKind>& fields, std::string_view name, bool isSource) {
  if (const FieldKind* exact = fieldIn(fields, name)) return exact;
  constexpr std::string_view kSet = "set_", kChanged = "_changed";
  if (isSource ? !name.ends_with(kChanged) : !name.starts_with(kSet)) return nullptr;
  const FieldKind* plain =
      fieldIn(fields, isSource ? name.substr(0, name.size() - kChanged.size()) : name.substr(kSet.size()));
  return plain && plain->access == Access::InputOutput ? plain : nullptr;
}

const FieldKind* routedField(const Definition& node, std::string_view name, bool isSource) {
  const FieldKind* field = node.kind ? routedField(node.kind->fields, name, isSource) : nullptr;
  return field || !node.ownFields ? field : routedField(*node.ownFields, name, isSource);
}

bool isBefore(Position a, Position b) { return std::tie(a.line, a.column) < std::tie(b.line, b.column); }

}  // namespace

void SceneChecker::route(Route route) {
  Scope& scope = scopes_.back();
  const bool isDecided = scope.names.find(route.fromNode) && scope.names.find(route.toNode);
  if (isDecided)
    checkRoute(route, scope);
  else if (scope.routes.size() < FindingList::kLimit)
    scope.routes.push_back(std::move(route));
}

void SceneChecker::checkRoute(const Route& route, const Scope& scope) {
  const FieldKind* from = checkRouteEnd(route, true, scope);
  const FieldKind* to = checkRouteEnd(route, false, scope);
  if (from && to && from->type != to->type)
    findings_.error(route.where, "route-type",
                    fmt::format("{}.{} is an {}, {}.{} an {}", route.fromNode, route.fromField, from->type,
                                route.toNode, route.toField, to->type),
                    "both ends of a route have the same type");
}

/// The field at one end of a route, or null where nothing more can be said.
const FieldKind* SceneChecker::checkRouteEnd(const Route& route, bool isSource, const Scope& scope) {
  const std::string& name = isSource ? route.fromNode : route.toNode;
  const std::string& field = isSource ? route.fromField : route.toField;
  const Definition* found = scope.names.find(name);
  if (!found) {
    findings_.error(route.where, "route-node", fmt::format("there is no node named {}", excerpt(name)),
                    "routes join nodes that have a DEF");
    return nullptr;
  }
  const Definition& node = *found;
  if (isBefore(route.where, node.where))
    findings_.error(route.where, "route-forward",
                    fmt::format("{} is defined after the route (line {})", excerpt(name), node.where.line),
                    "move the ROUTE behind both nodes");
  if (!node.kind && !node.ownFields) return nullptr;
  const FieldKind* kind = routedField(node, field, isSource);
  if (!kind) {
    findings_.error(route.where, "route-field",
                    fmt::format("{} {} has no field {}", node.type ? *node.type : "the node", excerpt(name),
                                excerpt(field)),
                    "see the fields of the node in the specification");
    return nullptr;
  }
  if (kind->access != Access::InputOutput &&
      kind->access != (isSource ? Access::OutputOnly : Access::InputOnly))
    findings_.error(
        route.where, "route-access",
        fmt::format("{}.{} {}", name, excerpt(field), isSource ? "sends no events" : "takes no events"),
        isSource ? "route from an outputOnly or inputOutput field"
                 : "route to an inputOnly or inputOutput field");
  return kind;
}

}  // namespace cloudgen::check
