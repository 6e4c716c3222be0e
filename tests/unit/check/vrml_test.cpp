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

const std::string kPrototypes = R"vrml(#VRML V2.0 utf8
EXTERNPROTO Far [ field SFFloat size eventIn SFBool go ] [ "far.wrl#Far" "urn:far" ]
PROTO Puff [ exposedField SFColor shade 1 1 1 field SFNode look NULL eventOut SFTime done field MFString names [ "a" "b" ] ] {
  Shape { appearance Appearance { material DEF Paint Material { diffuseColor IS shade } } geometry Box { size 1 2 3 } }
  PROTO Inner [ ] { Group { } }
  Inner { }
}
DEF One Puff { shade 0 1 0 look Group { } }
Transform { children [ Far { size 2 }, USE One ROUTE Fade.value_changed TO One.set_shade ] }
DEF Fade ColorInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 1 1 1 ] }
DEF Count Script { url "javascript: function tick() {}" directOutput TRUE
  eventIn SFTime tick field SFInt32 level 3 field SFNode one USE One eventOut SFInt32 out }
DEF Which Switch { whichChoice 0 choice Collision { collide FALSE } }
ROUTE Count.out TO Which.set_whichChoice
ROUTE Fade.value_changed TO One.set_shade
Shape { appearance Appearance { texture PixelTexture { image 2 1 3 0xff0000 0x00ff00 } } }
)vrml";

TEST(Vrml, PrototypesAndScriptsAreRead) {
  // A route may stand before its nodes in VRML97 no more than in X3D.
  const std::string good = edited(kPrototypes, " ROUTE Fade.value_changed TO One.set_shade ]", " ]");
  EXPECT_EQ(texts(validateVrmlText(good, "proto.wrl")), "");
  struct Case {
    std::string from, to, rule;
  };
  for (const Case& broken : {Case{"DEF One Puff", "DEF One Pfuf", "vrml-node"},
                             {"shade 0 1 0 look", "shape 0 1 0 look", "vrml-field"},
                             {"EXTERNPROTO Far", "EXTERNPROTO Near", "vrml-node"},
                             {"field SFFloat size", "field SFFloot size", "vrml-syntax"},
                             {"exposedField SFColor", "exposed SFColor", "vrml-syntax"},
                             {"USE One ]", "USE Paint ]", "use-missing"},
                             {"Count.out TO", "Count.level TO", "route-access"},
                             {"Count.out TO", "Count.tock TO", "route-field"},
                             {"Fade.value_changed TO One.set_shade\nShape",
                              "Fade.value_changed TO One.done\nShape", "route-access"},
                             {"Inner { }\n", "Outer { }\n", "vrml-node"},
                             {"size 1 2 3", "size 1 2", "vrml-syntax"},
                             {"0xff0000 0x00ff00", "0xff0000", "vrml-syntax"},
                             {"shade 0 1 0", "shade IS tint", "vrml-is"},
                             {"key [ 0 1 ]", "set_fraction 1 key [ 0 1 ]", "vrml-field"}}) {
    const ValidationResult result = validateVrmlText(edited(good, broken.from, broken.to), "proto.wrl");
    bool found = false;
    for (const Finding& finding : result.findings) found |= finding.rule == broken.rule && finding.line > 1;
    EXPECT_TRUE(found) << broken.to << ": expected " << broken.rule << ", got\n" << texts(result);
  }
  EXPECT_EQ(validateVrmlText(kPrototypes, "early.wrl").findings[0].rule, "route-forward");
}

TEST(Vrml, GoesOnAfterAnUnknownNode) {
  const ValidationResult result = validateVrmlText(
      "#VRML V2.0 utf8\nGruop { children [ Group { } ] }\nGroup { children DEF A Wrong { } }\nLOD { range [ "
      "2 1 ] }\n",
      "a.wrl");
  ASSERT_EQ(result.findings.size(), 4u) << texts(result);
  EXPECT_EQ(result.findings[0].line, 2u);
  EXPECT_EQ(result.findings[1].rule, "vrml-node");
  EXPECT_EQ(result.findings[1].line, 3u);
  EXPECT_EQ(result.findings[2].line, 4u);
}

TEST(Vrml, PlacesAreRightAcrossChunks) {
  std::string text = "#X3D V4.0 utf8\nPROFILE Full\n# " + std::string(70000, 'c') + "\n";
  for (int i = 0; i < 9000; ++i) text += "Group { # c\n}\n";
  const ValidationResult result = validateVrmlText(text + "  Wrong { }\n", "a.x3dv");
  ASSERT_EQ(result.findings.size(), 1u) << texts(result);
  EXPECT_EQ(result.findings[0].line, 18004u);
  EXPECT_EQ(result.findings[0].column, 3u);
  EXPECT_EQ(result.bytes, text.size() + 12);
}

TEST(Vrml, HostileTextIsRefused) {
  std::string nested = "#VRML V2.0 utf8\n", lists = nested;
  for (int i = 0; i < 100000; ++i)
    nested += "PROTO A [ ] { ", lists += "PROTO A [ field SFNode a Group { children ";
  EXPECT_FALSE(validateVrmlText(nested, "nested.wrl").valid());
  EXPECT_FALSE(validateVrmlText(lists, "nested.wrl").valid());
  EXPECT_EQ(validateVrmlText("#VRML V2.0 utf8\n" + std::string(3 << 20, 'x'), "word.wrl").findings[0].rule,
            "vrml-limit");
  EXPECT_FALSE(
      validateVrmlText("#VRML V2.0 utf8\nWorldInfo { title \"" + std::string(3 << 20, 'x'), "string.wrl")
          .valid());
  std::string points = "#VRML V2.0 utf8\nShape { geometry PointSet { coord Coordinate { point [ ";
  while (points.size() < (20u << 20)) points += "0.125 1000 -3.5, ";
  EXPECT_EQ(validateVrmlText(points + "] } } }", "points.wrl").findings[0].rule, "vrml-limit");
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
