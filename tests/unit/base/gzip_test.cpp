// SPDX-License-Identifier: Apache-2.0
#include "base/gzip.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace cloudgen::base {
namespace {

TEST(Gzip, GivesBackWhatItTook) {
  std::string text;
  for (int i = 0; i < 400'000; ++i) text += static_cast<char>('a' + i * i % 7);
  for (const std::string& bytes : {std::string(), std::string("x"), text}) {
    const std::string packed = gzipped(bytes);
    EXPECT_TRUE(isGzip(packed));
    EXPECT_EQ(packed.substr(4, 4), std::string(4, '\0')) << "no time is written";
    EXPECT_EQ(unzipped(packed, "test", bytes.size()), bytes);
    EXPECT_EQ(unzipped(packed + gzipped("more"), "test", 1 << 20), bytes + "more");
  }
  EXPECT_LT(gzipped(text).size(), text.size() / 50);
}

TEST(Gzip, BrokenAndOverlongIsRefused) {
  const std::string packed = gzipped(std::string(10'000, 'a') + "b");
  EXPECT_THROW(unzipped(packed, "test", 9'999), InputError) << "a bomb is not unpacked";
  EXPECT_THROW(unzipped("", "test", 100), InputError);
  EXPECT_THROW(unzipped("plain", "test", 100), InputError);
  for (std::size_t length = 1; length < packed.size(); ++length)
    EXPECT_THROW(unzipped(packed.substr(0, length), "test", 1 << 20), InputError);
  std::string wrong = packed;
  wrong[packed.size() - 6] = static_cast<char>(wrong[packed.size() - 6] ^ 1);  // its checksum
  EXPECT_THROW(unzipped(wrong, "test", 1 << 20), InputError);
}

}  // namespace
}  // namespace cloudgen::base
