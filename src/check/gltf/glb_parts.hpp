// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::check {

/// The two chunks of a binary glTF file and the numbers that its accessors point to. The bytes must outlive
/// it. Everything throws InputError with `where` and `hint`, or json::exception where the JSON has not the
/// form of glTF.
class GlbParts {
 public:
  GlbParts(std::string_view bytes, std::string where, std::string hint);
  ~GlbParts();
  GlbParts(const GlbParts&) = delete;
  GlbParts& operator=(const GlbParts&) = delete;

  const nlohmann::json& root() const { return *root_; }
  /// The values of an accessor of so many components each: floats, or bytes and shorts, normalized ones as 0..1 or
  /// -1..1.
  std::vector<float> floats(std::size_t accessor, std::size_t components) const;
  /// The values of an accessor of unsigned integers.
  std::vector<std::uint32_t> indices(std::size_t accessor) const;
  /// The bytes of a buffer view.
  std::string_view view(std::size_t index) const;
  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  /// The elements of an accessor, all within the binary chunk.
  struct Tuples {
    const char* first = nullptr;
    std::size_t count = 0, stride = 0;
  };
  Tuples tuplesOf(const nlohmann::json& accessor, std::size_t components, std::size_t width) const;

  std::string where_, hint_;
  std::string_view binary_;
  std::unique_ptr<nlohmann::json> root_;
};

}  // namespace cloudgen::check
