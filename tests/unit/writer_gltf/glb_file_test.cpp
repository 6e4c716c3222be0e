// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/glb_file.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/glb_reader.hpp"

namespace cloudgen::writer::gltf {
namespace {

TEST(GlbFile, PadsChunksForEveryLengthOfTextAndData) {
  const test::ScratchFolder folder;
  for (int length = 0; length < 8; ++length) {
    GlbFile file(nlohmann::json{{"name", std::string(static_cast<std::size_t>(length), 'x')}});
    file.addPngTexture("p", std::string(static_cast<std::size_t>(length) + 1, 'p'));
    file.write(folder.path() / "a.glb");
    const test::Glb glb(test::bytesOf(folder.path() / "a.glb"));  // throws if the container is wrong
    EXPECT_EQ(glb.json["buffers"][0]["byteLength"], length + 1);
  }
}

TEST(GlbFile, WithoutDataHasNoBinaryChunk) {
  const test::ScratchFolder folder;
  GlbFile(nlohmann::json{{"seed", "1"}}).write(folder.path() / "a.glb");
  const test::Glb glb(test::bytesOf(folder.path() / "a.glb"));
  EXPECT_TRUE(glb.binary.empty());
  EXPECT_FALSE(glb.json.contains("buffers"));
  EXPECT_EQ(glb.json["asset"]["extras"]["seed"], "1");
}

TEST(GlbFile, BoundsAreExactlyThoseOfTheFloats) {
  const test::ScratchFolder folder;
  GlbFile file(nlohmann::json::object());
  const std::array<float, 6> places{0.1f, -2, 3e-9f, 1e7f + 1, 5, -0.3f};
  file.addFloats(3, places, true);
  file.write(folder.path() / "a.glb");
  const test::Glb glb(test::bytesOf(folder.path() / "a.glb"));
  const auto& accessor = glb.json["accessors"][0];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(accessor["min"][axis].get<double>(), std::min(places[axis], places[axis + 3]));
    EXPECT_EQ(accessor["max"][axis].get<double>(), std::max(places[axis], places[axis + 3]));
  }
}

TEST(GlbFile, TellsWhatItCannotWrite) {
  EXPECT_THROW(GlbFile(nlohmann::json::object()).write("/nowhere/at/all/a.glb"), base::OutputError);
}

}  // namespace
}  // namespace cloudgen::writer::gltf
