// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netcdf.h>

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cloudgen::test {

/// A variable of a netCDF file to be made; values run with the last dimension fastest.
struct NetcdfVariable {
  std::string name;
  std::vector<std::string> dimensions;
  std::map<std::string, std::string> texts;
  std::vector<double> values;
  std::map<std::string, std::vector<double>> numbers;
  nc_type type = NC_DOUBLE;
  bool chunked = false;  ///< in chunks of one value, so that nothing is stored before it is written
};

struct NetcdfFile {
  std::vector<std::pair<std::string, std::size_t>> dimensions;
  std::vector<NetcdfVariable> variables;
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
  int format = NC_NETCDF4;

  NetcdfVariable& variable(const std::string& name) {
    for (NetcdfVariable& found : variables)
      if (found.name == name) return found;
    throw std::runtime_error("no variable " + name);
  }
  void drop(const std::string& name) {
    std::erase_if(variables, [&](const NetcdfVariable& variable) { return variable.name == name; });
  }
};

/// Writes the file by netCDF-C.
inline void writeNetcdf(const std::filesystem::path& path, const NetcdfFile& file) {
  const auto check = [](int status) {
    if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
  };
  int id = 0;
  check(nc_create(path.c_str(), NC_CLOBBER | file.format, &id));
  std::map<std::string, int> dimensionIds;
  for (const auto& [name, length] : file.dimensions)
    check(nc_def_dim(id, name.c_str(), length, &dimensionIds[name]));
  for (const auto& [name, text] : file.texts)
    check(nc_put_att_text(id, NC_GLOBAL, name.c_str(), text.size(), text.data()));
  for (const auto& [name, number] : file.numbers)
    check(nc_put_att_double(id, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &number));
  std::vector<int> ids;
  for (const NetcdfVariable& variable : file.variables) {
    std::vector<int> dimensions;
    for (const std::string& name : variable.dimensions) dimensions.push_back(dimensionIds.at(name));
    int made = 0;
    check(nc_def_var(id, variable.name.c_str(), variable.type, static_cast<int>(dimensions.size()),
                     dimensions.data(), &made));
    ids.push_back(made);
    if (variable.chunked)
      check(nc_def_var_chunking(id, made, NC_CHUNKED, std::vector<std::size_t>(dimensions.size(), 1).data()));
    for (const auto& [name, text] : variable.texts)
      check(nc_put_att_text(id, made, name.c_str(), text.size(), text.data()));
    for (const auto& [name, numbers] : variable.numbers) {
      const bool ofItsType = name == "_FillValue" || name == "missing_value";
      check(nc_put_att_double(id, made, name.c_str(), ofItsType ? variable.type : NC_DOUBLE, numbers.size(),
                              numbers.data()));
    }
  }
  check(nc_enddef(id));
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (!file.variables[i].values.empty())
      check(nc_put_var_double(id, ids[i], file.variables[i].values.data()));
  check(nc_close(id));
}

}  // namespace cloudgen::test
