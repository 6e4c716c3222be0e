// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "input/model/model_field.hpp"
#include "input/netcdf/horizontal.hpp"

namespace cloudgen::input::netcdf {

/// Gathers what several files hold.
class Builder {
 public:
  /// The index of an equal grid, or of this one made new.
  std::size_t gridIndex(const Horizontal& horizontal);
  void add(model::Field field);
  /// Each text once.
  void addUnused(const std::string& line);
  void warn(const std::string& id, const std::string& text);
  void warn(const std::vector<field::Warning>& warnings);

  model::Contents contents;

 private:
  std::map<std::string, std::size_t> gridOfKey_;
};

}  // namespace cloudgen::input::netcdf
