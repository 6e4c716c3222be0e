// SPDX-License-Identifier: Apache-2.0
#include "input/catalogue.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "base/error.hpp"
#include "input/described/described.hpp"
#include "input/grib/grib.hpp"
#include "input/metar/metar.hpp"
#include "input/netcdf/netcdf.hpp"
#include "input/weather_code/weather_code.hpp"

namespace cloudgen::input {
namespace {

struct Reader {
  std::string_view name;
  bool (*recognises)(std::string_view firstBytes);
  std::unique_ptr<field::Source> (*open)(const std::vector<std::filesystem::path>& files,
                                         const OpenOptions& options);
};

/// One line a format; the first that recognises a file reads it.
constexpr std::array<Reader, 5> kReaders{{
    {"described sky", isDescribedSky, openDescribedSky},
    {"weather codes", isWeatherCode, openWeatherCode},
    {"NetCDF", isNetcdf, openNetcdf},  // before GRIB, whose name stands in files made by cfgrib
    {"GRIB", isGrib, openGrib},
    {"METAR", isMetar, openMetar},
}};

std::string firstBytesOf(const std::filesystem::path& file) {
  constexpr std::streamsize kBytes = 4096;
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw base::InputError(file.string(), "no such file", "check the path");
  if (std::filesystem::is_directory(status))
    throw base::InputError(file.string(), "is a folder", "name the files in it");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(kBytes, '\0');
  stream.read(bytes.data(), kBytes);
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (!stream && !stream.eof())
    throw base::InputError(file.string(), "cannot be read", "check its permissions");
  if (bytes.empty()) throw base::InputError(file.string(), "is empty", "fetch or make the file again");
  return bytes;
}

const Reader& readerOf(const std::filesystem::path& file) {
  const std::string bytes = firstBytesOf(file);
  for (const Reader& reader : kReaders)
    if (reader.recognises(bytes)) return reader;
  throw base::InputError(
      file.string(), "is of no format that cloudgen reads",
      "give GRIB or NetCDF model output, WWMCA cloud analyses, METAR reports, weather codes "
      "(JSON) or a described sky (*.sky.json)");
}

}  // namespace

std::unique_ptr<field::Source> open(const std::vector<std::filesystem::path>& files,
                                    const OpenOptions& options) {
  if (files.empty())
    throw base::UsageError("input", "no file is named", "name a GRIB file or a described sky");
  const Reader& reader = readerOf(files.front());
  for (const auto& file : files)
    if (const Reader& other = readerOf(file); other.name != reader.name)
      throw base::InputError(
          file.string(), fmt::format("is {}, but {} is {}", other.name, files.front().string(), reader.name),
          "give files of one format at a time");
  auto source = reader.open(files, options);
  if (options.time && source->info().validTime != *options.time)
    throw base::InputError(files.front().string(), "has no data for " + base::isoText(*options.time),
                           "it is valid at " + base::isoText(source->info().validTime));
  return source;
}

}  // namespace cloudgen::input
