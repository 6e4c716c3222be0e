// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/pattern.hpp"

#include <libxml/xmlregexp.h>

#include <random>

namespace cloudgen::check::test {
namespace {

const std::string kNumber = R"([+-]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([Ee][+-]?[0-9]+)?)";

/// Blanks as whiteSpace "collapse" leaves them.
std::string collapsed(std::string_view value) {
  std::string out;
  for (const char c : value) {
    const bool isBlank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!isBlank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

struct Expression {
  const char* what;
  std::string pattern;
};

std::vector<Expression> expressions() {
  return {{"points", "\\s*(((" + kNumber + ")\\s+){2}(" + kNumber + ")\\s*,?\\s*)*"},
          {"a point", kNumber + " " + kNumber},
          {"numbers", "\\s*((" + kNumber + ")\\s*,?\\s*)*"},
          {"our integers", R"(([+\-]?(0|[1-9][0-9]*)((, ?| )[+\-]?(0|[1-9][0-9]*))*)?)"},
          {"truths", R"(\s*((true|false)\s*,?\s*)*)"},
          {"image",
           R"(\s*([+]?(0|[1-9][0-9]*)\s+){2}[+]?[0-4](\s+(0x[0-9a-fA-F]{1,4}|[+]?(0|[1-9][0-9]*)))*\s*)"},
          {"counts", "a{2}b{1,3}c{0,2}(dd){0,}"},
          {"nested", "((a|b)*c?)+"},
          {"not", "[^ab]+"},
          {"minus", "[a-c-]+|x?"}};
}

/// Values near what the patterns accept, and libxml2's own verdict on each.
TEST(Pattern, AgreesWithLibxml2) {
  std::mt19937 random(1);
  const std::vector<std::string> pieces{"0",  "1.5", "-",  "+",  ".",   "e",    "E5",    "12",   " ",
                                        "  ", ",",   ", ", "\n", "\t",  "a",    "b",     "true", "false",
                                        "c",  "dd",  "x",  "3",  "0xf", "-1 2", "1 1 3", "aabb", "aab"};
  for (const Expression& expression : expressions()) {
    const auto pattern = Pattern::compiled(expression.pattern);
    ASSERT_TRUE(pattern) << expression.what;
    const xmlRegexpPtr theirs =
        xmlRegexpCompile(reinterpret_cast<const xmlChar*>(expression.pattern.c_str()));
    ASSERT_NE(theirs, nullptr);
    int accepted = 0;
    for (int i = 0; i < 4000; ++i) {
      std::string value;
      for (unsigned long n = random() % 9; n > 0; --n) value += pieces[random() % pieces.size()];
      const bool verdict =
          xmlRegexpExec(theirs, reinterpret_cast<const xmlChar*>(collapsed(value).c_str())) == 1;
      accepted += verdict;
      EXPECT_EQ(pattern->accepts(value), verdict) << expression.what << " '" << value << "'";
    }
    EXPECT_GT(accepted, 0) << expression.what;
    EXPECT_TRUE(pattern->accepts(pattern->shortest())) << expression.what;
    xmlRegFreeRegexp(theirs);
  }
}

TEST(Pattern, IsCertainOfAsciiOnly) {
  const auto any = Pattern::compiled("(\\s|\\S)*");
  ASSERT_TRUE(any);
  EXPECT_TRUE(any->accepts("anything"));
  EXPECT_FALSE(any->accepts("\xc3\xa4"));
  EXPECT_FALSE(any->accepts(std::string(1, '\0')));
}

TEST(Pattern, RefusesWhatItDoesNotKnow) {
  for (const char* expression : {"\\p{L}+", "[a-z-[aeiou]]", "\\i\\c*", "(a", "a)", "a{3,2}", "a{2000}", "[]",
                                 "*", "\xc3\xa4", "\\", "[a", "a{"})
    EXPECT_FALSE(Pattern::compiled(expression)) << expression;
  EXPECT_FALSE(Pattern::compiled("(((((a{999}){999}){999}){999}){999})"));
  EXPECT_FALSE(Pattern::compiled(std::string(100000, '(')));
}

}  // namespace
}  // namespace cloudgen::check::test
