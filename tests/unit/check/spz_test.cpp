// SPDX-License-Identifier: Apache-2.0
// Packed splats, byte by byte from the description of the format.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/gzip.hpp"
#include "check/gltf/read_spz.hpp"

namespace cloudgen::check {
namespace {

std::string header(int version, int count, int degree, int fractionalBits) {
  std::string bytes = "NGSP";
  for (const int word : {version, count})
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
  for (const int byte : {degree, fractionalBits, 0, 0}) bytes += static_cast<char>(byte);
  return bytes;
}

std::string bytesOf(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

std::vector<ReadSplat> unpacked(const std::string& bytes) {
  std::vector<ReadSplat> splats;
  readPackedSplats(base::gzipped(bytes), "test", [&](const ReadSplat& splat) { splats.push_back(splat); });
  return splats;
}

/// Place (1, -2, 0.5) with 8 fractional bits, opacity 51/255, grey, deviations of 1, 2.7 and 0.37 units.
const std::string kColumns = bytesOf({0, 1, 0, 0, 0xfe, 0xff, 0x80, 0, 0, 51, 127, 128, 255, 160, 176, 144});

TEST(Spz, SecondVersionIsRead) {
  const auto splats = unpacked(header(2, 1, 1, 8) + kColumns + bytesOf({255, 127, 127}) +
                               bytesOf({128, 192, 64, 128, 128, 128, 0, 255, 128}));
  ASSERT_EQ(splats.size(), 1u);
  EXPECT_EQ(splats[0].center, glm::vec3(1, -2, 0.5f));
  EXPECT_NEAR(splats[0].opacity, 0.2, 1e-6);
  EXPECT_NEAR(splats[0].sigma.x, 1, 1e-6);
  EXPECT_NEAR(splats[0].sigma.y, std::exp(1.0), 1e-5);
  EXPECT_NEAR(splats[0].sigma.z, std::exp(-1.0), 1e-6);
  EXPECT_NEAR(splats[0].color.x, 0.5, 0.004);
  EXPECT_NEAR(splats[0].color.z, 0.5 + 0.5 / 0.15 * 0.28209479, 1e-4);
  EXPECT_NEAR(splats[0].rotation.x, 1, 1e-4);
  EXPECT_EQ(splats[0].harmonics[0], glm::vec3(0, 0.5f, -0.5f));
  EXPECT_EQ(splats[0].harmonics[2], glm::vec3(-1, 127.0f / 128, 0));
}

TEST(Spz, ThirdVersionKeepsTheThreeSmallerParts) {
  // w is the largest (3); x, y, z stand in bits 20-29, 10-19, 0-9: 256/511 * sqrt(1/2), its negative, 0.
  const std::uint32_t word = 3u << 30 | 256u << 20 | (512u | 256u) << 10;
  const auto splats = unpacked(header(3, 1, 0, 8) + kColumns +
                               bytesOf({static_cast<int>(word & 255), static_cast<int>(word >> 8 & 255),
                                        static_cast<int>(word >> 16 & 255), static_cast<int>(word >> 24)}));
  ASSERT_EQ(splats.size(), 1u);
  const float part = 256.0f / 511 * std::sqrt(0.5f);
  EXPECT_NEAR(splats[0].rotation.x, part, 1e-6);
  EXPECT_NEAR(splats[0].rotation.y, -part, 1e-6);
  EXPECT_NEAR(splats[0].rotation.z, 0, 1e-6);
  EXPECT_NEAR(splats[0].rotation.w, std::sqrt(1 - 2 * part * part), 1e-6);
}

TEST(Spz, BrokenPacksAreRefused) {
  const std::string good = header(2, 1, 0, 8) + kColumns + bytesOf({127, 127, 127});
  EXPECT_EQ(unpacked(good).size(), 1u);
  for (const std::string& bytes :
       {std::string(), header(2, 1, 0, 8), good + "x", good.substr(0, 30), header(1, 1, 0, 8) + good.substr(16),
        header(2, 2, 0, 8) + good.substr(16), header(2, 1, 4, 8) + good.substr(16), header(2, 1, 0, 24) + good.substr(16),
        header(2, -1, 0, 8) + good.substr(16), "NGSQ" + good.substr(4)})
    EXPECT_THROW(unpacked(bytes), base::InputError);
  EXPECT_THROW(readPackedSplats(good, "test", [](const ReadSplat&) {}), base::InputError) << "not gzip";
}

}  // namespace
}  // namespace cloudgen::check
