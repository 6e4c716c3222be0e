// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check/rules/node_table.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// What the rules need to know about the value of one field; the value itself is not kept.
struct FieldFacts {
  const FieldKind* field = nullptr;
  Position where;
  std::uint64_t numbers = 0;
  std::uint64_t tuples = 0;  ///< complete ones
  std::array<double, 4> first{};
  double low = 0, high = 0, sum = 0;  ///< of the numbers; not of lists of points or colours
  bool increasing = true;             ///< no number is less than the one before
  bool truth = false;                 ///< of an SFBool
  std::uint64_t zeroAxes = 0;         ///< rotations about (0, 0, 0)
  std::uint64_t runs = 0;             ///< of an index list: faces or lines, parted by -1
  std::uint64_t shortestRun = 0;      ///< indices in the shortest of them
  bool readable = true;               ///< no finding about its form
};

/// Reads the value of a field: reports what has the wrong form (number, number-not-finite, number-count,
/// string-unquoted, boolean) and returns what the rules need.
FieldFacts readField(const FieldKind& field, std::string_view value, Position where, FindingList& findings);

/// The strings of an MFString ("a" "b"), escapes undone. False if they are not all quoted.
bool splitStrings(std::string_view value, std::vector<std::string>& strings);

}  // namespace cloudgen::check
