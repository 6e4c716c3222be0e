// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/validate_vrml.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

const std::string kGood = R"vrml(#X3D V4.0 utf8
PROFILE Immersive
META "title" "scene"
WorldInfo { title "sky" info [ "a" "b" ] }
DEF Place Transform {
  translation 1 2 3 rotation 0 1 0 0.5 # turned
  children [
    LOD { range [ 100, 1000 ] children [
      Billboard { axisOfRotation 0 0 0 children Shape {
        appearance DEF Puff Appearance { material Material { } texture ImageTexture { url "cloud.png" } }
        geometry IndexedFaceSet {
          coord DEF Corners Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }
          coordIndex [ 0 1 2 3 -1 ] solid FALSE
        }
      } }
      Shape { appearance USE Puff geometry IndexedTriangleSet { index [ 0 1 2 ] coord USE Corners } }
      Group { }
    ] }
  ]
}
DEF Clock TimeSensor { loop TRUE }
DEF Drift PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 1 0 0 ] }
ROUTE Clock.fraction_changed TO Drift.set_fraction
ROUTE Drift.value_changed TO Place.set_translation
)vrml";

TEST(Vrml, GoodScenesHaveNoFindings) {
  const SceneFolder folder;
  const ValidationResult result = validateVrmlText(kGood, "scene.x3dv", folder.path());
  EXPECT_EQ(texts(result), "");
  EXPECT_EQ(result.nodes, 17u);
  EXPECT_EQ(texts(validateVrmlText("#VRML V2.0 utf8\nLOD { range [ 10 ] level [ Group { } Group { } ] "
                                   "}\nSwitch { choice [ Group { } ] whichChoice 0 }\n",
                                   "a.wrl")),
            "");
}

TEST(Vrml, BrokenScenesAreFoundByRuleAndLine) {
  struct Case {
    std::string from, to, rule;
  };
  const std::vector<Case> cases{
      {"#X3D V4.0 utf8", "X3D", "vrml-header"},
      {"WorldInfo { title", "WorldInof { title", "vrml-node"},
      {"rotation 0 1 0", "rotated 0 1 0", "vrml-field"},
      {"rotation 0 1 0 0.5", "rotation 0 0 0 0.5", "rotation-axis"},
      {"translation 1 2 3", "translation 1 x 3", "number"},
      {"point [ 0 0 0, 1", "point [ 0 0, 1", "number-count"},
      {"coordIndex [ 0 1 2 3 -1 ]", "coordIndex [ 0 1 2 4 -1 ]", "index-range"},
      {"coordIndex [ 0 1 2 3 -1 ]", "coordIndex [ 0 1 2 3 -1 } ", "vrml-syntax"},
      {"index [ 0 1 2 ]", "index [ 0 1 ]", "index-triangles"},
      {"range [ 100, 1000 ]", "range [ 1000, 100 ]", "lod-range"},
      {"USE Puff", "USE Pfuff", "use-missing"},
      {"appearance USE Puff", "appearance USE Corners", "container-field"},
      {"DEF Corners", "DEF Puff", "def-duplicate"},
      {"\"cloud.png\"", "\"absent.png\"", "url-missing"},
      {"url \"cloud.png\"", "url cloud.png", "vrml-syntax"},
      {"loop TRUE", "loop YES", "boolean"},
      {"key [ 0 1 ]", "key [ 0 ]", "key-count"},
      {"Clock.fraction_changed TO", "Clok.fraction_changed TO", "route-node"},
      {"Drift.value_changed TO Place.set_translation", "Drift.value_changed TO Place.set_rotation",
       "route-type"},
      {"PROFILE Immersive", "PROFILE Interchange", "profile-component"},
  };
  const SceneFolder folder;
  for (const Case& broken : cases) {
    const ValidationResult result =
        validateVrmlText(edited(kGood, broken.from, broken.to), "scene.x3dv", folder.path());
    const std::uint64_t line = lineOf(kGood, broken.from) + (broken.rule == "profile-component" ? 6 : 0);
    bool found = false;
    for (const Finding& finding : result.findings)
      found |= finding.rule == broken.rule && finding.line == line;
    EXPECT_TRUE(found) << broken.to << ": expected " << broken.rule << " on line " << line << ", got\n"
                       << texts(result);
  }
}

TEST(Vrml, HostileTextIsRefused) {
  std::string deep = "#X3D V4.0 utf8\nPROFILE Full\n";
  for (int i = 0; i < 100000; ++i) deep += "Group { children ";
  EXPECT_FALSE(validateVrmlText(deep, "deep.x3dv").valid());
  EXPECT_FALSE(validateVrmlText("#X3D V4.0 utf8\nWorldInfo { title \"open", "open.x3dv").valid());
  EXPECT_FALSE(validateVrmlText("#X3D V4.0 utf8\nGroup { ", "open.x3dv").valid());
  EXPECT_FALSE(validateVrmlText("#X3D V4.0 utf8\n}", "close.x3dv").valid());
  EXPECT_FALSE(validateVrmlText("", "empty.wrl").valid());
}

}  // namespace
}  // namespace cloudgen::check::test
