// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <eccodes.h>

#include <functional>
#include <string>
#include <vector>

namespace cloudgen::test {

/// A message that ecCodes makes from one of its samples; keys that it refuses leave `refused` behind.
class GribMaker {
 public:
  explicit GribMaker(const char* sample) : handle_(codes_grib_handle_new_from_samples(nullptr, sample)) {}
  ~GribMaker() { codes_handle_delete(handle_); }
  GribMaker(const GribMaker&) = delete;
  GribMaker& operator=(const GribMaker&) = delete;

  GribMaker& whole(const char* key, long value) { return note(key, codes_set_long(handle_, key, value)); }
  GribMaker& number(const char* key, double value) {
    return note(key, codes_set_double(handle_, key, value));
  }
  GribMaker& text(const char* key, const std::string& value) {
    std::size_t length = value.size();
    return note(key, codes_set_string(handle_, key, value.c_str(), &length));
  }
  GribMaker& numbers(const char* key, const std::vector<double>& values) {
    return note(key, codes_set_double_array(handle_, key, values.data(), values.size()));
  }
  GribMaker& wholes(const char* key, const std::vector<long>& values) {
    return note(key, codes_set_long_array(handle_, key, values.data(), values.size()));
  }
  /// As many values as the grid has points.
  GribMaker& values(const std::function<double(std::size_t)>& valueAt) {
    std::size_t count = 0;
    codes_get_size(handle_, "values", &count);
    return values(count, valueAt);
  }
  GribMaker& values(std::size_t count, const std::function<double(std::size_t)>& valueAt) {
    std::vector<double> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = valueAt(i);
    return numbers("values", all);
  }

  codes_handle* handle() const { return handle_; }
  /// The last key that ecCodes refused, and why; empty if none.
  const std::string& refused() const { return refused_; }
  std::string bytes() const {
    const void* data = nullptr;
    std::size_t length = 0;
    codes_get_message(handle_, &data, &length);
    return {static_cast<const char*>(data), length};
  }

 private:
  GribMaker& note(const char* key, int code) {
    if (code != CODES_SUCCESS) refused_ = std::string(key) + ": " + codes_get_error_message(code);
    return *this;
  }
  codes_handle* handle_;
  std::string refused_;
};

enum class Variable { CloudWater, Temperature, Height, Humidity };

/// A field of 4 by 3 points (from 50 N 10 E, 2 degrees apart) on a pressure level, to be made by ecCodes.
struct GribField {
  int edition = 2, levelHectopascals = 500, hour = 12;
  std::vector<int> missing;
  Variable variable = Variable::CloudWater;
  std::vector<double> values;
  std::string packing = "grid_simple";
  long bits = 24;

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
  GribMaker maker(field.edition == 2 ? "regular_ll_pl_grib2" : "regular_ll_pl_grib1");
  maker.whole("Ni", 4).whole("Nj", 3);
  maker.number("latitudeOfFirstGridPointInDegrees", 50).number("latitudeOfLastGridPointInDegrees", 46);
  maker.number("longitudeOfFirstGridPointInDegrees", 10).number("longitudeOfLastGridPointInDegrees", 16);
  maker.number("iDirectionIncrementInDegrees", 2).number("jDirectionIncrementInDegrees", 2);
  maker.whole("dataDate", 20200601).whole("dataTime", field.hour * 100);
  maker.text("shortName", kShortNames[static_cast<int>(field.variable)]);
  maker.whole("level", field.levelHectopascals).whole("bitsPerValue", field.bits);
  if (!field.missing.empty()) {
    maker.whole("bitmapPresent", 1).number("missingValue", 9999);
    for (const int index : field.missing) field.values[static_cast<std::size_t>(index)] = 9999;
  }
  maker.numbers("values", field.values);
  // ecCodes packs anew only what is packed already.
  if (field.packing != "grid_simple") {
    maker.text("packingType", field.packing);
    if (field.packing == "grid_complex_spatial_differencing") maker.whole("orderOfSpatialDifferencing", 2);
    maker.numbers("values", field.values);
  }
  return maker.bytes();
}

}  // namespace cloudgen::test
