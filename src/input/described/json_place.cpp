// SPDX-License-Identifier: Apache-2.0
#include "input/described/json_place.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"

namespace cloudgen::input {
namespace {

/// Text of the input as it may stand in a message: short and without control characters.
std::string printable(std::string_view text) {
  std::string clean(text.substr(0, 40));
  std::replace_if(
      clean.begin(), clean.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, '?');
  return clean;
}

}  // namespace

void JsonPlace::fail(const std::string& what, const std::string& hint) const {
  throw base::InputError(fmt::format("{}, {}", file_, path_.empty() ? "/" : path_), what, hint);
}

void JsonPlace::onlyKeys(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) fail("is not an object", hint_);
  for (const auto& [key, member] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const std::string nearest = base::nearestWord(key, std::vector<std::string>(keys.begin(), keys.end()));
    fail(fmt::format("has an unknown member \"{}\"", printable(key)),
         nearest.empty() ? hint_ : fmt::format("did you mean \"{}\"?", nearest));
  }
}

std::optional<JsonPlace> JsonPlace::ifAny(std::string_view key) const {
  if (!value_->is_object()) fail("is not an object", hint_);
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPlace(*found, file_, fmt::format("{}/{}", path_, key), hint_);
}

JsonPlace JsonPlace::at(std::string_view key) const {
  const auto member = ifAny(key);
  if (!member) fail(fmt::format("lacks \"{}\"", key), hint_);
  return *member;
}

std::size_t JsonPlace::count(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) fail("is not an array", hint_);
  if (value_->size() < least || value_->size() > most)
    fail(fmt::format("has {} elements", value_->size()),
         least == most ? fmt::format("give {}", least) : fmt::format("give {} to {}", least, most));
  return value_->size();
}

JsonPlace JsonPlace::element(std::size_t index) const {
  return {value_->at(index), file_, fmt::format("{}/{}", path_, index), hint_};
}

std::string JsonPlace::text(std::size_t longest) const {
  if (!value_->is_string()) fail("is not a text", hint_);
  const auto& text = value_->get_ref<const std::string&>();
  if (text.size() > longest)
    fail(fmt::format("is {} bytes long", text.size()), fmt::format("give at most {}", longest));
  return text;
}

double JsonPlace::number(double lowest, double highest) const {
  const std::string range = fmt::format("give a number within {:g} and {:g}", lowest, highest);
  if (!value_->is_number()) fail("is not a number", range);
  const double value = value_->get<double>();
  if (!(value >= lowest && value <= highest)) fail(fmt::format("is {:g}", value), range);
  return value;
}

int JsonPlace::integer(int lowest, int highest) const {
  const double value = number(lowest, highest);
  const int whole = static_cast<int>(value);
  if (whole != value) fail(fmt::format("is {:g}", value), "give a whole number");
  return whole;
}

nlohmann::json parseJson(std::string_view text, const std::string& where) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t byte = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    throw base::InputError(fmt::format("{}, line {}", where, line), "is not JSON",
                           "check the commas, quotes and brackets there");
  } catch (const nlohmann::json::exception&) {
    throw base::InputError(where, "holds a number that is out of range", "give numbers of usual size");
  }
}

}  // namespace cloudgen::input
