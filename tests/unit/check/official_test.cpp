// SPDX-License-Identifier: Apache-2.0
// Features of X3D that cloudgen does not write: read under the official schema, right ones without a word,
// wrong ones on their line.
#include <algorithm>

#include "base/file.hpp"
#include "check/rules/node_table.hpp"
#include "check/xsd/validate_x3d.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

ValidationResult validated(const std::string& scene, const std::string& head = "") {
  return validateX3dText("<X3D profile='Full' version='4.0'>" + head + "<Scene>\n" + scene + "</Scene></X3D>",
                         "scene.x3d", officialSchema());
}

const std::vector<std::pair<std::string, std::string>> kGood{
    {"a prototype and its instance", R"(<ProtoDeclare name='Tint'>
<ProtoInterface><field name='shade' type='SFColor' accessType='inputOutput' value='1 0 0'/></ProtoInterface>
<ProtoBody><Material><IS><connect nodeField='diffuseColor' protoField='shade'/></IS></Material></ProtoBody></ProtoDeclare>
<Shape><Appearance><ProtoInstance DEF='Red' name='Tint' containerField='material'><fieldValue name='shade' value='0 1 0'/></ProtoInstance></Appearance><Box/></Shape>
<ColorInterpolator DEF='Fade' key='0 1' keyValue='0 0 0 1 1 1'/>
<ROUTE fromNode='Fade' fromField='value_changed' toNode='Red' toField='set_shade'/>)"},
    {"a prototype from elsewhere",
     R"(<ExternProtoDeclare name='Far' url='"far.x3d#Far"'><field name='size' type='SFFloat' accessType='inputOutput'/></ExternProtoDeclare>
<ProtoInstance name='Far'/>)"},
    {"a script with fields of its own",
     R"(<Script DEF='Count'><field name='tick' type='SFTime' accessType='inputOnly'/>
<field name='shape' type='SFNode' accessType='initializeOnly'><Shape><Box/></Shape></field><field name='level' type='SFInt32' accessType='outputOnly'/></Script>
<TimeSensor DEF='Clock'/><Switch DEF='Which'><Group/></Switch>
<ROUTE fromNode='Clock' fromField='cycleTime' toNode='Count' toField='tick'/><ROUTE fromNode='Count' fromField='level' toNode='Which' toField='whichChoice'/>)"},
    {"places on the globe", R"(<GeoViewpoint geoSystem='"GD" "WE"' position='36.6 -122 2000'/>
<GeoLocation geoSystem='"UTM" "Z10" "S"' geoCoords='4053000 600000 0'><GeoOrigin DEF='Here' geoCoords='36.6 -122 0' rotateYUp='true'/><Shape><Sphere/></Shape></GeoLocation>
<GeoLocation geoCoords='36 -121 0'><GeoOrigin USE='Here'/></GeoLocation>)"},
    {"a terrain on the globe",
     R"(<Shape><GeoElevationGrid geoGridOrigin='36 -122 0' xDimension='2' zDimension='2' height='0 1 2 3'/></Shape>)"},
    {"a shader",
     R"(<Shape><Appearance><ComposedShader language='GLSL'><field name='wind' type='SFVec3f' accessType='inputOutput' value='1 0 0'/>
<ShaderPart type='VERTEX' url='"data:text/plain,void main() {}"'/></ComposedShader></Appearance><IndexedTriangleSet index='0 1 2'><Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedTriangleSet></Shape>)"},
    {"fans, strips and lines",
     R"(<Shape><IndexedTriangleFanSet index='0 1 2 3 -1 0 1 2'><Coordinate DEF='C' point='0 0 0 1 0 0 1 1 0 0 1 0'/></IndexedTriangleFanSet></Shape>
<Shape><TriangleStripSet stripCount='4'><Coordinate USE='C'/></TriangleStripSet></Shape><Shape><LineSet vertexCount='2 2'><Coordinate USE='C'/></LineSet></Shape>
<Shape><QuadSet><Coordinate USE='C'/></QuadSet></Shape><Shape><IndexedQuadSet index='0 1 2 3'><Coordinate USE='C'/><Normal vector='0 0 1 0 0 1 0 0 1 0 0 1'/></IndexedQuadSet></Shape>)"},
    {"text and sensors",
     R"(<Shape><Text string='"a" "b"'><FontStyle family='"SANS"'/></Text></Shape><TouchSensor DEF='Touch'/><TimeSensor DEF='Clock'/>
<ROUTE fromNode='Touch' fromField='touchTime' toNode='Clock' toField='startTime'/>)"},
    {"layers", R"(<LayerSet><Layer><Viewport/><Shape><Box/></Shape></Layer></LayerSet>)"},
    {"several textures",
     R"(<Shape><Appearance><MultiTexture mode='"MODULATE"'><PixelTexture image='1 1 1 255'/><PixelTexture image='1 1 1 0xff'/></MultiTexture></Appearance><Box/></Shape>)"},
    {"textures of a material",
     R"(<Shape><Appearance><PhysicalMaterial><PixelTexture containerField='baseTexture' image='0 0 0'/></PhysicalMaterial></Appearance><Sphere/></Shape>)"},
    {"what an Inline hands over",
     R"(<Inline DEF='Tile' url='"tile.x3d"'/><IMPORT inlineDEF='Tile' importedDEF='Turn' AS='TileTurn'/>
<TimeSensor DEF='Clock'/><ROUTE fromNode='Clock' fromField='fraction_changed' toNode='TileTurn' toField='set_fraction'/>)"},
    {"particles and a volume", R"(<ParticleSystem><Appearance/><PointEmitter/></ParticleSystem>
<VolumeData><PixelTexture3D containerField='voxels' image='1 1 1 1 255'/><OpacityMapVolumeStyle/></VolumeData>)"},
    {"followers and sequencers",
     R"(<PositionDamper DEF='Soft'/><Transform DEF='Box'/><BooleanSequencer key='0 1' keyValue='true false'/>
<ROUTE fromNode='Soft' fromField='value_changed' toNode='Box' toField='translation'/>)"},
    {"metadata in metadata",
     R"(<Group><MetadataSet name='a'><MetadataSet name='b' containerField='value'/><MetadataFloat name='c' value='1' containerField='value'/></MetadataSet></Group>)"}};

