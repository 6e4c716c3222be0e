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
  Access access{};
  std::string accepts;  ///< of a node field: the role that a node in it must have
};

/// A node that cloudgen writes, by ISO/IEC 19775-1.
struct NodeKind {
  std::string name;
  std::string component;
  int level = 1;          ///< of the component
  int version = 33;       ///< first X3D version that has it, times ten; 20 is VRML97
  std::string role;       ///< what it can be: "child", "geometry", "coord" ...
  std::string container;  ///< the field it goes to when none is named
  std::vector<FieldKind> fields;

  const FieldKind* field(std::string_view name) const;
};

/// The node of a name, or null: then nothing is known about it, and nothing of it is checked.
const NodeKind* nodeKind(std::string_view name);

/// All nodes of the table.
std::span<const NodeKind> nodeKinds();

/// Numbers in one value of a field type: 3 for SFVec3f and MFVec3f, 0 where the type holds no numbers.
int tupleSize(std::string_view type);

}  // namespace cloudgen::check
