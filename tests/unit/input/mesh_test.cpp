// SPDX-License-Identifier: Apache-2.0
#include "input/mesh/mesh_file.hpp"

#include <fstream>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {
namespace {

using test::Scratch;

std::filesystem::path seed(const std::string& name) {
  return std::filesystem::path(CLOUDGEN_SOURCE_DIR) / "tests" / "fuzz" / "seeds" / "mesh" / name;
}

/// The volume that the triangles bound, positive if they are seen counter-clockwise from outside.
double volumeOf(const base::Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::dot(mesh.points[a], glm::cross(mesh.points[b], mesh.points[c])) / 6;
  return sum;
}

TEST(MeshFile, EveryFormatGivesTheSameTetrahedron) {
  for (const char* name : {"tetra.obj", "tetra.off", "ascii.ply", "little.ply", "big.ply"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(isMeshFile(name));
    const base::Mesh mesh = readMesh(seed(name));
    EXPECT_EQ(mesh.points.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(volumeOf(mesh), 1.0 / 6, 1e-6);
  }
}

TEST(MeshFile, NodesOfGltfPlaceTheirMeshes) {
  for (const char* name : {"tetra.glb", "tetra.gltf"}) {
    SCOPED_TRACE(name);
    const base::Mesh mesh = readMesh(seed(name));
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(volumeOf(mesh), 8.0 / 6, 1e-5);
    // (1,0,0), twice as large, turned by 90 degrees about z, lifted by 1.
    EXPECT_NEAR(glm::distance(mesh.points[1], {0, 3, 0}), 0, 1e-5);
  }
}

TEST(MeshFile, BuffersOfGltfAreReadFromItsFolderOnly) {
  Scratch folder;
  std::string text = base::readFile(seed("tetra.gltf"));
  const auto from = text.find("data:"), to = text.find('"', from);
  text.replace(from, to - from, "../tetra.bin");
  const std::string file = folder.write("a.gltf", text);
  EXPECT_THROW(readMesh(file), base::InputError);
}

TEST(MeshFile, PolygonsBecomeFans) {
  const base::Mesh mesh =
      mesh::readObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 1.5 0\nv 0 1 0\nf 1 2 3 4 5\n", "five.obj");
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

void expectRefused(const std::function<base::Mesh()>& read, const std::string& where,
                   const std::string& saying) {
  try {
    read();
    ADD_FAILURE() << "accepted, should say " << saying;
  } catch (const base::InputError& error) {
    EXPECT_NE(error.where().find(where), std::string::npos) << error.where();
    EXPECT_NE(error.problem().find(saying), std::string::npos) << error.problem();
    EXPECT_FALSE(error.hint().empty());
  }
}

TEST(MeshFile, WhatIsWrongIsNamedWithItsLine) {
  const auto obj = [](const char* text) { return [text] { return mesh::readObj(text, "a.obj"); }; };
  const auto off = [](const char* text) { return [text] { return mesh::readOff(text, "a.off"); }; };
  const auto ply = [](const char* text) { return [text] { return mesh::readPly(text, "a.ply"); }; };
  expectRefused(obj("v 0 0 0\nv 1 x 0\n"), "a.obj, line 2", "three numbers");
  expectRefused(obj("v 0 0 0\nf 1 2 3\n"), "a.obj, line 2", "none of its 1 points");
  expectRefused(obj("v 0 0 0\nf -1 -2 -3\n"), "a.obj, line 2", "none of its 1 points");
  expectRefused(obj("v 1e300 0 0\n"), "line 1", "too far");
  expectRefused(obj("v 0 0 0\nf 1 1\n"), "line 2", "fewer than three");
  expectRefused(obj("hello\n"), "a.obj", "no triangle");
  expectRefused(off("PLY\n"), "a.off", "OFF");
  expectRefused(off("OFF\n4000000000 1 0\n0 0 0\n"), "a.off, line 3", "ends before its last point");
  expectRefused(off("OFF\n1 1 0\n0 0 0\n4000000000 0 0\n"), "line 4", "fewer corners");
  expectRefused(ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n"), "line 4",
                "type");
  expectRefused(ply("ply\nformat ascii 1.0\nelement vertex 3000000000\nproperty float x\nend_header\n0\n"),
                "vertex 1", "ends before");
  expectRefused(ply("ply\nformat ascii 1.0\n"), "a.ply", "header");
  expectRefused([] { return mesh::readGltf("{}", "a.gltf", {}); }, "a.gltf", "glTF 2.0");
  expectRefused([] { return mesh::readGltf("glTF\2", "a.glb", {}); }, "a.glb", "glTF 2.0");
}

TEST(MeshFile, NodesInACircleAreRefused) {
  expectRefused(
      [] {
        return mesh::readGltf(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
                                  "nodes": [{"children": [1]}, {"children": [0]}]})",
                              "a.gltf", {});
      },
      "a.gltf", "circle");
}

}  // namespace
}  // namespace cloudgen::input
