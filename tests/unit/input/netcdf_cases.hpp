// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "input/netcdf/netcdf.hpp"
#include "support/made_netcdf.hpp"
#include "support/scratch.hpp"

namespace cloudgen::test {

/// The value of the test files at a column, row, level and time.
inline double caseValue(std::size_t column, std::size_t row, std::size_t level, std::size_t time) {
  return 1e-6 * (1 + static_cast<double>(column) + 10 * static_cast<double>(row) +
                 100 * static_cast<double>(level) + 1000 * static_cast<double>(time));
}

/// Values over dimensions in any order, told by their names: "lon" or "x", "lat" or "y", "level", "time".
inline std::vector<double> caseValues(const NetcdfFile& file, const std::vector<std::string>& dimensions) {
  std::vector<std::size_t> lengths;
  for (const std::string& name : dimensions)
    for (const auto& [found, length] : file.dimensions)
      if (found == name) lengths.push_back(length);
  std::vector<double> values;
  std::vector<std::size_t> index(dimensions.size(), 0);
  const std::size_t total =
      std::accumulate(lengths.begin(), lengths.end(), std::size_t{1}, std::multiplies<>());
  for (std::size_t n = 0; n < total; ++n) {
    std::size_t rest = n, column = 0, row = 0, level = 0, time = 0;
    for (std::size_t i = dimensions.size(); i-- > 0; rest /= lengths[i]) {
      const std::size_t at = rest % lengths[i];
      const std::string& name = dimensions[i];
      if (name == "lon" || name == "x") column = at;
      if (name == "lat" || name == "y") row = at;
      if (name == "level") level = at;
      if (name == "time") time = at;
    }
    values.push_back(caseValue(column, row, level, time));
  }
  return values;
}

/// 4 x 3 cells, 2 pressure levels, 2 times; cloud liquid in the order of dimensions given.
inline NetcdfFile plainFile(const std::vector<std::string>& order = {"time", "level", "lat", "lon"}) {
  NetcdfFile file;
  file.dimensions = {{"time", 2}, {"level", 2}, {"lat", 3}, {"lon", 4}};
  file.variables = {
      {"time", {"time"}, {{"units", "hours since 2020-01-01 00:00:00"}}, {0, 6}},
      {"level", {"level"}, {{"units", "hPa"}}, {500, 850}},
      {"lat", {"lat"}, {{"units", "degrees_north"}}, {50, 48, 46}},
      {"lon", {"lon"}, {{"units", "degrees_east"}}, {10, 12, 14, 16}},
  };
  file.variables.push_back({"clwc", order, {{"units", "kg kg**-1"}}, caseValues(file, order)});
  return file;
}

inline input::model::Contents contentsOf(const NetcdfFile& file, const input::OpenOptions& options = {}) {
  const Scratch scratch;
  const auto path = scratch.path() / "made.nc";
  writeNetcdf(path, file);
  return input::netcdf::readContents({path}, options);
}

inline std::vector<float> read(const input::model::Contents& contents, const input::model::Field& field) {
  return field.read(field::everyCell(contents.grids.at(field.grid)()));
}

inline std::vector<const input::model::Field*> fieldsOf(const input::model::Contents& contents,
                                                        field::Quantity quantity) {
  std::vector<const input::model::Field*> found;
  for (const auto& field : contents.fields)
    if (const auto* other = std::get_if<field::Quantity>(&field.meaning); other && *other == quantity)
      found.push_back(&field);
  return found;
}

inline const input::model::Field* singleOf(const input::model::Contents& contents,
                                           const input::model::Single& single) {
  for (const auto& field : contents.fields)
    if (const auto* other = std::get_if<input::model::Single>(&field.meaning); other && *other == single)
      return &field;
  return nullptr;
}

inline bool warns(const input::model::Contents& contents, const std::string& id) {
  return std::any_of(contents.warnings.begin(), contents.warnings.end(),
                     [&](const field::Warning& warning) { return warning.id == id; });
}

}  // namespace cloudgen::test
