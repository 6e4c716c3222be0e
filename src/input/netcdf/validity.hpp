// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "field/source.hpp"
#include "input/netcdf/axes.hpp"

namespace cloudgen::input::netcdf {

/// When the slices of a variable are valid, and when their forecast started.
class Validity {
 public:
  Validity(const File& file, const Axes& axes, const Placed& placed, std::vector<field::Warning>& warnings);

  /// Nothing: the file says no time for it. `lost` tells that it should but the value is missing.
  struct Moment {
    std::optional<base::UtcTime> valid, run;
    bool lost = false;
  };
  Moment at(std::size_t time, std::size_t step) const;

 private:
  /// Numbers of a variable over none, one or both of the dimensions of time and step.
  struct Series {
    std::vector<std::optional<double>> seconds;
    std::size_t timeStride = 0, stepStride = 0;
    std::optional<double> at(std::size_t time, std::size_t step) const;
  };

  const Variable* find(Kind kind) const;
  bool covers(const Variable& variable) const;
  Series read(const Variable& variable, bool moment);

  const File& file_;
  const Axes& axes_;
  std::vector<field::Warning>& warnings_;
  std::optional<std::size_t> time_, step_;
  std::string named_;
  std::optional<Series> valid_, reference_, period_;
};

}  // namespace cloudgen::input::netcdf
