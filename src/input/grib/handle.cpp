// SPDX-License-Identifier: Apache-2.0
#include "input/grib/handle.hpp"

#include <eccodes.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>

#include "base/error.hpp"
#include "input/grib/packing_check.hpp"

namespace cloudgen::input::grib {
namespace {

/// ecCodes calls this where it would abort; what it was doing leaks, which is the smaller harm.
void throwAssertion(const char* message) {
  throw base::InputError("GRIB message", fmt::format("ecCodes gives up on it ({})", message),
                         "fetch the file again");
}

/// ecCodes may read past the end of a damaged message before it notices; so far at least it finds zeros.
/// Values of up to 32 bits may follow from any offset of two octets in second order packing.
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

/// A number big-endian.
std::string octets(std::uint64_t value, std::size_t length) {
  std::string text(length, '\0');
  for (std::size_t i = 0; i < length; ++i) text[length - 1 - i] = static_cast<char>(value >> (8 * i));
  return text;
}

std::string section(std::uint64_t number, const std::string& content) {
  return octets(content.size() + 5, 4) + octets(number, 1) + content;
}

std::string message2(int discipline, const std::string& sections) {
  return "GRIB" + octets(0xffff, 2) + octets(static_cast<std::uint64_t>(discipline), 1) + octets(2, 1) +
         octets(16 + sections.size() + 4, 8) + sections + "7777";
}

/// One row of `count` points.
std::string plainGrid(std::size_t count) {
  return section(3, octets(0, 1) + octets(count, 4) + octets(0, 4) + octets(6, 1) + std::string(15, '\0') +
                        octets(count, 4) + octets(1, 4) + std::string(34, '\0'));
}

/// The packed values of a field of edition 2, as temperature on a plain grid.
std::string valuesMessage2(const std::array<std::string, 8>& sections, std::size_t count) {
  const std::string origin =
      section(1, octets(255, 2) + octets(0, 2) + octets(4, 1) + octets(0, 1) + octets(1, 1) +
                     octets(2000, 2) + octets(1, 1) + octets(1, 1) + std::string(5, '\0'));
  const std::string product =
      section(4, octets(0, 4) + std::string(4, '\0') + octets(255, 1) + std::string(3, '\0') + octets(1, 1) +
                     octets(0, 4) + octets(1, 1) + octets(0, 5) + octets(255, 1) + octets(0, 5));
  return message2(0, origin + plainGrid(count) + product + sections[5] + sections[6] + sections[7]);
}

std::string message1(const std::array<std::string, 8>& sections) {
  std::size_t length = kPadding + 4;
  for (const std::string& one : sections) length += one.size();
  std::string bytes;
  bytes.reserve(length);  // copied once: data are megabytes
  for (const std::size_t number : {0, 1, 2, 3, 4}) bytes += sections[number];
  bytes += "7777";
  return bytes;
}

/// Octets that ecCodes may look at past the end of a message: up to a word a value where GRIB1 is packed by
/// second order (section 4, octet 4).
std::size_t paddingOf(const FieldLocation& location, const std::array<std::string, 8>& sections,
                      std::size_t count) {
  constexpr char kSecondOrder = 0x40;
  const bool second = location.edition == 1 && sections[4].size() > 3 && (sections[4][3] & kSecondOrder) != 0;
  return second ? 2 * kPadding + 4 * count : kPadding;
}

/// A handle of ecCodes over bytes that it keeps.
class Handle {
 public:
  Handle(std::string bytes, std::string where, std::size_t padding = kPadding)
      : bytes_(std::move(bytes)), where_(std::move(where)) {
    codes_context* context = quietContext();
    const std::size_t size = bytes_.size();
    bytes_.resize(size + padding);
    handle_ = guarded([&] { return codes_handle_new_from_message(context, bytes_.data(), size); });
    if (!handle_) fail("cannot be decoded by ecCodes");
  }
  ~Handle() {
    try {
      codes_handle_delete(handle_);
    } catch (const base::InputError&) {
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  /// Runs a step of ecCodes; a failed assertion in it becomes an error that names this message.
  template <class Step>
  std::invoke_result_t<Step> guarded(const Step& step) const {
    try {
      return step();
    } catch (const base::InputError& error) {
      fail(error.problem());
    }
  }

  codes_handle* get() const { return handle_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw base::InputError(where_, what, "fetch the file again");
  }

 private:
  std::string bytes_, where_;
  codes_handle* handle_ = nullptr;
};

}  // namespace

std::vector<double> decodedValues(const FieldLocation& location, std::size_t count) {
  std::vector<double> values;
  decodeValues(location, count, values);
  for (double& value : values)
    if (value == kMissingValue || !std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return values;
}

void decodeValues(const FieldLocation& location, std::size_t count, std::vector<double>& values) {
  std::array<std::string, 8> sections = readSections(location);
  checkPacking(location, sections, count);
  const Handle handle(location.edition == 1 ? message1(sections) : valuesMessage2(sections, count),
                      location.name(), paddingOf(location, sections, count));
  sections = {};
  values.resize(count);
  std::size_t stated = 0, read = count;
  const int code = handle.guarded([&] {
    codes_set_double(handle.get(), "missingValue", kMissingValue);
    const int sized = codes_get_size(handle.get(), "values", &stated);
    if (sized != CODES_SUCCESS || stated != count) return sized;
    return codes_get_double_array(handle.get(), "values", values.data(), &read);
  });
  if (code != CODES_SUCCESS) handle.fail(fmt::format("has damaged data ({})", codes_get_error_message(code)));
  if (stated != count || read != count)
    handle.fail(fmt::format("holds {} values where its grid has {} points", std::min(stated, read), count));
}

std::string shortNameOf(const FieldHead& head) {
  const bool first = head.location.edition == 1;
  std::string bytes;
  if (first) {
    std::string product = *head.identification;
    product[7] = '\0';  // no sections 2 and 3
    bytes = product + octets(12, 3) + std::string(9, '\0') + "7777";
    bytes = "GRIB" + octets(8 + bytes.size(), 3) + octets(1, 1) + bytes;
  } else {
    const std::string constant = octets(1, 4) + octets(0, 2) + std::string(10, '\0');
    bytes = message2(head.discipline, *head.identification + plainGrid(1) + *head.product +
                                          section(5, constant) + section(6, octets(255, 1)) + section(7, ""));
  }
  try {
    const Handle handle(bytes, head.location.name());
    std::array<char, 512> buffer{};
    std::size_t length = buffer.size();
    const int code =
        handle.guarded([&] { return codes_get_string(handle.get(), "shortName", buffer.data(), &length); });
    buffer.back() = '\0';
    if (code == CODES_SUCCESS) return buffer.data();
  } catch (const base::InputError&) {
  }
  return "unknown";
}

}  // namespace cloudgen::input::grib
