// SPDX-License-Identifier: Apache-2.0
#include "netcdf_cases.hpp"

namespace cloudgen {
namespace {

using test::contentsOf;
using test::NetcdfFile;
using test::plainFile;

std::string firstTime(const NetcdfFile& file) {
  const auto contents = contentsOf(file);
  const auto valid = contents.fields.at(0).valid;
  return valid ? base::isoText(*valid) : "none";
}

NetcdfFile timed(const std::string& units, double value, const std::string& calendar = "") {
  NetcdfFile file = plainFile();
  file.variable("time").texts["units"] = units;
  if (!calendar.empty()) file.variable("time").texts["calendar"] = calendar;
  file.variable("time").values = {value, value + 1};
  return file;
}

TEST(NetcdfTime, UnitsOfManyKinds) {
  EXPECT_EQ(firstTime(timed("hours since 1900-01-01 00:00:0.0", 1051896)), "2020-01-01T00:00:00Z");
  EXPECT_EQ(firstTime(timed("days since 2020-01-01", 0.25)), "2020-01-01T06:00:00Z");
  EXPECT_EQ(firstTime(timed("seconds since 1970-01-01T00:00:00Z", 86399)), "1970-01-01T23:59:59Z");
  EXPECT_EQ(firstTime(timed("minutes since 2020-02-28 23:30:00", 60)), "2020-02-29T00:30:00Z");
  EXPECT_EQ(firstTime(timed("hours since 2021-01-04 00:00:00 +02:00", 3)), "2021-01-04T01:00:00Z");
  EXPECT_EQ(firstTime(timed("day as %Y%m%d.%f", 20200131.5)), "2020-01-31T12:00:00Z");
}

TEST(NetcdfTime, CalendarsAreHeeded) {
  // Two days lie between the mixed and the proleptic calendar of the year 1.
  EXPECT_EQ(firstTime(timed("days since 0001-01-01", 737424, "standard")), "2019-12-30T00:00:00Z");
  EXPECT_EQ(firstTime(timed("days since 0001-01-01", 737424, "proleptic_gregorian")), "2020-01-01T00:00:00Z");
  EXPECT_EQ(firstTime(timed("days since 2000-01-01", 365.5, "noleap")), "2001-01-01T12:00:00Z");
  EXPECT_EQ(firstTime(timed("days since 2000-01-01", 59, "noleap")), "2000-03-01T00:00:00Z");
  EXPECT_EQ(firstTime(timed("days since 2000-01-01", 390, "360_day")), "2001-02-01T00:00:00Z");
  EXPECT_TRUE(test::warns(contentsOf(timed("days since 2000-01-01", 1, "360_day")), "model_calendar"));
  EXPECT_THROW(contentsOf(timed("days since 2000-01-01", 1, "mayan")), base::InputError);
}

TEST(NetcdfTime, ReferenceTimeAndStep) {
  // As cfgrib writes it: time is the start, step the lead.
  NetcdfFile file = plainFile();
  file.dimensions.push_back({"step", 2});
  file.drop("clwc");
  file.variable("time").texts["standard_name"] = "forecast_reference_time";
  file.variables.push_back(
      {"step", {"step"}, {{"units", "hours"}, {"standard_name", "forecast_period"}}, {3, 9}});
  file.variables.push_back(
      {"clwc", {"time", "step", "level", "lat", "lon"}, {{"units", "1"}}, std::vector<double>(96, 1e-6)});
  const auto withoutValid = contentsOf(file);
  ASSERT_EQ(withoutValid.fields.size(), 8u);
  EXPECT_EQ(withoutValid.fields.back().valid, base::utcFromIso("2020-01-01T15:00:00Z"));
  EXPECT_EQ(withoutValid.fields.back().run, base::utcFromIso("2020-01-01T06:00:00Z"));
  file.variables.push_back({"valid_time",
                            {"time", "step"},
                            {{"units", "hours since 2020-01-01"}, {"standard_name", "time"}},
                            {3, 9, 9, 15}});
  const auto withValid = contentsOf(file);
  EXPECT_EQ(withValid.fields.back().valid, base::utcFromIso("2020-01-01T15:00:00Z"));
  EXPECT_EQ(withValid.fields.back().run, base::utcFromIso("2020-01-01T06:00:00Z"));
}

TEST(NetcdfTime, ScalarTimeCounts) {
  NetcdfFile file = plainFile();
  file.drop("clwc");
  file.variable("time").dimensions.clear();
  file.variable("time").values = {6};
  file.variables.push_back(
      {"clwc", {"level", "lat", "lon"}, {{"units", "1"}}, std::vector<double>(24, 1e-6)});
  EXPECT_EQ(firstTime(file), "2020-01-01T06:00:00Z");
}

TEST(NetcdfTime, WithoutAnyTimeTheWantedOneHolds) {
  NetcdfFile file = plainFile({"level", "lat", "lon"});
  file.drop("time");
  EXPECT_TRUE(test::warns(contentsOf(file), "time_missing"));
  input::OpenOptions options;
  options.time = base::utcFromIso("2024-05-01T12:00:00Z");
  EXPECT_EQ(contentsOf(file, options).fields.at(0).valid, options.time);
}

TEST(NetcdfTime, WhatIsNoTimeIsRefusedOrPassedOver) {
  EXPECT_THROW(contentsOf(timed("fortnights since the flood", 1)), base::InputError);
  EXPECT_TRUE(contentsOf(timed("days since 2020-01-01", 1e300)).fields.empty());
}

}  // namespace
}  // namespace cloudgen
