// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input/grib/messages.hpp"

struct grib_handle;

namespace cloudgen::input::grib {

/// One decoded message of ecCodes. Whatever ecCodes finds wrong becomes an InputError that names the message;
/// it prints nothing and does not abort. One handle a thread.
class Handle {
 public:
  explicit Handle(const FieldLocation& location);
  Handle(const Handle&) = delete;  // ecCodes points into bytes_
  Handle& operator=(const Handle&) = delete;

  long integer(const char* key) const;
  double number(const char* key) const;
  std::string text(const char* key) const;
  /// Nothing where the message does not have the key.
  std::optional<long> integerIfAny(const char* key) const;
  std::optional<double> numberIfAny(const char* key) const;

  /// Every value in the order of the file; NaN where the bitmap says missing. Throws unless there are
  /// `count`.
  std::vector<double> values(std::size_t count) const;
  /// The same as ecCodes gives them, missing values as kMissing, into a vector that may serve again for the
  /// next message: each pass over a million values counts.
  void readValues(std::vector<double>& values, std::size_t count) const;
  static constexpr double kMissing = -1e100;

  const FieldLocation& location() const { return location_; }

 private:
  [[noreturn]] void fail(const std::string& what) const;
  template <class Step>
  auto guarded(const Step& step) const;
  bool present(const char* key) const;
  void checkPacking() const;

  FieldLocation location_;
  std::string bytes_;
  std::shared_ptr<grib_handle> handle_;
};

}  // namespace cloudgen::input::grib
