// SPDX-License-Identifier: Apache-2.0
#include "input/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.hpp"
#include "input/cdfs/cdfs.hpp"
#include "input/described/described.hpp"
#include "input/grib/grib.hpp"
#include "input/metar/metar.hpp"
#include "input/netcdf/netcdf.hpp"
#include "input/weather_code/weather_code.hpp"

namespace cloudgen::input {
namespace {

/// A path that some reader may know: a file by its first bytes (or its name), a folder by what is in it.
struct Candidate {
  std::filesystem::path path;
  bool isFolder = false;
  std::string firstBytes;  ///< of a file
};

template <bool (*kTold)(std::string_view firstBytes)>
bool byContent(const Candidate& candidate) {
  return !candidate.isFolder && kTold(candidate.firstBytes);
}

bool isCdfsFile(const Candidate& candidate) {
  return !candidate.isFolder && isCdfs(candidate.path, candidate.firstBytes);
}

struct Reader {
  std::string_view name;
  bool (*recognises)(const Candidate& candidate);
  std::unique_ptr<field::Source> (*open)(const std::vector<std::filesystem::path>& files,
                                         const OpenOptions& options);
};

/// One line a format; the first that recognises a path reads it.
constexpr std::array kReaders{
    Reader{"CDFS II", isCdfsFile, openCdfs},
    Reader{"described sky", byContent<isDescribedSky>, openDescribedSky},
    Reader{"weather codes", byContent<isWeatherCode>, openWeatherCode},
    // Before GRIB, whose name stands in files made by cfgrib.
    Reader{"NetCDF", byContent<isNetcdf>, openNetcdf},
    Reader{"GRIB", byContent<isGrib>, openGrib},
    Reader{"METAR", byContent<isMetar>, openMetar},
};

std::string firstBytesOf(const std::filesystem::path& file) {
  constexpr std::streamsize kBytes = 4096;
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(kBytes, '\0');
  stream.read(bytes.data(), kBytes);
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (!stream && !stream.eof())
    throw base::InputError(file.string(), "cannot be read", "check its permissions");
  return bytes;
}

Candidate candidateOf(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw base::InputError(path.string(), "no such file", "check the path");
  if (std::filesystem::is_directory(status)) return {path, true, {}};
  return {path, false, firstBytesOf(path)};
}

const Reader* readerOf(const Candidate& candidate) {
  for (const Reader& reader : kReaders)
    if (reader.recognises(candidate)) return &reader;
  return nullptr;
}

/// A path with the reader that knows it.
struct Known {
  std::filesystem::path path;
  const Reader* reader = nullptr;
};

/// The files in a folder that a reader knows, by name.
std::vector<Known> knownIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (entry->is_regular_file()) files.push_back(entry->path());
  if (error) throw base::InputError(folder.string(), "cannot be read", "check its permissions");
  std::sort(files.begin(), files.end());
  std::vector<Known> known;
  for (const auto& file : files)
    if (const Reader* reader = readerOf(candidateOf(file))) known.push_back({file, reader});
  if (known.empty())
    throw base::InputError(folder.string(), "is a folder without a file that cloudgen reads",
                           "name the files, or the folder that they are in");
  return known;
}

std::vector<Known> knownAs(const std::filesystem::path& path) {
  const Candidate candidate = candidateOf(path);
  if (const Reader* reader = readerOf(candidate)) return {{path, reader}};
  if (candidate.isFolder) return knownIn(path);
  if (candidate.firstBytes.empty())
    throw base::InputError(path.string(), "is empty", "fetch or make the file again");
  throw base::InputError(
      path.string(), "is of no format that cloudgen reads",
      "give GRIB or NetCDF model output, WWMCA cloud analyses, METAR reports, weather codes "
      "(JSON) or a described sky (*.sky.json)");
}

}  // namespace

std::unique_ptr<field::Source> open(const std::vector<std::filesystem::path>& files,
                                    const OpenOptions& options) {
  if (files.empty())
    throw base::UsageError("input", "no file is named",
                           "name model output, a cloud analysis, reports or a described sky");
  std::vector<Known> known;
  for (const auto& file : files)
    for (Known& one : knownAs(file)) known.push_back(std::move(one));
  const Known& first = known.front();
  std::vector<std::filesystem::path> paths;
  for (const Known& one : known) {
    if (one.reader != first.reader)
      throw base::InputError(
          one.path.string(),
          fmt::format("is {}, but {} is {}", one.reader->name, first.path.string(), first.reader->name),
          "give files of one format at a time");
    paths.push_back(one.path);
  }
  auto source = first.reader->open(paths, options);
  if (options.time && source->info().validTime != *options.time)
    throw base::InputError(files.front().string(), "has no data for " + base::isoText(*options.time),
                           "it is valid at " + base::isoText(source->info().validTime));
  return source;
}

}  // namespace cloudgen::input