TEST(Official, WhatIsRightIsAccepted) {
  if (!std::filesystem::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  for (const auto& [what, scene] : kGood) EXPECT_EQ(texts(validated(scene)), "") << what;
}

struct Case {
  std::string what, scene, rule;
  std::uint64_t line;
  std::string word;  ///< of the message
};

const std::vector<Case> kBroken{
    {"a prototype that is not there", "<ProtoInstance name='Puff'/>", "proto-missing", 2, "Puff"},
    {"a route to a field that a prototype lacks",
     "<ProtoDeclare name='P'><ProtoInterface><field name='a' type='SFBool' "
     "accessType='inputOutput'/></ProtoInterface><ProtoBody><Group/></ProtoBody></ProtoDeclare>\n"
     "<ProtoInstance DEF='I' name='P'/><TouchSensor DEF='T'/>\n<ROUTE fromNode='T' fromField='isOver' "
     "toNode='I' toField='b'/>",
     "route-field", 4, "\"b\""},
    {"a route of a wrong type to a script",
     "<Script DEF='S'><field name='a' type='SFTime' accessType='inputOnly'/></Script><TouchSensor "
     "DEF='T'/>\n<ROUTE fromNode='T' fromField='isOver' toNode='S' toField='a'/>",
     "route-type", 3, "SFTime"},
    {"a route out of an event that only comes in",
     "<Script DEF='S'><field name='a' type='SFBool' accessType='inputOnly'/></Script><TouchSensor "
     "DEF='T'/>\n<ROUTE fromNode='S' fromField='a' toNode='T' toField='enabled'/>",
     "route-access", 3, "sends no"},
    {"a name of a prototype's body used outside",
     "<ProtoDeclare name='P'><ProtoBody><Group DEF='In'/></ProtoBody></ProtoDeclare>\n<Group USE='In'/>",
     "use-missing", 3, "In"},
    {"a geoSystem of no frame", "<GeoViewpoint geoSystem='\"XY\" \"WE\"' position='0 0 0'/>", "geo-system", 2,
     "XY"},
    {"a UTM zone that is not there", "<GeoLocation geoSystem='\"UTM\" \"Z61\"' geoCoords='0 0 0'/>",
     "geo-system", 2, "Z61"},
    {"UTM without its zone", "<GeoLocation geoSystem='\"UTM\" \"WE\"' geoCoords='0 0 0'/>", "geo-system", 2,
     "zone"},
    {"an ellipsoid that is not there", "<GeoLocation geoSystem='\"GD\" \"QQ\"' geoCoords='0 0 0'/>",
     "geo-system", 2, "QQ"},
    {"an unquoted geoSystem", "<GeoLocation geoSystem='GD WE' geoCoords='0 0 0'/>", "string-unquoted", 2,
     "quotation"},
    {"too few heights on the globe",
     "<Shape><GeoElevationGrid geoGridOrigin='36 -122 0' xDimension='2' zDimension='2' height='0 1 "
     "2'/></Shape>",
     "grid-height-count", 2, "4 points"},
    {"a fan of two points",
     "<Shape><IndexedTriangleFanSet index='0 1 -1'><Coordinate point='0 0 0 1 1 "
     "1'/></IndexedTriangleFanSet></Shape>",
     "index-face", 2, "2 points"},
    {"a strip without its points",
     "<Shape>\n<TriangleStripSet stripCount='5'><Coordinate point='0 0 0 1 1 1 2 2 2 3 3 "
     "3'/></TriangleStripSet></Shape>",
     "vertex-count", 3, "5 points of 4"},
    {"a strip of two",
     "<Shape><TriangleStripSet stripCount='2'><Coordinate point='0 0 0 1 1 1'/></TriangleStripSet></Shape>",
     "vertex-count", 2, "at least"},
    {"a line of one point", "<Shape><LineSet vertexCount='1'><Coordinate point='0 0 0'/></LineSet></Shape>",
     "vertex-count", 2, "count of 1"},
    {"triangles with a point over",
     "<Shape><TriangleSet><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></TriangleSet></Shape>",
     "vertex-count", 2, "4 points"},
    {"quadrilaterals with an index over",
     "<Shape><IndexedQuadSet index='0 1 2 3 0'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 "
     "0'/></IndexedQuadSet></Shape>",
     "index-triangles", 2, "quadrilaterals"},
    {"too few normals",
     "<Shape><IndexedTriangleSet index='0 1 2'><Coordinate point='0 0 0 1 0 0 0 1 0'/><Normal vector='0 0 "
     "1'/></IndexedTriangleSet></Shape>",
     "normal-count", 2, "normals"},
    {"a normal index out of range",
     "<Shape><IndexedFaceSet coordIndex='0 1 2' normalIndex='0 1 2'><Coordinate point='0 0 0 1 0 0 0 1 "
     "0'/><Normal vector='0 0 1'/></IndexedFaceSet></Shape>",
     "index-range", 2, "normals"},
    {"a skeleton in no field",
     "<HAnimHumanoid name='a' version='2.0'>\n<HAnimJoint name='b' "
     "containerField='children'/></HAnimHumanoid>",
     "container-field", 3, "containerField"},
    {"a collision's proxy twice",
     "<Collision>\n<Shape containerField='proxy'/>\n<Shape containerField='proxy'/></Collision>",
     "node-twice", 4, "proxy"},
    {"children given to an event", "<Group>\n<Shape containerField='addChildren'/></Group>",
     "container-field", 3, "addChildren"},
    {"a sequence with a value over", "<IntegerSequencer key='0 1' keyValue='1 2 3'/>", "key-count", 2,
     "3 values"},
    {"a joint turned about no axis",
     "<HAnimHumanoid name='a' version='2.0'><HAnimJoint name='b' containerField='skeleton'\nrotation='0 0 0 "
     "1'/></HAnimHumanoid>",
     "rotation-axis", 3, "rotation"}};

TEST(Official, WhatIsWrongIsFoundOnItsLine) {
  if (!std::filesystem::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  for (const Case& broken : kBroken) {
    const ValidationResult result = validated(broken.scene);
    EXPECT_TRUE(std::any_of(result.findings.begin(), result.findings.end(),
                            [&](const Finding& finding) {
                              return finding.rule == broken.rule && finding.line == broken.line &&
                                     (finding.message + finding.hint).find(broken.word) != std::string::npos;
                            }))
        << broken.what << ": expected " << broken.rule << " on line " << broken.line << ", got\n"
        << texts(result);
  }
}

TEST(Official, ProfilesBringTheirComponents) {
  if (!std::filesystem::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  const auto missing = [](const std::string& profile, const std::string& node,
                          const std::string& component = "") {
    const ValidationResult result =
        validateX3dText("<X3D profile='" + profile + "' version='4.0'><head>" + component + "</head><Scene>" +
                            node + "</Scene></X3D>",
                        "scene.x3d", officialSchema());
    return !result.findings.empty() && result.findings[0].rule == "profile-component";
  };
  EXPECT_TRUE(missing("Immersive", "<GeoLocation/>"));
  EXPECT_FALSE(missing("Immersive", "<GeoLocation/>", "<component name='Geospatial' level='1'/>"));
  EXPECT_TRUE(missing("Immersive", "<GeoTransform/>", "<component name='Geospatial' level='1'/>"));
  EXPECT_TRUE(missing("Interchange", "<Script/>"));
  EXPECT_FALSE(missing("Immersive", "<Script/>"));
  EXPECT_TRUE(missing("Interactive", "<ParticleSystem/>"));
  EXPECT_TRUE(missing("CADInterchange", "<TimeSensor/>"));
  EXPECT_FALSE(missing("MedicalInterchange", "<VolumeData/>"));
}

/// The text from a place up to the next `end`.
std::string upTo(const std::string& text, std::size_t from, const std::string& end) {
  return text.substr(from, text.find(end, from) - from);
}

TEST(Official, TheListOfNodesIsThatOfTheSchema) {
  if (!std::filesystem::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  const std::string schema = base::readFile(officialSchemaFile());
  const std::string element = "\n    <xs:element name=\"",
                    component = "\"componentName\" type=\"componentNameChoices\" fixed=\"",
                    level = "\"componentLevel\" type=\"xs:positiveInteger\" fixed=\"",
                    container = "\"containerField\" type=\"xs:NMTOKEN\" default=\"";
  std::size_t nodes = 0;
  for (std::size_t at = schema.find(element); at != schema.npos; at = schema.find(element, at + 1)) {
    const std::string name = upTo(schema, at + element.size(), "\""),
                      body = upTo(schema, at, "\n    </xs:element>");
    const NodeKind* kind = nodeKind(name);
    const auto levelAt = body.rfind(level, body.find("</xs:appinfo>\n            <xs:documentation"));
    if (!kind || levelAt == body.npos) continue;
    ++nodes;
    EXPECT_EQ(kind->component, upTo(body, body.rfind(component, levelAt) + component.size(), "\"")) << name;
    EXPECT_EQ(std::to_string(kind->level), upTo(body, levelAt + level.size(), "\"")) << name;
    const auto where = name.starts_with("Metadata") ? body.npos : body.find(container);
    if (where == body.npos) continue;
    EXPECT_EQ(kind->container, upTo(body, where + container.size(), "\"")) << name;
  }
  EXPECT_EQ(nodes, nodeKinds().size());
}

}  // namespace
}  // namespace cloudgen::check::test
