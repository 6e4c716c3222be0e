// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace cloudgen::check {

// Lines of text. "Component NAME" heads the nodes of a component. An abstract type is
//   NAME : TYPES : FIELDS
// and a node
//   NAME LEVEL VERSION CONTAINER : TYPES : FIELDS
// with the level of its component that it needs, the first version of X3D that has it times ten (20 is VRML97),
// the field it goes to when none is named, the types it derives from, and the fields that it has beyond
// theirs: "TYPE NAME[=TYPES THAT A NODE FIELD TAKES, parted by |][!ACCESS]" parted by ", ". ACCESS is i
// (initializeOnly), > (inputOnly) or < (outputOnly); inputOutput where there is none.

std::string_view abstractTypes();
std::string_view sceneNodes();
std::string_view shapeNodes();
std::string_view worldNodes();

}  // namespace cloudgen::check
