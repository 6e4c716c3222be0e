// SPDX-License-Identifier: Apache-2.0
#include "input/grib/handle.hpp"

#include <eccodes.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/error.hpp"

namespace cloudgen::input::grib {
namespace {

/// ecCodes calls this where it would abort; what it was doing leaks, which is the smaller harm.
void throwAssertion(const char* message) {
  throw base::InputError("GRIB message", fmt::format("ecCodes gives up on it ({})", message),
                         "fetch the file again");
}

void ignoreLog(const grib_context*, int, const char*) {}
void ignorePrint(const grib_context*, void*, const char*) {}

/// The context of ecCodes, silent.
codes_context* quietContext() {
  static std::once_flag once;
  codes_context* context = codes_context_get_default();
  std::call_once(once, [context] {
    codes_context_set_logging_proc(context, ignoreLog);
    codes_context_set_print_proc(context, ignorePrint);
    codes_set_codes_assertion_failed_proc(throwAssertion);
  });
  return context;
}

}  // namespace

Handle::Handle(const FieldLocation& location) : location_(location), bytes_(readField(location)) {
  codes_context* context = quietContext();
  grib_handle* handle = nullptr;
  try {
    handle = codes_handle_new_from_message(context, bytes_.data(), bytes_.size());
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
  if (!handle) fail("cannot be decoded by ecCodes");
  handle_ = std::shared_ptr<grib_handle>(handle, [](grib_handle* h) { codes_handle_delete(h); });
}

void Handle::fail(const std::string& what) const {
  throw base::InputError(location_.name(), what, "fetch the file again");
}

std::optional<long> Handle::integerIfAny(const char* key) const {
  long value = 0;
  try {
    if (codes_is_missing(handle_.get(), key, nullptr) ||
        codes_get_long(handle_.get(), key, &value) != CODES_SUCCESS)
      return std::nullopt;
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
  return value;
}

std::optional<double> Handle::numberIfAny(const char* key) const {
  double value = 0;
  try {
    if (codes_is_missing(handle_.get(), key, nullptr) ||
        codes_get_double(handle_.get(), key, &value) != CODES_SUCCESS)
      return std::nullopt;
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

long Handle::integer(const char* key) const {
  const auto value = integerIfAny(key);
  if (!value) fail(fmt::format("has no {}", key));
  return *value;
}

double Handle::number(const char* key) const {
  const auto value = numberIfAny(key);
  if (!value) fail(fmt::format("has no {}", key));
  return *value;
}

std::string Handle::text(const char* key) const {
  std::array<char, 512> buffer{};
  std::size_t length = buffer.size();
  try {
    if (codes_get_string(handle_.get(), key, buffer.data(), &length) != CODES_SUCCESS) return "unknown";
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
  buffer.back() = '\0';
  return buffer.data();
}

std::vector<double> Handle::values(std::size_t count) const {
  constexpr double kMissing = -1e100;
  std::vector<double> values;
  try {
    codes_set_double(handle_.get(), "missingValue", kMissing);
    std::size_t stated = 0;
    if (const int code = codes_get_size(handle_.get(), "values", &stated); code != CODES_SUCCESS)
      fail(fmt::format("has damaged data ({})", codes_get_error_message(code)));
    if (stated != count) fail(fmt::format("holds {} values where its grid has {} points", stated, count));
    values.resize(count);
    std::size_t length = count;
    const int code = codes_get_double_array(handle_.get(), "values", values.data(), &length);
    if (code != CODES_SUCCESS) fail(fmt::format("has damaged data ({})", codes_get_error_message(code)));
    if (length != count) fail(fmt::format("holds {} values where its grid has {} points", length, count));
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
  for (double& value : values)
    if (value == kMissing || !std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return values;
}

}  // namespace cloudgen::input::grib
