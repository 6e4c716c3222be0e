// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/netcdf.hpp"

#include <cassert>
#include <new>

#include "base/error.hpp"
#include "input/model/model_source.hpp"
#include "input/netcdf/cf.hpp"
#include "input/netcdf/classic_header.hpp"
#include "input/netcdf/wrf.hpp"

namespace cloudgen::input {
namespace netcdf {
namespace {

/// The first attribute that says who made the file, in one line.
std::string modelName(const File& file) {
  for (const char* name : {"TITLE", "model", "source", "institution", "title"}) {
    std::string text = file.text(name);
    text = text.substr(0, std::min<std::size_t>(text.find('\n'), 80));
    if (!text.empty()) return text;
  }
  return file.text("history").find("ecmwf") != std::string::npos ? "ECMWF, by its history" : "unknown";
}

}  // namespace

model::Contents readContents(const std::vector<std::filesystem::path>& files, const OpenOptions& options) {
  Builder builder;
  model::Contents& contents = builder.contents;
  for (const std::filesystem::path& path : files) {
    const auto file = std::make_shared<const File>(path);
    contents.files.push_back(path.string());
    if (contents.format.empty()) contents.format = "NetCDF " + file->kind();
    if (contents.model.empty()) contents.model = modelName(*file);
    if (isWrf(*file))
      addWrf(file, builder);
    else
      addCf(file, options, builder);
  }
  return std::move(contents);
}

}  // namespace netcdf

bool isNetcdf(std::string_view firstBytes) {
  constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";
  if (netcdf::isClassic(firstBytes)) return true;
  // HDF5 may keep a block of the user's before its own.
  for (const std::size_t start : {0, 512, 1024, 2048})
    if (firstBytes.size() > start && firstBytes.substr(start).starts_with(kHdf5)) return true;
  return false;
}

std::unique_ptr<field::Source> openNetcdf(const std::vector<std::filesystem::path>& files,
                                          const OpenOptions& options) {
  assert(!files.empty());
  try {
    return model::makeSource(netcdf::readContents(files, options), options);
  } catch (const std::bad_alloc&) {
    throw base::InputError(files.front().string(), "needs more memory than there is", "give smaller files");
  }
}

}  // namespace cloudgen::input
