// SPDX-License-Identifier: Apache-2.0
#include "check/rules/numbers.hpp"

#include <vector>

#include "check/rules/field_facts.hpp"

namespace cloudgen::check::test {
namespace {

template <typename Number>
std::pair<std::vector<Number>, ListEnd> read(std::string_view list) {
  std::vector<Number> numbers;
  const ListResult result = forEachNumber<Number>(list, [&](Number number) { numbers.push_back(number); });
  EXPECT_EQ(result.count, numbers.size());
  return {numbers, result.end};
}

TEST(Numbers, AreReadBetweenBlanksAndCommas) {
  EXPECT_EQ(read<double>(" 1,2.5\n-3e2\t+.5,, 0. ").first, (std::vector<double>{1, 2.5, -300, 0.5, 0}));
  EXPECT_EQ(read<std::int64_t>("0 -1, 0xff +7").first, (std::vector<std::int64_t>{0, -1, 255, 7}));
  EXPECT_EQ(read<double>("").second, ListEnd::Complete);
}

TEST(Numbers, WhatIsNoFiniteNumberEndsTheList) {
  for (const char* list : {"1 nan", "inf", "-INF 2", "1e999"})
    EXPECT_EQ(read<double>(list).second, ListEnd::NotFinite) << list;
  for (const char* list : {"1;2", "1.0f", "one", "--1", "+-1", "1-2", "0x10"})
    EXPECT_EQ(read<double>(list).second, ListEnd::NotANumber) << list;
  for (const char* list : {"1.5", "1e3", "99999999999999999999"})
    EXPECT_EQ(read<std::int64_t>(list).second, ListEnd::NotANumber) << list;
  EXPECT_EQ(read<double>("1e-999").second, ListEnd::Complete);
}

TEST(Strings, AreSplitAtTheirQuotationMarks) {
  std::vector<std::string> strings;
  EXPECT_TRUE(splitStrings(R"( "a b", "c\"d" "\\" )", strings));
  EXPECT_EQ(strings, (std::vector<std::string>{"a b", "c\"d", "\\"}));
  EXPECT_TRUE(splitStrings(" ", strings));
  for (const char* list : {"a", "\"a", "\"a\" b", "'a'", "\"a\\\""})
    EXPECT_FALSE(splitStrings(list, strings)) << list;
}

}  // namespace
}  // namespace cloudgen::check::test
