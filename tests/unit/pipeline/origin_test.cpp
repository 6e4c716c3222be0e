// SPDX-License-Identifier: Apache-2.0
#include "pipeline/origin.hpp"

#include "base/error.hpp"
#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

test::MadeSource model() { return {10, 46, 0.5, 4, 4}; }

TEST(Origin, WithoutABoxItIsTheWholeGrid) {
  const Origin origin = locateOrigin(model(), model().grid(), {});
  EXPECT_EQ(origin.cells.size(), 16u);
  EXPECT_NEAR(origin.frame.box().west, 10, 1e-9);
  EXPECT_NEAR(origin.frame.box().north, 48, 1e-9);
  EXPECT_TRUE(origin.warnings.empty());
  EXPECT_GT(origin.sun.elevationDegrees, 60);
}

TEST(Origin, ABoxTakesTheCellsItTouches) {
  Options options;
  options.box = base::GeoBox{10.1, 46.1, 10.6, 46.4};
  const Origin origin = locateOrigin(model(), model().grid(), options);
  EXPECT_EQ(origin.cells, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(origin.frame.box().west, 10.1);
}

TEST(Origin, ABoxOutsideIsRefusedWithTheDomain) {
  Options options;
  options.box = base::GeoBox{50, 10, 51, 11};
  try {
    locateOrigin(model(), model().grid(), options);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(error.where().find("50,10,51,11"), std::string::npos);
    EXPECT_NE(error.problem().find("10,46,12,48"), std::string::npos) << error.problem();
  }
}

TEST(Origin, ANightIsANightAndSaysSo) {
  test::MadeSource night = model();
  night.setTime(base::utcFromCivil(2026, 6, 21, 23));
  const Origin origin = locateOrigin(night, night.grid(), {});
  ASSERT_EQ(origin.warnings.size(), 1u);
  EXPECT_NE(origin.warnings[0].find("--sun"), std::string::npos);
  EXPECT_NE(origin.warnings[0].find("moon"), std::string::npos);
  EXPECT_EQ(origin.sky.moonlight, light::moonlightUnder(origin.moon));
  EXPECT_LT(origin.sun.elevationDegrees, -15);
  EXPECT_EQ(origin.sun.color, glm::vec3(0));
  EXPECT_GT(origin.sky.ambient.b, 0);
}

TEST(Origin, ASunsetIsTakenAsItIs) {
  test::MadeSource evening = model();
  evening.setTime(base::utcFromCivil(2026, 6, 21, 19));
  const Origin origin = locateOrigin(evening, evening.grid(), {});
  EXPECT_TRUE(origin.warnings.empty());
  EXPECT_NEAR(origin.sun.elevationDegrees, 0, 3);
  EXPECT_GT(origin.sun.azimuthDegrees, 290);
}

TEST(Origin, TheUsersSunIsTaken) {
  test::MadeSource night = model();
  night.setTime(base::utcFromCivil(2026, 6, 21, 23));
  Options options;
  options.sunDegrees = {240, 3};
  const Origin origin = locateOrigin(night, night.grid(), options);
  EXPECT_TRUE(origin.warnings.empty());
  EXPECT_EQ(origin.sun.azimuthDegrees, 240);
  EXPECT_EQ(origin.sun.elevationDegrees, 3);
}

}  // namespace
}  // namespace cloudgen::pipeline
