// SPDX-License-Identifier: Apache-2.0
// A box of a large-eddy simulation: cloud water over height, y and x.
#include <cmath>

#include "base/error.hpp"
#include "input/netcdf/file.hpp"
#include "input/netcdf/meanings.hpp"
#include "input/volume/coarse_volume.hpp"
#include "input/volume/volume_file.hpp"

namespace cloudgen::input {
namespace {

using netcdf::File;
using netcdf::Variable;

bool isCloudWater(const Variable& variable) {
  const auto meaning = netcdf::meaningOf(variable, true);
  if (!meaning || !std::holds_alternative<field::Quantity>(meaning->what)) return false;
  const auto quantity = std::get<field::Quantity>(meaning->what);
  return quantity == field::Quantity::CloudLiquid || quantity == field::Quantity::CloudCondensate;
}

bool isBox(const File& file, const Variable& variable) {
  const std::size_t rank = variable.dimensions.size();
  if (rank < 3 || !variable.isNumeric()) return false;
  for (std::size_t i = rank - 3; i < rank; ++i)
    if (file.dimensions()[variable.dimensions[i]].length < 2) return false;
  return true;
}

const Variable& chosen(const File& file, const std::string& wanted) {
  for (const Variable& variable : file.variables())
    if (isBox(file, variable) &&
        (wanted.empty() ? isCloudWater(variable)
                        : variable.name == wanted || variable.text("standard_name") == wanted))
      return variable;
  throw base::InputError(file.name(),
                         wanted.empty() ? "has no cloud water over height, y and x"
                                        : "has no variable " + wanted + " over three dimensions",
                         "name the variable with --shape-variable, or \"variable\" in the recipe");
}

/// Edges of the cells along a dimension, from 0, in metres: halfway between the values of its coordinate;
/// where it has none in metres, cells of 1.
std::vector<double> edgesAlong(const File& file, std::size_t dimension) {
  const std::size_t length = file.dimensions()[dimension].length;
  std::vector<double> middles;
  const Variable* coordinate = file.find(file.dimensions()[dimension].name);
  if (coordinate && coordinate->isNumeric() && coordinate->dimensions == std::vector{dimension}) {
    const auto toMeters = netcdf::conversion(coordinate->text("units"), "m");
    middles = file.values(*coordinate);
    for (double& value : middles) value = toMeters ? toMeters->factor * value : value;
  }
  bool rising = middles.size() == length;
  for (std::size_t i = 1; i < middles.size(); ++i) rising = rising && middles[i] > middles[i - 1];
  std::vector<double> edges(length + 1);
  for (std::size_t i = 0; i <= length; ++i) {
    if (!rising)
      edges[i] = static_cast<double>(i);
    else if (i == 0)
      edges[i] = 0;
    else if (i < length)
      edges[i] = 0.5 * (middles[i - 1] + middles[i]) - (middles[0] - 0.5 * (middles[1] - middles[0]));
    else
      edges[i] = 2 * edges[i - 1] - edges[i - 2];
  }
  return edges;
}

double narrowest(const std::vector<double>& edges) {
  double least = edges.back();
  for (std::size_t i = 1; i < edges.size(); ++i) least = std::min(least, edges[i] - edges[i - 1]);
  return least;
}

}  // namespace

base::Volume readNetcdfVolume(const std::filesystem::path& path, const std::string& wanted) {
  const File file(path);
  const Variable& variable = chosen(file, wanted);
  const std::size_t rank = variable.dimensions.size();
  const std::size_t* const dimension = variable.dimensions.data() + rank - 3;
  const auto up = edgesAlong(file, dimension[0]), north = edgesAlong(file, dimension[1]),
             east = edgesAlong(file, dimension[2]);
  CoarseVolume volume({east.back(), up.back(), north.back()},
                      {narrowest(east), narrowest(up), narrowest(north)});
  std::vector<std::size_t> start(rank, 0), count(rank, 1);
  count[rank - 2] = north.size() - 1, count[rank - 1] = east.size() - 1;
  for (std::size_t level = 0; level + 1 < up.size(); ++level) {
    start[rank - 3] = level;
    const std::vector<double> water = file.values(variable, start, count);
    for (std::size_t row = 0; row + 1 < north.size(); ++row)
      for (std::size_t column = 0; column + 1 < east.size(); ++column) {
        const double q = water[row * (east.size() - 1) + column];
        // Of a given number of droplets: r_e ~ q^1/3, so extinction ~ q / r_e ~ q^2/3 (Martin et al. 1994).
        // z of the shape is south.
        if (q > 0 && std::isfinite(q))
          volume.add({east[column], up[level], north.back() - north[row + 1]},
                     {east[column + 1], up[level + 1], north.back() - north[row]}, std::cbrt(q * q));
      }
  }
  return std::move(volume).volume();
}

}  // namespace cloudgen::input
