// SPDX-License-Identifier: Apache-2.0
#include "unit/check/good_scene.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace cloudgen::check::test {
namespace fs = std::filesystem;

std::string goodScene() {
  return R"x3d(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE X3D PUBLIC "ISO//Web3D//DTD X3D 4.0//EN" "https://www.web3d.org/specifications/x3d-4.0.dtd">
<X3D profile="Immersive" version="4.0" xmlns:xsd="http://www.w3.org/2001/XMLSchema-instance" xsd:noNamespaceSchemaLocation="https://www.web3d.org/specifications/x3d-4.0.xsd">
  <head>
    <component name="Grouping" level="3"/>
    <unit category="length" name="metres" conversionFactor="1"/>
    <meta name="title" content="scene.x3d"/>
  </head>
  <!-- one cloud -->
  <Scene>
    <WorldInfo title="sky" info='"one" "two"'>
      <MetadataSet name="cloud">
        <MetadataString name="genus" value='"Cu"' containerField="value"/>
        <MetadataDouble name="path" value="0.1 1e-05" containerField="value"/>
        <MetadataFloat name="depth" value="1" containerField="value"/>
        <MetadataInteger name="count" value="1 2" containerField="value"/>
        <MetadataBoolean name="flags" value="true false" containerField="value"/>
      </MetadataSet>
    </WorldInfo>
    <NavigationInfo type='"FLY" "ANY"' visibilityLimit="0" speed="100"/>
    <Background skyAngle="1.2 1.5708" skyColor="0.2 0.4 0.8, 0.5 0.6 0.9, 0.8 0.9 1"/>
    <Fog color="0.8 0.85 0.9" visibilityRange="40000"/>
    <Viewpoint DEF="Overview" position="0 100 500" orientation="1 0 0 -0.2" description="overview"/>
    <DirectionalLight direction="0 -1 0"/>
    <Transform DEF="Place" translation="1 2 3" rotation="0 1 0 0.5" scale="1 1 1">
      <LOD DEF="Cloud" range="100 1000">
        <Billboard axisOfRotation="0 0 0">
          <Shape>
            <Appearance DEF="Puff" alphaMode="BLEND">
              <UnlitMaterial DEF="White" emissiveColor="1 1 1"/>
              <ImageTexture url='"cloud.png"'><TextureProperties boundaryModeS="CLAMP_TO_EDGE" generateMipMaps="true"/></ImageTexture>
            </Appearance>
            <IndexedTriangleSet index="0 1 2 0 2 3" solid="false">
              <Coordinate DEF="Corners" point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"/>
              <TextureCoordinate DEF="Square" point="0 0 1 0 1 1 0 1"/>
              <ColorRGBA color="1 1 1 0.5 1 1 1 0.5 1 1 1 0.5 1 1 1 0.5"/>
            </IndexedTriangleSet>
          </Shape>
        </Billboard>
        <Shape>
          <Appearance USE="Puff"/>
          <IndexedFaceSet coordIndex="0 1 2 -1 0 2 3 -1" texCoordIndex="3 2 1 -1 3 1 0 -1">
            <Coordinate USE="Corners"/>
            <TextureCoordinate point="0 0, 1 0, 1 1, 0 1"/>
          </IndexedFaceSet>
        </Shape>
        <Group bboxSize="1 1 1"/>
      </LOD>
    </Transform>
    <Switch whichChoice="0">
      <Inline url='"tiles/0.x3d"'/>
    </Switch>
    <StaticGroup>
      <Shape>
        <Appearance><Material emissiveColor="1 1 1"/></Appearance>
        <IndexedLineSet coordIndex="0 1 -1"><Coordinate point="0 0 0 1 1 1"/><Color color="1 1 1 0 0 0"/></IndexedLineSet>
      </Shape>
      <Shape>
        <ElevationGrid height="1 2 3 4 5 6" solid="false" xDimension="3" xSpacing="10" zDimension="2" zSpacing="20"><Color color="0 0 0, 0 0 0, 0 0 0, 1 1 1, 1 1 1, 1 1 1"/></ElevationGrid>
      </Shape>
    </StaticGroup>
    <TimeSensor DEF="Clock" cycleInterval="60" loop="true"/>
    <PositionInterpolator DEF="Drift" key="0 1" keyValue="0 0 0 10 0 0"/>
    <OrientationInterpolator DEF="Turn" key="0 1" keyValue="0 1 0 0 0 1 0 1"/>
    <ScalarInterpolator DEF="Fade" key="0 0.5 1" keyValue="0 1 0"/>
    <CoordinateInterpolator DEF="Morph" key="0 1" keyValue="0 0 0 1 1 1 2 2 2 3 3 3"/>
    <ROUTE fromNode="Clock" fromField="fraction_changed" toNode="Drift" toField="set_fraction"/>
    <ROUTE fromNode="Drift" fromField="value_changed" toNode="Place" toField="set_translation"/>
    <ROUTE fromNode="Morph" fromField="value_changed" toNode="Corners" toField="point"/>
  </Scene>
</X3D>
)x3d";
}

