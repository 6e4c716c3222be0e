// SPDX-License-Identifier: Apache-2.0
#include "input/catalogue.hpp"

#include "base/error.hpp"
#include "support/made_grib.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {
namespace {

const std::string kSky = R"( {"cloudgen_sky":1,"valid_time":"2020-01-01","bbox":[0,0,1,1],"layers":[]})";

std::string complaint(const std::vector<std::filesystem::path>& files) {
  try {
    open(files);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "was read";
}

TEST(Open, TellsFormatsByContentNotByName) {
  const test::Scratch scratch;
  EXPECT_EQ(open({scratch.write("sky.grib", kSky)})->info().format, "described sky");
  const std::string grib =
      test::made(test::GribField{}.with(test::Variable::CloudWater, [](int) { return 1e-4; }));
  EXPECT_EQ(open({scratch.write("grib.json", grib)})->info().format, "GRIB2");
  EXPECT_EQ(open({scratch.write("bulletin", "HEADING 42\r\r\n" + grib)})->info().format, "GRIB2");
}

TEST(Open, SaysWhatIsWrongInOneLine) {
  const test::Scratch scratch;
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
  };
  EXPECT_TRUE(says(complaint({scratch.path() / "nowhere"}), "no such file"));
  EXPECT_TRUE(says(complaint({scratch.path()}), "is a folder without a file"));
  EXPECT_TRUE(says(complaint({scratch.write("empty", "")}), "is empty"));
  EXPECT_TRUE(says(complaint({scratch.write("text", "hello")}), "no format"));
  EXPECT_TRUE(says(complaint({scratch.write("nc", "CDF\x01")}), "cut short"));
  EXPECT_TRUE(says(complaint({scratch.write("cut", "GRIB")}), "cut short"));
  EXPECT_TRUE(
      says(complaint({scratch.write("a", kSky), scratch.write("b", "GRIB")}), "one format at a time"));
  EXPECT_TRUE(says(complaint({scratch.write("a", kSky), scratch.write("b", kSky)}), "one at a time"));
}

TEST(Open, TakesTheFilesOfAFolderThatItKnows) {
  const test::Scratch scratch;
  scratch.write("notes.txt", "hello");
  scratch.write("nothing", "");
  const auto sky = scratch.write("sky.json", kSky);
  EXPECT_EQ(open({scratch.path()})->info().files, std::vector{sky.string()});
  scratch.write("more.json", kSky);
  EXPECT_NE(complaint({scratch.path()}).find("one at a time"), std::string::npos);
}

TEST(Open, JoinsTheFieldsOfSeveralGribFiles) {
  const test::Scratch scratch;
  const test::GribField field;
  const auto water =
      scratch.write("water", test::made(field.with(test::Variable::CloudWater, [](int) { return 1e-4; })));
  const auto heat =
      scratch.write("heat", test::made(field.with(test::Variable::Temperature, [](int) { return 250; })));
  EXPECT_EQ(open({water, heat})->info().fields.size(), 2u);
}

}  // namespace
}  // namespace cloudgen::input
