// SPDX-License-Identifier: Apache-2.0
#include "writer/page/base64.hpp"

#include <gtest/gtest.h>

namespace cloudgen::writer {
namespace {

// The test vectors of RFC 4648, section 10.
TEST(Base64, WritesTheVectorsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesEveryByte) {
  EXPECT_EQ(base64(std::string_view("\0\0\0", 3)), "AAAA");
  EXPECT_EQ(base64("\xff\xff\xff"), "////");
  EXPECT_EQ(base64("\xfb\xff"), "+/8=");
}

TEST(Base64, PartsOfThreeBytesJoin) { EXPECT_EQ(base64("foo") + base64("bar"), base64("foobar")); }

}  // namespace
}  // namespace cloudgen::writer
