// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::check {

enum class Access { InitializeOnly, InputOnly, OutputOnly, InputOutput };

/// A field of a node by ISO/IEC 19775-1.
struct FieldKind {
  std::string name;
  std::string type;  ///< "SFVec3f", "MFNode" ...
  Access access = Access::InputOutput;
  std::vector<std::string> accepts;  ///< of a node field: a node in it must be one of these types

  bool takesNodes() const { return type == "SFNode" || type == "MFNode"; }
};

/// A node of X3D 4.0, by ISO/IEC 19775-1:2023.
struct NodeKind {
  std::string name;
  std::string component;
  int level = 1;                   ///< of the component
  int version = 33;                ///< first X3D version that has it, times ten; 20 is VRML97
  std::string container;           ///< the field it goes to when none is named
  std::vector<std::string> types;  ///< itself and the abstract types that it derives from
  std::vector<FieldKind> fields;
  std::string tuplesField;  ///< of coordinates, normals and colours: the field that others index
  bool isGeometry = false, isBackground = false, hasKeys = false;
  bool isOpen = false;  ///< a document may give it fields of its own: a script or shader

  const FieldKind* field(std::string_view name) const;
  bool is(std::string_view type) const;
  bool fits(const FieldKind& field) const;
};

/// The node of a name, or null: then nothing is known about it, and nothing of it is checked.
const NodeKind* nodeKind(std::string_view name);

/// All nodes.
std::span<const NodeKind> nodeKinds();

/// Numbers in one value of a field type: 3 for SFVec3f and MFVec3f, 0 where the type holds no numbers.
int tupleSize(std::string_view type);

}  // namespace cloudgen::check
