// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/builder.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace cloudgen::input::netcdf {
namespace {

/// More are not a forecast but damage, and would fill the memory by their headers alone.
constexpr std::size_t kMostFields = 1'000'000;

}  // namespace

std::size_t Builder::gridIndex(const Horizontal& horizontal) {
  const auto [found, isNew] = gridOfKey_.emplace(horizontal.key, contents.grids.size());
  if (isNew) contents.grids.push_back(horizontal.make);
  return found->second;
}

void Builder::add(model::Field field) {
  if (contents.fields.size() >= kMostFields)
    throw base::InputError(field.where, "holds more than a million levels and times",
                           "give fewer files, or fewer times a file");
  contents.fields.push_back(std::move(field));
}

void Builder::addUnused(const std::string& line) {
  if (std::find(contents.unused.begin(), contents.unused.end(), line) == contents.unused.end())
    contents.unused.push_back(line);
}

void Builder::warn(const std::string& id, const std::string& text) {
  const auto same = [&](const field::Warning& warning) { return warning.id == id && warning.text == text; };
  if (std::none_of(contents.warnings.begin(), contents.warnings.end(), same))
    contents.warnings.push_back({id, text});
}

void Builder::warn(const std::vector<field::Warning>& warnings) {
  for (const field::Warning& warning : warnings) warn(warning.id, warning.text);
}

}  // namespace cloudgen::input::netcdf
