// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <eccodes.h>

#include <functional>
#include <string>
#include <vector>

namespace cloudgen::test {

enum class Variable { CloudWater, Temperature, Height, Humidity };

/// A field of 4 by 3 points (from 50 N 10 E, 2 degrees apart) on a pressure level, to be made by ecCodes.
struct GribField {
  int edition = 2, levelHectopascals = 500, hour = 12;
  std::vector<int> missing;
  Variable variable = Variable::CloudWater;
  std::vector<double> values;

  GribField with(Variable what, const std::function<double(int)>& valueAt) const {
    GribField copy = *this;
    copy.variable = what;
    for (int i = 0; i < 12; ++i) copy.values.push_back(valueAt(i));
    return copy;
  }
};

/// The bytes of the message.
inline std::string made(GribField field) {
  const char* const kShortNames[] = {field.edition == 2 ? "clwmr" : "clwc", "t", "gh", "r"};
  codes_handle* handle = codes_grib_handle_new_from_samples(
      nullptr, field.edition == 2 ? "regular_ll_pl_grib2" : "regular_ll_pl_grib1");
  const auto set = [&](const char* key, double value) { codes_set_double(handle, key, value); };
  const auto setWhole = [&](const char* key, long value) { codes_set_long(handle, key, value); };
  setWhole("Ni", 4);
  setWhole("Nj", 3);
  set("latitudeOfFirstGridPointInDegrees", 50);
  set("latitudeOfLastGridPointInDegrees", 46);
  set("longitudeOfFirstGridPointInDegrees", 10);
  set("longitudeOfLastGridPointInDegrees", 16);
  set("iDirectionIncrementInDegrees", 2);
  set("jDirectionIncrementInDegrees", 2);
  setWhole("dataDate", 20200601);
  setWhole("dataTime", field.hour * 100);
  const char* name = kShortNames[static_cast<int>(field.variable)];
  std::size_t length = std::char_traits<char>::length(name);
  codes_set_string(handle, "shortName", name, &length);
  setWhole("level", field.levelHectopascals);
  setWhole("bitsPerValue", 24);
  if (!field.missing.empty()) {
    setWhole("bitmapPresent", 1);
    set("missingValue", 9999);
    for (const int index : field.missing) field.values[static_cast<std::size_t>(index)] = 9999;
  }
  codes_set_double_array(handle, "values", field.values.data(), field.values.size());
  const void* bytes = nullptr;
  codes_get_message(handle, &bytes, &length);
  std::string message(static_cast<const char*>(bytes), length);
  codes_handle_delete(handle);
  return message;
}

}  // namespace cloudgen::test