std::string edited(std::string scene, std::string_view from, std::string_view to) {
  const std::size_t at = scene.find(from);
  if (at == scene.npos) ADD_FAILURE() << "the scene has no " << from;
  return at == scene.npos ? scene : scene.replace(at, from.size(), to);
}

std::uint64_t lineOf(std::string_view scene, std::string_view piece) {
  const std::string_view before = scene.substr(0, scene.find(piece));
  return 1 + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
}

fs::path profileSchemaFile() { return fs::path(CLOUDGEN_SOURCE_DIR) / "schemas" / "cloudgen-x3d.xsd"; }
fs::path officialSchemaFile() { return fs::path(CLOUDGEN_SHARED_DIR) / "schemas" / "x3d-4.0.xsd"; }

const XmlSchema& profileSchema() {
  static const XmlSchema schema(profileSchemaFile());
  return schema;
}

const XmlSchema& officialSchema() {
  static const XmlSchema schema(officialSchemaFile());
  return schema;
}

SceneFolder::SceneFolder() {
  static int count = 0;
  path_ = fs::temp_directory_path() /
          ("cloudgen-check-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
  fs::create_directories(path_ / "tiles");
  std::ofstream(path_ / "cloud.png") << "pixels";
  std::ofstream(path_ / "tiles" / "0.x3d") << "tile";
}

SceneFolder::~SceneFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::pair<std::string, std::string>> goodScenes() {
  const std::string good = goodScene();
  const auto with = [&](std::string_view from, std::string_view to) { return edited(good, from, to); };
  return {
      {"the good scene", good},
      {"an empty scene", R"(<X3D profile="Interchange" version="4.0"><Scene/></X3D>)"},
      {"no declaration and no DOCTYPE", good.substr(good.find("<X3D"))},
      {"version 3.3 with Material",
       edited(with("version=\"4.0\" xmlns", "version=\"3.3\" xmlns"), "<UnlitMaterial", "<Material")},
      {"a profile made up by components",
       R"(<X3D profile="Interchange" version="4.0"><head><component name="Navigation" level="2"/></head><Scene><Billboard/></Scene></X3D>)"},
      {"commas after tuples", with("point=\"0 0 1 0 1 1 0 1\"", "point=\"0 0, 1 0, 1 1, 0 1\"")},
      {"numbers with exponents and signs", with("translation=\"1 2 3\"", "translation=\"+1.5e3 -.5 0.\"")},
      {"numbers over several lines", with("keyValue=\"0 0 0 10 0 0\"", "keyValue=\"0 0 0\n  10 0 0\"")},
      {"character references",
       with("description=\"overview\"", "description=\"&quot;a&quot; &amp; &#945; &lt;\"")},
      {"an LOD without ranges", with(" range=\"100 1000\"", "")},
      {"the last -1 left out",
       with("texCoordIndex=\"3 2 1 -1 3 1 0 -1\"", "texCoordIndex=\"3 2 1 -1 3 1 0\"")},
      {"several alternatives of a url", with("'\"cloud.png\"'", "'\"absent.png\" \"cloud.png\"'")},
      {"an escaped url", with("'\"cloud.png\"'", "'\"%63loud.png\"'")},
      {"a route to a plain field name", with("toField=\"set_translation\"", "toField=\"translation\"")},
      {"text with a comment and a CDATA section", with("<!-- one cloud -->", "<!-- <Bad> & --><!-- two -->")},
      {"colours of faces",
       with("<TextureCoordinate point=\"0 0, 1 0, 1 1, 0 1\"/>",
            "<TextureCoordinate point=\"0 0, 1 0, 1 1, 0 1\"/><Color color=\"1 0 0 0 1 0 0 0 1 1 1 1\"/>")},
      {"a texture under the material",
       with("<Material emissiveColor=\"1 1 1\"/>",
            "<Material emissiveColor=\"1 1 1\"><ImageTexture containerField=\"emissiveTexture\" "
            "url='\"cloud.png\"'/></Material>")},
  };
}

std::string texts(const ValidationResult& result) {
  std::string all;
  for (const Finding& finding : result.findings) all += text(finding) + "\n";
  return all;
}

}  // namespace cloudgen::check::test
