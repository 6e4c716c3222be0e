// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::input::netcdf {

struct Dimension {
  std::string name;
  std::size_t length = 0;
};

/// Either text or numbers.
struct Attribute {
  std::string text;
  std::vector<double> numbers;
  bool floating = false;
};

using Attributes = std::map<std::string, Attribute>;

/// What values a variable holds, as far as it matters here.
enum class Storage { Other, Text, Byte, UnsignedByte, Short, Int, WideInteger, Floating };

struct Variable {
  int group = 0, id = 0;  ///< as netCDF-C counts them
  std::string name;
  Storage storage = Storage::Other;
  std::vector<std::size_t> dimensions;  ///< indices of File::dimensions()
  Attributes attributes;

  bool isNumeric() const { return storage != Storage::Other && storage != Storage::Text; }
  /// The text of an attribute without blanks around it, empty if there is none.
  std::string text(const std::string& attribute) const;
  std::optional<double> number(const std::string& attribute) const;
};

/// The header of an open netCDF file, and its values by hyperslab. Whatever netCDF-C or HDF5 find wrong
/// becomes an InputError. Variables of groups stand beside those of the root. Calls may come from any thread;
/// one at a time is let through, since neither library allows more.
class File {
 public:
  explicit File(const std::filesystem::path& path);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& name() const { return name_; }
  /// "classic", "64-bit offset", "64-bit data" or "netCDF-4".
  const std::string& kind() const { return kind_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const Attributes& attributes() const { return attributes_; }
  /// Null if there is none of that name; one of the root is preferred.
  const Variable* find(std::string_view name) const;

  std::string text(const std::string& globalAttribute) const;
  std::optional<double> number(const std::string& globalAttribute) const;
  std::size_t size(const Variable& variable) const;

  /// The stored numbers of a hyperslab, the last dimension fastest. At most 2^26 of them.
  std::vector<double> stored(const Variable& variable, std::span<const std::size_t> start,
                             std::span<const std::size_t> count) const;
  /// Unpacked values of a hyperslab, NaN where missing: _FillValue, missing_value, valid_min, valid_max,
  /// valid_range, scale_factor and add_offset, _Unsigned (NetCDF Users Guide, attribute conventions).
  std::vector<double> values(const Variable& variable, std::span<const std::size_t> start,
                             std::span<const std::size_t> count) const;
  /// All of a small variable, unpacked. Throws InputError if it has more than 2^26 values.
  std::vector<double> values(const Variable& variable) const;
  /// The rows of a char array.
  std::vector<std::string> texts(const Variable& variable) const;

  /// "a.nc, variable clwc".
  std::string where(const Variable& variable) const;

 private:
  void open();
  void touchValues() const;
  void readGroup(int group, int depth);
  void readVariable(int group, int id);
  Attributes readAttributes(int group, int variable, int count) const;
  void check(int status, const std::string& what) const;

  std::filesystem::path path_;
  std::string name_, kind_;
  int id_ = -1;
  std::vector<Dimension> dimensions_;
  std::map<int, std::size_t> dimensionOfId_;
  std::vector<Variable> variables_;
  Attributes attributes_;
};

}  // namespace cloudgen::input::netcdf
