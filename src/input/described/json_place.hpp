// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace cloudgen::input {

/// A value within a JSON document that knows its path, so that every complaint names it ("sky.json,
/// /layers/0/cover").
class JsonPlace {
 public:
  /// `hint` says what to do where a member is missing or of the wrong kind.
  JsonPlace(const nlohmann::json& value, std::string file, std::string path = "",
            std::string hint = "see schemas/sky.schema.json")
      : value_(&value), file_(std::move(file)), path_(std::move(path)), hint_(std::move(hint)) {}

  /// Throws InputError here.
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const;

  /// This must be an object with no other keys than these; a mistyped one gets "did you mean".
  void onlyKeys(std::initializer_list<std::string_view> keys) const;
  /// The member of an object; throws if it is not there.
  JsonPlace at(std::string_view key) const;
  std::optional<JsonPlace> ifAny(std::string_view key) const;

  /// This must be an array of `least` to `most` elements; their count.
  std::size_t count(std::size_t least, std::size_t most) const;
  JsonPlace element(std::size_t index) const;

  bool isArray() const { return value_->is_array(); }
  bool isObject() const { return value_->is_object(); }
  bool isNull() const { return value_->is_null(); }
  std::string text(std::size_t longest) const;
  double number(double lowest, double highest) const;
  int integer(int lowest, int highest) const;

 private:
  const nlohmann::json* value_;
  std::string file_, path_, hint_;
};

/// Throws InputError that names the line.
nlohmann::json parseJson(std::string_view text, const std::string& where);

}  // namespace cloudgen::input
