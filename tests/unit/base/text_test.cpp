// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <clocale>
#include <limits>

#include "base/genus.hpp"
#include "base/time.hpp"

namespace cloudgen::base {
namespace {

TEST(Shortest, ReadsBackAsTheSameNumberInAnyLocale) {
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(shortest(0.1f), "0.1");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(1e-7f), "1e-07");
  for (const double value : {1.0 / 3, 6.02214076e23, -2.5e-300, std::numeric_limits<double>::max()}) {
    double back = 0;
    EXPECT_TRUE(parseNumber(shortest(value), back));
    EXPECT_EQ(back, value);
  }
}

TEST(AppendFixed, CutsWhatSaysNothing) {
  const auto fixed = [](double value, int decimals) {
    std::string text;
    appendFixed(text, value, decimals);
    return text;
  };
  EXPECT_EQ(fixed(1.5, 3), "1.5");
  EXPECT_EQ(fixed(2.0, 3), "2");
  EXPECT_EQ(fixed(-0.0001, 2), "0");
  EXPECT_EQ(fixed(120, 0), "120");
  EXPECT_EQ(fixed(0.126, 2), "0.13");
}

TEST(ParseNumber, TakesWholeFiniteNumbersOnly) {
  double value = 0;
  EXPECT_TRUE(parseNumber(" +12.5 ", value));
  EXPECT_EQ(value, 12.5);
  for (const char* wrong : {"", " ", "1x", "1,5", "nan", "inf", "1e999", "0x10", "--1"})
    EXPECT_FALSE(parseNumber(wrong, value)) << wrong;
}

TEST(Split, KeepsEmptyParts) {
  EXPECT_EQ(split("a, b,,c ", ','), (std::vector<std::string>{"a", "b", "", "c"}));
  EXPECT_EQ(split("", ','), std::vector<std::string>{""});
}

TEST(NearestWord, FindsTyposAndNothingElse) {
  const std::vector<std::string> words{"inspect", "build", "validate"};
  EXPECT_EQ(nearestWord("inspct", words), "inspect");
  EXPECT_EQ(nearestWord("BUILD", words), "build");
  EXPECT_EQ(nearestWord("zebra", words), "");
}

TEST(Genus, NamesReadBack) {
  for (const Genus genus : allGenera()) {
    EXPECT_EQ(genusFromName(abbreviation(genus)), genus);
    EXPECT_EQ(genusFromName(name(genus)), genus);
  }
  EXPECT_EQ(genusFromName("CUMULONIMBUS"), Genus::Cumulonimbus);
  EXPECT_FALSE(genusFromName("Cx"));
}

TEST(UtcTime, ReadsBackAcrossTheCalendar) {
  for (const char* text :
       {"2011-01-15T12:00:00Z", "1970-01-01T00:00:00Z", "2024-02-29T23:59:59Z", "1900-03-01T06:30:00Z"})
    EXPECT_EQ(isoText(*utcFromIso(text)), text);
  EXPECT_EQ(utcFromIso("2011-01-15")->seconds, utcFromCivil(2011, 1, 15).seconds);
  EXPECT_EQ(utcFromIso("2011-01-15T12Z"), utcFromIso("2011-01-15T12:00:00Z"));
  for (const char* wrong : {"", "2011", "2011-02-29", "2011-01-15T24:00Z", "2011-01-15T12:00",
                            "2011-01-15T12:00:00Zx", "2011-13-01"})
    EXPECT_FALSE(utcFromIso(wrong)) << wrong;
}

TEST(UtcTime, JulianDayOfJ2000) { EXPECT_DOUBLE_EQ(julianDay(utcFromCivil(2000, 1, 1, 12)), 2451545.0); }

TEST(Text, CharactersAreWellFormedUtf8) {
  for (const char* good : {"a", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x8C\xA9"})
    EXPECT_EQ(characterLength(good), std::string_view(good).size()) << good;
  // A lone continuation, an overlong slash, half a surrogate pair, beyond Unicode, cut short, U+FFFF.
  for (const char* bad :
       {"\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\xEF\xBF\xBF"})
    EXPECT_EQ(characterLength(bad), 0u);
}

TEST(Text, XmlHoldsAnyBytes) {
  EXPECT_EQ(xmlEscaped("<a b=\"c\"> & 'd'\n"), "&lt;a b=&quot;c&quot;&gt; &amp; &apos;d&apos;&#10;");
  EXPECT_EQ(xmlEscaped("\x01\xFF\xC3\xA9"), " \xEF\xBF\xBD\xC3\xA9");
}

}  // namespace
}  // namespace cloudgen::base
