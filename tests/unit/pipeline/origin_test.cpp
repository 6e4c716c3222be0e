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

TEST(Origin, ANightIsLitAsAtTenAndSaysSo) {
  test::MadeSource night = model();
  night.setTime(base::utcFromCivil(2026, 6, 21, 23));
  const Origin origin = locateOrigin(night, night.grid(), {});
  ASSERT_EQ(origin.warnings.size(), 1u);
  EXPECT_NE(origin.warnings[0].find("--sun"), std::string::npos);
  // 10 h mean solar time at 11 E is 9:16 UTC.
  const light::Sun ten = light::sunAt(base::utcFromCivil(2026, 6, 21, 9, 16), 11, 47);
  EXPECT_NEAR(origin.sun.azimuthDegrees, ten.azimuthDegrees, 0.1);
  EXPECT_NEAR(origin.sun.elevationDegrees, ten.elevationDegrees, 0.1);
}

TEST(Origin, APolarNightStillGetsASun) {
  test::MadeSource polar(20, 78, 0.5, 2, 2);
  polar.setTime(base::utcFromCivil(2026, 12, 21, 10));
  const Origin origin = locateOrigin(polar, polar.grid(), {});
  EXPECT_EQ(origin.warnings.size(), 1u);
  EXPECT_NEAR(origin.sun.elevationDegrees, 8, 1e-9);
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
