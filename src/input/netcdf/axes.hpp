// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "input/netcdf/file.hpp"

namespace cloudgen::input::netcdf {

/// What a coordinate variable measures.
enum class Kind {
  None,
  Latitude,
  Longitude,
  ProjectionX,
  ProjectionY,
  Vertical,
  Time,       ///< valid time
  Reference,  ///< start of the forecast
  Period,     ///< from there to the valid time
  Member
};

/// By standard_name, axis, units, positive, and the usual names.
Kind kindOf(const Variable& variable);

/// What a dimension runs along.
enum class Role { Other, X, Y, Point, Vertical, Time, Step, Member, Version };

/// What each dimension of a file runs along, told by its coordinates first and by its name last.
class Axes {
 public:
  explicit Axes(const File& file);
  Role role(std::size_t dimension) const { return roles_[dimension]; }
  /// kindOf() a variable of the file, told once.
  Kind kind(const Variable& variable) const;
  /// The 1-D variable along a dimension that measures one of the kinds; the one named like it is preferred.
  /// Null if there is none.
  const Variable* along(std::size_t dimension, std::initializer_list<Kind> kinds) const;
  /// A variable without dimensions (or all of length 1) of that kind; null if there is none.
  const Variable* scalar(Kind kind) const;

 private:
  void takeCoordinates();
  void takePairsOfTwoDimensions();
  void takeNames();

  const File& file_;
  std::vector<Role> roles_;
  std::vector<Kind> kinds_;  ///< of the variables, in their order
};

/// A variable and which of its dimensions (counted in its own order) runs along what.
struct Placed {
  const Variable* variable = nullptr;
  std::optional<std::size_t> x, y, point, vertical, time, step, member, version;

  bool isHorizontal() const { return (x && y) || point; }
};

/// Nothing if the variable has dimensions (longer than 1) that cannot be told, or two of a kind.
std::optional<Placed> place(const File& file, const Axes& axes, const Variable& variable);

}  // namespace cloudgen::input::netcdf
