// SPDX-License-Identifier: Apache-2.0
#include "unit/check/broken_scenes.hpp"

namespace cloudgen::check::test {
namespace {

const std::string kRoute =
    R"(fromNode="Clock" fromField="fraction_changed" toNode="Drift" toField="set_fraction")";

std::vector<Broken> namesAndRoutes() {
  return {
      {"a name given twice", R"(DEF="Square")", R"(DEF="Corners")", "def-duplicate"},
      {"USE of a name that is nowhere", R"(USE="Puff")", R"(USE="Puf")", "use-missing"},
      {"USE in another case", R"(USE="Puff")", R"(USE="puff")", "use-missing"},
      {"USE before the DEF", R"(<Fog color="0.8 0.85 0.9" visibilityRange="40000"/>)",
       R"(<TimeSensor USE="Clock"/>)", "use-forward"},
      {"USE of a node of another type", R"(<Coordinate USE="Corners"/>)", R"(<Coordinate USE="Square"/>)",
       "use-type"},
      {"DEF and USE on one node", R"(<Appearance USE="Puff"/>)", R"(<Appearance DEF="Other" USE="Puff"/>)",
       "def-with-use"},
      {"USE with a field of its own", R"(<Appearance USE="Puff"/>)",
       R"(<Appearance USE="Puff" alphaMode="MASK"/>)", "use-content"},
      {"a node within itself", R"(<Group bboxSize="1 1 1"/>)", R"(<LOD USE="Cloud"/>)", "use-cycle"},
      {"a route from no node", R"(fromNode="Clock")", R"(fromNode="Clok")", "route-node"},
      {"a route to no node", R"(toNode="Drift")", R"(toNode="Drfit")", "route-node"},
      {"a route from no field", R"(fromField="fraction_changed")", R"(fromField="fraction")", "route-field"},
      {"a route to no field", R"(toField="set_translation")", R"(toField="set_place")", "route-field"},
      {"a route from a field that only takes", R"(fromNode="Drift" fromField="value_changed")",
       R"(fromNode="Drift" fromField="set_fraction")", "route-access"},
      {"a route to a field that only sends", R"(toNode="Drift" toField="set_fraction")",
       R"(toNode="Fade" toField="value_changed")", "route-access"},
      {"a route to a field that never changes", R"(toNode="Corners" toField="point")",
       R"(toNode="Cloud" toField="range")", "route-access"},
      {"a route between two types", R"(toField="set_translation")", R"(toField="set_rotation")",
       "route-type"},
      {"a route before its nodes", R"(<Fog color="0.8 0.85 0.9" visibilityRange="40000"/>)",
       "<ROUTE " + kRoute + "/>", "route-forward"},
  };
}

std::vector<Broken> geometry() {
  return {
      {"an index without a point", R"(index="0 1 2 0 2 3")", R"(index="0 1 2 0 2 4")", "index-range"},
      {"a negative index in triangles", R"(index="0 1 2 0 2 3")", R"(index="0 1 2 -1 2 3")", "index-range"},
      {"an index without any points", R"(<Coordinate DEF="Corners" point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"/>)",
       R"(<!-- -->)", "index-range", -1},
      {"no whole number of triangles", R"(index="0 1 2 0 2 3")", R"(index="0 1 2 0 2")", "index-triangles"},
      {"an index without a point in a face", R"(coordIndex="0 1 2 -1 0 2 3 -1")",
       R"(coordIndex="0 1 2 -1 0 2 9 -1")", "index-range"},
      {"an index below -1", R"(coordIndex="0 1 2 -1 0 2 3 -1")", R"(coordIndex="0 1 2 -1 0 2 -3 -1")",
       "index-range"},
      {"a face of two points", R"(coordIndex="0 1 2 -1 0 2 3 -1")", R"(coordIndex="0 1 2 -1 0 2 -1")",
       "index-face"},
      {"a line of one point", R"(coordIndex="0 1 -1")", R"(coordIndex="0 -1")", "index-face"},
      {"an index without a texture coordinate", R"(texCoordIndex="3 2 1 -1 3 1 0 -1")",
       R"(texCoordIndex="3 2 1 -1 3 1 4 -1")", "index-range"},
      {"texture indices for one face only", R"(texCoordIndex="3 2 1 -1 3 1 0 -1")",
       R"(texCoordIndex="3 2 1 -1")", "index-count"},
      {"too few texture coordinates", R"(DEF="Square" point="0 0 1 0 1 1 0 1")",
       R"(DEF="Square" point="0 0 1 0 1 1")", "texcoord-count", -2},
      {"too few colours", R"(color="1 1 1 0.5 1 1 1 0.5 1 1 1 0.5 1 1 1 0.5")", R"(color="1 1 1 0.5")",
       "color-count", -3},
      {"too few colours of lines", R"(<Color color="1 1 1 0 0 0"/>)", R"(<Color color="1 1 1"/>)",
       "color-count"},
      {"too few heights", R"(height="1 2 3 4 5 6")", R"(height="1 2 3 4 5")", "grid-height-count"},
      {"more sky angles than colours", R"(skyAngle="1.2 1.5708")", R"(skyAngle="1.2 1.5 1.5708")",
       "color-count"},
      {"sky angles out of order", R"(skyAngle="1.2 1.5708")", R"(skyAngle="1.5708 1.2")", "key-order"},
      {"two coordinates in one geometry", R"(<Coordinate USE="Corners"/>)",
       R"(<Coordinate USE="Corners"/><Coordinate USE="Corners"/>)", "node-twice"},
      {"ranges out of order", R"(range="100 1000")", R"(range="1000 100")", "lod-range"},
      {"a negative range", R"(range="100 1000")", R"(range="-100 1000")", "lod-range"},
      {"a level too many", R"(<Group bboxSize="1 1 1"/>)", R"(<Group/><Group/>)", "lod-levels", -21},
      {"a level too few", R"(<Group bboxSize="1 1 1"/>)", R"(<!-- -->)", "lod-levels", -21},
      {"a choice that is not there", R"(whichChoice="0")", R"(whichChoice="1")", "switch-choice"},
      {"a turn about no axis", R"(rotation="0 1 0 0.5")", R"(rotation="0 0 0 0.5")", "rotation-axis"},
      {"a view turned about no axis", R"(orientation="1 0 0 -0.2")", R"(orientation="0 0 0 0")",
       "rotation-axis"},
      {"a key that turns about no axis", R"(keyValue="0 1 0 0 0 1 0 1")", R"(keyValue="0 1 0 0 0 0 0 1")",
       "rotation-axis"},
      {"a scale of zero", R"(scale="1 1 1")", R"(scale="1 0 1")", "scale-zero"},
      {"a value without a key", R"(key="0 1" keyValue="0 0 0 10 0 0")", R"(key="0" keyValue="0 0 0 10 0 0")",
       "key-count"},
      {"points that do not share out among keys", R"(keyValue="0 0 0 1 1 1 2 2 2 3 3 3")",
       R"(keyValue="0 0 0 1 1 1 2 2 2")", "key-count"},
      {"keys out of order", R"(key="0 0.5 1")", R"(key="0 0.5 0.4")", "key-order"},
  };
}

std::vector<Broken> values() {
  return {
      {"a url without quotation marks", R"('"cloud.png"')", R"("cloud.png")", "string-unquoted"},
      {"a type without quotation marks", R"('"FLY" "ANY"')", R"("NONE")", "string-unquoted"},
      {"a quotation mark left open", R"('"one" "two"')", R"('"one" "two')", "string-unquoted"},
      {"a texture that is not there", R"('"cloud.png"')", R"('"Cloud.png"')", "url-missing"},
      {"a tile that is not there", R"('"tiles/0.x3d"')", R"('"tiles/1.x3d"')", "url-missing"},
      {"a number that is none", R"(point="0 0, 1 0, 1 1, 0 1")", R"(point="0 0, 1 0, 1 1, 0 nan")",
       "number-not-finite", 0, true},
      {"an infinite number", R"(translation="1 2 3")", R"(translation="1 2 inf")", "number-not-finite", 0,
       true},
      {"a word for a number", R"(translation="1 2 3")", R"(translation="1 2 three")", "number", 0, true},
      {"two numbers for three", R"(translation="1 2 3")", R"(translation="1 2")", "number-count", 0, true},
      {"a list that is no whole number of points", R"(point="0 0 0 1 1 1")", R"(point="0 0 0 1 1")",
       "number-count", 0, true},
      {"a fraction for an index", R"(coordIndex="0 1 -1")", R"(coordIndex="0 1.5 -1")", "number", 0, true},
      {"a semicolon", R"(keyValue="0 1 0")", R"(keyValue="0; 1; 0")", "number", 0, true},
      {"a word for a truth value", R"(loop="true")", R"(loop="yes")", "boolean", 0, true},
  };
}

std::vector<Broken> structure() {
  return {
      {"a node in the wrong field", "<Shape>", R"(<Shape containerField="proxy">)", "container-field"},
      {"a geometry as an appearance", R"(<IndexedLineSet coordIndex)",
       R"(<IndexedLineSet containerField="appearance" coordIndex)", "container-field"},
      {"a texture under an unlit material without its field", R"(emissiveColor="1 1 1"/>)",
       R"(emissiveColor="1 1 1"><ImageTexture url='"cloud.png"'/></UnlitMaterial>)", "container-field"},
      {"a geometry in the scene", R"(<Fog color="0.8 0.85 0.9" visibilityRange="40000"/>)",
       "<IndexedFaceSet/>", "container-field", 0, true},
      {"a profile too low", R"(profile="Immersive")", R"(profile="Interactive")", "profile-component", 19},
      {"a component too low", R"(<component name="Grouping" level="3"/>)",
       R"(<component name="Grouping" level="2"/>)", "profile-component", 48},
      {"a node newer than the version", R"(version="4.0" xmlns)", R"(version="3.3" xmlns)", "version", 27},
      {"an unknown node", R"(<Group bboxSize="1 1 1"/>)", "<Gruop/>", "schema", 0, true},
      {"an unknown field", R"(<Group bboxSize="1 1 1"/>)", R"(<Group size="1"/>)", "schema", 0, true},
      {"an unknown value", R"(alphaMode="BLEND")", R"(alphaMode="SOFT")", "schema", 0, true},
      {"a colour over one", R"(<Fog color="0.8 0.85 0.9")", R"(<Fog color="0.8 0.85 1.9")", "schema", 0,
       true},
      {"a transparency over one", R"(<Material emissiveColor="1 1 1"/>)", R"(<Material transparency="2"/>)",
       "schema", 0, true},
      {"a negative speed", R"(speed="100")", R"(speed="-1")", "schema", 0, true},
      {"no profile", R"(profile="Immersive" )", "", "schema", 0, true},
      {"an unknown profile", R"(profile="Immersive")", R"(profile="Huge")", "schema", 0, true},
      {"a name with a blank", R"(DEF="Square")", R"(DEF="a square")", "schema", 0, true},
      {"a name that starts with a digit", R"(DEF="Square")", R"(DEF="4")", "schema", 0, true},
      {"a route without its end", R"( toNode="Drift" toField="set_fraction")", "", "schema", 0, true},
      {"text in a node", R"(<Group bboxSize="1 1 1"/>)", "<Group>cloud</Group>", "schema", 0, true},
      {"a second scene", "</Scene>", "</Scene><Scene/>", "schema", 0, true},
      {"a default namespace", R"(<X3D profile)", R"(<X3D xmlns="urn:x" profile)", "schema", 0, true},
      {"a tag left open", R"(<Group bboxSize="1 1 1"/>)", R"(<Group bboxSize="1 1 1">)", "xml-malformed", 1,
       true},
      {"an attribute twice", R"(<Group bboxSize="1 1 1"/>)", R"(<Group id="a" id="b"/>)", "xml-malformed", 0,
       true},
      {"an ampersand alone", R"(description="overview")", R"(description="a & b")", "xml-malformed", 0, true},
      {"an entity that nobody declared", R"(description="overview")", R"(description="&cloud;")",
       "xml-entity"},
      {"bytes that are no UTF-8", R"(description="overview")", "description=\"\xff\xfe\"", "xml-malformed", 0,
       true},
      {"an encoding that is not read", R"(encoding="UTF-8")", R"(encoding="UTF-7")", "xml-encoding"},
      {"an internal subset", R"(4.0.dtd">)", R"(4.0.dtd" [ <!ENTITY a "b"> ]>)", "xml-entity"},
  };
}

}  // namespace

std::vector<Broken> brokenScenes() {
  std::vector<Broken> all;
  for (const auto& part : {namesAndRoutes(), geometry(), values(), structure()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace cloudgen::check::test
