// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>

#include <chrono>

#include "check/xsd/validate_x3d.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

const std::string kHead = R"(<X3D profile="Full" version="4.0"><Scene>)";
const std::string kTail = "</Scene></X3D>";

std::string repeated(std::string_view piece, std::size_t count) {
  std::string all;
  all.reserve(piece.size() * count);
  for (std::size_t i = 0; i < count; ++i) all += piece;
  return all;
}

long peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// Refused with the rule as its first finding, within a second and 100 MB.
void expectRefused(const std::string& what, const std::string& scene, const std::string& rule) {
  const long before = peakMegabytes();
  const auto start = std::chrono::steady_clock::now();
  const ValidationResult result = validateX3dText(scene, "hostile.x3d", profileSchema());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  ASSERT_FALSE(result.findings.empty()) << what;
  EXPECT_EQ(result.findings[0].rule, rule) << what << ": " << result.findings[0].message;
  EXPECT_LT(seconds.count(), 1.0) << what;
  EXPECT_LT(peakMegabytes() - before, 100) << what;
}

TEST(HostileX3d, IsRefusedQuickly) {
  std::string laughs = "<!DOCTYPE X3D [<!ENTITY l0 \"lol\">";
  for (int i = 1; i < 10; ++i)
    laughs +=
        "<!ENTITY l" + std::to_string(i) + " \"" + repeated("&l" + std::to_string(i - 1) + ";", 10) + "\">";
  expectRefused("billion laughs", laughs + "]>" + kHead + "<WorldInfo title=\"&l9;\"/>" + kTail,
                "xml-entity");
  expectRefused("an external entity",
                "<!DOCTYPE X3D [<!ENTITY p SYSTEM \"file:///etc/passwd\">]>" + kHead +
                    "<WorldInfo title=\"&p;\"/>" + kTail,
                "xml-entity");
  expectRefused("a parameter entity",
                "<!DOCTYPE X3D [<!ENTITY % p SYSTEM \"http://127.0.0.1:9/\"> %p;]>" + kHead + kTail,
                "xml-entity");
  expectRefused("100,000 elements deep",
                kHead + repeated("<Group>", 100000) + repeated("</Group>", 100000) + kTail, "xml-limit");
  expectRefused("an attribute of 50 MB",
                kHead + "<Coordinate point='" + repeated("0 0 0 ", 9000000) + "'/>" + kTail, "xml-limit");
  expectRefused("a comment of 50 MB", kHead + "<!--" + std::string(50 << 20, 'x') + "-->" + kTail,
                "xml-limit");
  expectRefused("text of 50 MB", kHead + std::string(50 << 20, ' ') + kTail, "xml-limit");
  expectRefused("a name of 50 MB", kHead + "<" + std::string(50 << 20, 'x') + "/>" + kTail, "xml-limit");
  expectRefused("an attribute's name of 50 MB",
                kHead + "<Group " + std::string(50 << 20, 'x') + "='1'/>" + kTail, "xml-limit");
  std::string many = kHead + "<Group";
  for (int i = 0; i < 200000; ++i) many += " a" + std::to_string(i) + "='1'";
  expectRefused("200,000 attributes", many + "/>" + kTail, "xml-limit");
  expectRefused("a DOCTYPE without end", "<!DOCTYPE X3D PUBLIC \"" + std::string(50 << 20, 'x'), "xml-limit");
  expectRefused("UTF-16", std::string("\xff\xfe<\0X\0", 6), "xml-encoding");
  expectRefused("nothing", "", "xml-malformed");
  expectRefused("zeros", std::string(1000, '\0'), "xml-encoding");
}

TEST(HostileX3d, AMillionErrorsEndAtTheLimit) {
  const ValidationResult result = validateX3dText(
      kHead + repeated("<Shape><Nothing a='1'/></Shape>", 1000000) + kTail, "hostile.x3d", profileSchema());
  EXPECT_EQ(result.findings.size(), FindingList::kLimit);
  EXPECT_EQ(result.findings.back().rule, "too-many");
}

TEST(HostileX3d, AnAttributeJustUnderTheLimitIsReadInASecond) {
  const std::string points = repeated("0.25 -1.5 1000 ", (7 << 20) / 15);
  const std::string scene = kHead + "<Shape><IndexedFaceSet coordIndex='0 1 2'><Coordinate point='" + points +
                            "'/></IndexedFaceSet></Shape>" + kTail;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(texts(validateX3dText(scene, "large.x3d", profileSchema())), "");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2.0);
}

TEST(HostileX3d, ManyLongAttributesAreRead) {
  std::string scene = kHead;
  for (int i = 0; i < 12; ++i)
    scene += "<Shape><IndexedFaceSet coordIndex='0 1 2'><Coordinate point='" +
             repeated("0.25 -1.5 1000 ", (3 << 20) / 30) + "'/></IndexedFaceSet></Shape>";
  EXPECT_EQ(texts(validateX3dText(scene + kTail, "large.x3d", profileSchema())), "");
}

TEST(HostileX3d, AMessageNeverCarriesTheWholeValue) {
  const std::string scene =
      kHead + "<Transform translation='" + repeated("\x01\n", 0) + repeated("bad ", 100000) + "'/>" + kTail;
  for (const Finding& finding : validateX3dText(scene, "long.x3d", profileSchema()).findings) {
    EXPECT_LT(text(finding).size(), 700u);
    EXPECT_EQ(text(finding).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace cloudgen::check::test
