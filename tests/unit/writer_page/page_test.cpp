// SPDX-License-Identifier: Apache-2.0
#include "writer/page/page.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "writer/page/page_data.hpp"

namespace cloudgen::writer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kViewer =
    "<html><script type=\"application/json\" id=\"cloudgen-scene\"></script>\n"
    "<script type=\"application/octet-stream;base64\" "
    "id=\"cloudgen-pack\"></script><script>run()</script></html>";

scene::Scene skyWithTwoClouds() {
  scene::Scene scene{.frame = base::LocalFrame({-122.6, 36.2, -121.2, 37.2})};
  scene.validTime = base::utcFromCivil(2011, 1, 15, 12);
  scene.provenance = {{"/somewhere/gfs.grib2"}, "GRIB2", "GFS", "2011-01-10T12:00:00Z"};
  scene.clouds.push_back({.genus = base::Genus::Cumulus, .baseMeters = 900, .topMeters = 2100});
  scene.clouds.push_back({.genus = base::Genus::Cumulus, .baseMeters = 800, .topMeters = 1500});
  scene.clouds.push_back({.genus = base::Genus::Cirrus, .baseMeters = 8000, .topMeters = 8400});
  return scene;
}

/// A data folder with a small viewer, and an output folder; both go away with the test.
class Page : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("cloudgen_page_" + std::to_string(::getpid()));
    fs::create_directories(root_ / "data/templates");
    fs::create_directories(root_ / "data/viewer");
    fs::create_directories(root_ / "out");
    ::setenv("CLOUDGEN_DATA", (root_ / "data").c_str(), 1);
    base::writeFile(root_ / "data/viewer/viewer.html", kViewer);
  }
  void TearDown() override {
    ::unsetenv("CLOUDGEN_DATA");
    fs::remove_all(root_);
  }
  Destination out() const { return {root_ / "out", {}}; }
  std::string written() const { return base::readFile(root_ / "out/index.html"); }

  fs::path root_;
};

TEST_F(Page, HoldsThePackAndTheSceneAndTheViewer) {
  base::writeFile(out().folder / "scene.cgpack", "foobar");
  writePage(skyWithTwoClouds(), out());
  const std::string page = written();
  EXPECT_NE(page.find("id=\"cloudgen-pack\">Zm9vYmFy</script><script>run()</script></html>"),
            std::string::npos);
  EXPECT_NE(page.find("\"validTime\":\"2011-01-15T12:00:00Z\""), std::string::npos);
}

TEST_F(Page, JoinsTheBlocksOfALargeFile) {
  const std::string bytes((3u << 18) * 2 + 1, 'a');
  base::writeFile(out().folder / "scene.cgpack", bytes);
  writePage(skyWithTwoClouds(), out());
  const std::string page = written();
  const std::size_t start = page.find("pack\">") + 6, end = page.find("</script>", start);
  EXPECT_EQ(end - start, (bytes.size() + 2) / 3 * 4);
  EXPECT_EQ(page.substr(end - 4, 4), "YQ==");
}

TEST_F(Page, LeavesAVeryLargePackBesideIt) {
  base::writeFile(out().folder / "scene.cgpack", "foobar");
  writePage(skyWithTwoClouds(), out(), 5);
  EXPECT_NE(written().find("id=\"cloudgen-pack\"></script>"), std::string::npos);
  EXPECT_NE(written().find("\"file\":\"scene.cgpack\""), std::string::npos);
}

TEST_F(Page, ShowsWhatVerifyFoundAndItsMaps) {
  base::writeFile(out().folder / "scene.cgpack", "foobar");
  fs::create_directories(out().folder / "verify");
  base::writeFile(out().folder / "verify/cover.png", "foobar");
  Destination verified = out();
  verified.verification = R"({"passed": true, "note": "</script>"})";
  writePage(skyWithTwoClouds(), verified);
  EXPECT_NE(written().find(R"("verification":{"passed":true,"note":"\u003c/script>"})"), std::string::npos);
  EXPECT_NE(written().find(R"("file":"verify/cover.png","picture":"data:image/png;base64,Zm9vYmFy")"),
            std::string::npos);
  writePage(skyWithTwoClouds(), out());
  EXPECT_EQ(written().find("verification"), std::string::npos) << "maps of another run are not shown";
  EXPECT_EQ(written().find("cover.png"), std::string::npos);
}

TEST_F(Page, WithoutPackSaysWhatToAdd) {
  try {
    writePage(skyWithTwoClouds(), out());
    FAIL() << "a page without a pack was written";
  } catch (const base::OutputError& error) {
    EXPECT_NE(error.hint().find("add pack"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(out().folder / "index.html"));
}

TEST_F(Page, ViewerWithoutSlotsIsRefused) {
  base::writeFile(root_ / "data/viewer/viewer.html", "<html></html>");
  base::writeFile(out().folder / "scene.cgpack", "foobar");
  EXPECT_THROW(writePage(skyWithTwoClouds(), out()), base::OutputError);
}

TEST_F(Page, TwoRunsWriteTheSameBytes) {
  base::writeFile(out().folder / "scene.cgpack", "foobar");
  writePage(skyWithTwoClouds(), out());
  const std::string first = written();
  writePage(skyWithTwoClouds(), out());
  EXPECT_EQ(first, written());
}

TEST(PageData, CountsGeneraWithTheirHeights) {
  const auto data = nlohmann::json::parse(pageData(skyWithTwoClouds(), {.packBytes = 6}));
  ASSERT_EQ(data["genera"].size(), 2u);
  EXPECT_EQ(data["genera"][0]["abbreviation"], "Ci");
  EXPECT_EQ(data["genera"][1]["count"], 2);
  EXPECT_EQ(data["genera"][1]["lowestBaseMeters"], 800);
  EXPECT_EQ(data["genera"][1]["highestTopMeters"], 2100);
  EXPECT_EQ(data["pack"]["bytes"], 6);
  EXPECT_TRUE(data["pack"]["file"].is_null());
}

TEST(PageData, TellsWhereAndWhatWithoutFolders) {
  const auto data = nlohmann::json::parse(pageData(skyWithTwoClouds(), {.packBytes = 6}));
  EXPECT_EQ(data["title"], "Clouds of GFS, 36.2 to 37.2°N, 122.6 to 121.2°W");
  EXPECT_EQ(data["files"][0], "gfs.grib2");
}

TEST(PageData, NothingInItEndsTheScriptElement) {
  scene::Scene scene = skyWithTwoClouds();
  scene.provenance.model = "</script><script>alert(1)</script>";
  const std::string text = pageData(scene, {.packBytes = 6});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_NE(nlohmann::json::parse(text)["title"].get<std::string>().find("</script>"), std::string::npos);
}

TEST(PageData, SurvivesANameThatIsNotUtf8) {
  scene::Scene scene = skyWithTwoClouds();
  scene.provenance.model = "mod\xe8le";
  EXPECT_NO_THROW(nlohmann::json::parse(pageData(scene, {.packBytes = 6})));
}

}  // namespace
}  // namespace cloudgen::writer
