// SPDX-License-Identifier: Apache-2.0
#include "check/rules/node_table.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "check/rules/nodes/node_lists.hpp"

namespace cloudgen::check {
namespace {

/// Cuts the piece before the mark off the front of a text.
std::string_view cut(std::string_view& text, std::string_view mark) {
  const std::size_t end = std::min(text.find(mark), text.size());
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + mark.size()));
  return piece;
}

Access accessOf(char letter) {
  switch (letter) {
    case 'i':
      return Access::InitializeOnly;
    case '>':
      return Access::InputOnly;
    case '<':
      return Access::OutputOnly;
    default:
      return Access::InputOutput;
  }
}

FieldKind fieldFrom(std::string_view entry) {
  FieldKind field;
  field.type = cut(entry, " ");
  if (const auto mark = entry.find('!'); mark != entry.npos)
    field.access = accessOf(entry[mark + 1]), entry = entry.substr(0, mark);
  field.name = cut(entry, "=");
  while (!entry.empty()) field.accepts.emplace_back(cut(entry, "|"));
  return field;
}

/// What a type has beyond those that it derives from.
struct Type {
  std::vector<std::string_view> bases;
  std::string_view fields;
};

std::string tuplesFieldOf(const NodeKind& node) {
  if (node.is("X3DColorNode")) return "color";
  if (node.is("X3DNormalNode")) return "vector";
  const bool hasPoints = node.is("X3DCoordinateNode") || node.name.starts_with("TextureCoordinate");
  return hasPoints && node.field("point") ? "point" : "";
}

class Lists {
 public:
  Lists() {
    for (std::string_view text = abstractTypes(); !text.empty();) {
      std::string_view line = cut(text, "\n");
      const std::string_view name = cut(line, " : ");
      types_[name] = typeFrom(line);
    }
    for (std::string_view text : {sceneNodes(), shapeNodes(), worldNodes()}) readNodes(text);
  }

  std::vector<NodeKind> take() { return std::move(nodes_); }

 private:
  static Type typeFrom(std::string_view line) {
    Type type;
    std::string_view bases = line.starts_with(":") ? std::string_view() : cut(line, " :");
    while (!bases.empty()) type.bases.push_back(cut(bases, " "));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(": ")));
    type.fields = line;
    return type;
  }

  void readNodes(std::string_view text) {
    std::string_view component;
    while (!text.empty()) {
      std::string_view line = cut(text, "\n");
      const std::string_view name = cut(line, " ");
      if (name == "Component") {
        component = line;
        continue;
      }
      NodeKind node;
      node.name = name, node.component = component;
      node.level = std::stoi(std::string(cut(line, " ")));
      node.version = std::stoi(std::string(cut(line, " ")));
      node.container = cut(line, " : ");
      derive(node, name, typeFrom(line));
      node.tuplesField = tuplesFieldOf(node);
      node.isGeometry = node.is("X3DGeometryNode");
      node.isBackground = node.is("X3DBackgroundNode");
      node.hasKeys = node.field("key") && node.field("keyValue");
      node.isOpen = node.is("X3DScriptNode") || node.is("X3DProgrammableShaderObject");
      nodes_.push_back(std::move(node));
    }
  }

  void derive(NodeKind& node, std::string_view name, const Type& type) {
    if (node.is(name)) return;
    node.types.emplace_back(name);
    for (std::string_view fields = type.fields; !fields.empty();) {
      FieldKind field = fieldFrom(cut(fields, ", "));
      if (!node.field(field.name)) node.fields.push_back(std::move(field));
    }
    for (const std::string_view base : type.bases) derive(node, base, types_.at(base));
  }

  std::map<std::string_view, Type> types_;
  std::vector<NodeKind> nodes_;
};

}  // namespace

const FieldKind* NodeKind::field(std::string_view wanted) const {
  for (const FieldKind& candidate : fields)
    if (candidate.name == wanted) return &candidate;
  return nullptr;
}

bool NodeKind::is(std::string_view type) const {
  return std::find(types.begin(), types.end(), type) != types.end();
}

bool NodeKind::fits(const FieldKind& field) const {
  return std::any_of(field.accepts.begin(), field.accepts.end(),
                     [&](const std::string& type) { return is(type); });
}

std::span<const NodeKind> nodeKinds() {
  static const std::vector<NodeKind> nodes = Lists().take();
  return nodes;
}

const NodeKind* nodeKind(std::string_view name) {
  static const auto byName = [] {
    std::unordered_map<std::string_view, const NodeKind*> index;
    for (const NodeKind& node : nodeKinds()) index.emplace(node.name, &node);
    return index;
  }();
  const auto found = byName.find(name);
  return found == byName.end() ? nullptr : found->second;
}

int tupleSize(std::string_view type) {
  const std::string_view value = type.substr(std::min<std::size_t>(2, type.size()));
  if (value == "Float" || value == "Double" || value == "Time" || value == "Int32") return 1;
  if (value == "Vec2f" || value == "Vec2d") return 2;
  if (value == "Vec3f" || value == "Vec3d" || value == "Color") return 3;
  if (value == "Rotation" || value == "ColorRGBA" || value == "Vec4f" || value == "Vec4d") return 4;
  if (value == "Matrix3f" || value == "Matrix3d") return 9;
  if (value == "Matrix4f" || value == "Matrix4d") return 16;
  return 0;
}

}  // namespace cloudgen::check
