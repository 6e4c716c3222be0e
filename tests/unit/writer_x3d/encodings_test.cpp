// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/encodings.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "support/scratch.hpp"

namespace cloudgen::writer {
namespace {

/// A small document with every kind of field, as one encoding writes it.
std::string document(Encoding encoding) {
  const test::Scratch folder;
  const auto file = folder.path() / "node_writer_test.txt";
  const auto nodes = nodeWriter(encoding, file);
  nodes->start({{"title", "a \"b\" <c> & 'd'"}});
  nodes->open("LOD", "children", "Near");
  nodes->numbers("range", std::vector<float>{10, 20}, 1, 1);
  nodes->open("Shape");
  nodes->open("IndexedTriangleSet", "geometry");
  nodes->integers("index", std::vector<std::int32_t>{0, 1, 2});
  nodes->boolean("solid", false);
  nodes->open("Coordinate", "coord");
  nodes->numbers("point", std::vector<float>{0, 0, 0, 1.25f, 0, 0, 0, 1, -0.0f}, 3, 1);
  nodes->close();
  nodes->close();
  nodes->close();
  nodes->open("WorldInfo");
  nodes->strings("info", std::vector<std::string>{"say \"x\"", "back\\slash"});
  nodes->close();
  nodes->close();
  nodes->use("LOD", "children", "Near");
  nodes->finish();
  return base::readFile(file);
}

TEST(Encodings, Xml) {
  EXPECT_EQ(document(Encoding::Xml), R"(<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Immersive" version="4.0">
<head>
<meta name="title" content="a &quot;b&quot; &lt;c&gt; &amp; &apos;d&apos;"/>
</head>
<Scene>
<LOD DEF="Near" range="10 20">
 <Shape>
  <IndexedTriangleSet index="0 1 2" solid="false">
   <Coordinate point="0 0 0, 1.2 0 0, 0 1 0"/>
  </IndexedTriangleSet>
 </Shape>
 <WorldInfo info='"say \&quot;x\&quot;" "back\\slash"'/>
</LOD>
<LOD USE="Near"/>
</Scene>
</X3D>
)");
}

TEST(Encodings, Classic) {
  EXPECT_EQ(document(Encoding::Classic), R"(#X3D V4.0 utf8
PROFILE Immersive
META "title" "a \"b\" <c> & 'd'"

DEF Near LOD { range [10 20]
 children [
 Shape {
  geometry IndexedTriangleSet { index [0 1 2] solid FALSE
   coord Coordinate { point [0 0 0, 1.2 0 0, 0 1 0] } } }
 WorldInfo { info ["say \"x\"", "back\\slash"] } ] }
USE Near
)");
}

TEST(Encodings, Vrml97KeepsTheHeadAsComments) {
  EXPECT_TRUE(document(Encoding::Vrml97).starts_with("#VRML V2.0 utf8\n# title: a \"b\" <c> & 'd'\n"));
}

TEST(Encodings, TextOfAnyBytesStaysUtf8WithoutControlCharacters) {
  EXPECT_EQ(cleanText("a\nb\x01"
                      "c"),
            "a b c");
  EXPECT_EQ(cleanText("\xC3\xA9\xE2\x82\xAC"), "\xC3\xA9\xE2\x82\xAC");
  EXPECT_EQ(cleanText("x\xFF\xC3"), "x??");
}

}  // namespace
}  // namespace cloudgen::writer
