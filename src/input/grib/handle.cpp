// SPDX-License-Identifier: Apache-2.0
#include "input/grib/handle.hpp"

#include <eccodes.h>
#include <fmt/format.h>

#include <algorithm>
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

/// ecCodes may read past the end of a damaged message before it notices; so far at least it finds zeros.
constexpr std::size_t kPadding = 65536;

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

void Handle::fail(const std::string& what) const {
  throw base::InputError(location_.name(), what, "fetch the file again");
}

/// Runs a step of ecCodes; a failed assertion in it becomes an error that names this message.
template <class Step>
auto Handle::guarded(const Step& step) const {
  try {
    return step();
  } catch (const base::InputError& error) {
    fail(error.problem());
  }
}

Handle::Handle(const FieldLocation& location) : location_(location), bytes_(readField(location)) {
  codes_context* context = quietContext();
  const std::size_t size = bytes_.size();
  bytes_.resize(size + kPadding);
  grib_handle* handle = guarded([&] { return codes_handle_new_from_message(context, bytes_.data(), size); });
  if (!handle) fail("cannot be decoded by ecCodes");
  handle_ = std::shared_ptr<grib_handle>(handle, [](grib_handle* h) { codes_handle_delete(h); });
}

bool Handle::present(const char* key) const {
  int code = CODES_SUCCESS;
  const int missing = codes_is_missing(handle_.get(), key, &code);
  return code == CODES_SUCCESS && !missing;
}

std::optional<long> Handle::integerIfAny(const char* key) const {
  long value = 0;
  const bool read =
      guarded([&] { return present(key) && codes_get_long(handle_.get(), key, &value) == CODES_SUCCESS; });
  return read ? std::optional(value) : std::nullopt;
}

std::optional<double> Handle::numberIfAny(const char* key) const {
  double value = 0;
  const bool read =
      guarded([&] { return present(key) && codes_get_double(handle_.get(), key, &value) == CODES_SUCCESS; });
  return read && std::isfinite(value) ? std::optional(value) : std::nullopt;
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
  const int code = guarded([&] { return codes_get_string(handle_.get(), key, buffer.data(), &length); });
  if (code != CODES_SUCCESS) return "unknown";
  buffer.back() = '\0';
  return buffer.data();
}

/// Bits that simply packed values need must be there: ecCodes takes them without looking.
void Handle::checkPacking() const {
  if (text("packingType") != "grid_simple") return;
  const long bits = integer("bitsPerValue"), coded = integer("numberOfCodedValues");
  const bool first = location_.edition == 1;
  const long length = first ? integer("section4Length") : static_cast<long>(location_.sections.back().length);
  const long room = length - (first ? 11 : 5);
  if (bits < 0 || bits > 64 || coded < 0 || coded > (long{1} << 32) || (bits * coded + 7) / 8 > room)
    fail(fmt::format("has a data section too short for {} values of {} bits", coded, bits));
}

std::vector<double> Handle::values(std::size_t count) const {
  std::vector<double> values;
  readValues(values, count);
  for (double& value : values)
    if (value == kMissing || !std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return values;
}

void Handle::readValues(std::vector<double>& values, std::size_t count) const {
  checkPacking();
  values.resize(count);
  std::size_t stated = 0, read = count;
  const int code = guarded([&] {
    codes_set_double(handle_.get(), "missingValue", kMissing);
    const int sized = codes_get_size(handle_.get(), "values", &stated);
    if (sized != CODES_SUCCESS || stated != count) return sized;
    return codes_get_double_array(handle_.get(), "values", values.data(), &read);
  });
  if (code != CODES_SUCCESS) fail(fmt::format("has damaged data ({})", codes_get_error_message(code)));
  if (stated != count || read != count)
    fail(fmt::format("holds {} values where its grid has {} points", std::min(stated, read), count));
}

}  // namespace cloudgen::input::grib
