// SPDX-License-Identifier: Apache-2.0
// Any bytes given as a cloud analysis are read or refused with an InputError. An input is used three times:
// as a GRIB file, as a patch on a small good one, and as the raw set of an 8 x 8 mesh, file after file.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "input/cdfs/cdfs.hpp"
#include "support/made_wwmca.hpp"

namespace {

using namespace cloudgen;
namespace fs = std::filesystem;

constexpr int kSize = 8;
const base::UtcTime kHour = base::utcFromCivil(2011, 1, 15, 12);

const fs::path& folder() {
  static const fs::path path = [] {
    const fs::path made = fs::temp_directory_path() / ("cloudgen-fuzz-" + std::to_string(::getpid()));
    fs::create_directory(made);
    std::atexit([] { fs::remove_all(folder()); });
    return made;
  }();
  return path;
}

void readAll(const std::vector<fs::path>& files) {
  try {
    const auto source = input::openCdfs(files, {}, kSize);
    std::vector<std::uint32_t> cells(source->grid().size());
    std::iota(cells.begin(), cells.end(), 0u);
    std::uint32_t last = 0;
    source->visitLayers(cells, [&](const field::StatedLayer& layer) {
      const bool good = layer.cell >= last && layer.cell < cells.size() &&
                        layer.topMeters > layer.baseMeters && layer.baseMeters >= 0 &&
                        layer.topMeters < 40000 && layer.coverFraction > 0 &&
                        layer.coverFraction <= 1.0001f && layer.opticalDepth > 0 &&
                        std::isfinite(layer.opticalDepth) && layer.ageMinutes <= 360;
      if (!good) __builtin_trap();
      last = layer.cell;
    });
  } catch (const base::InputError&) {
  }
}

void readAsGrib(std::string_view bytes) {
  const fs::path file = folder() / "file";
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  readAll({file});
}

/// A few layers in both hemispheres.
std::string goodFile() {
  std::string bytes;
  for (const bool south : {false, true}) {
    test::MadeAnalysis made = test::clearAnalysis(south, kHour, kSize);
    for (int type = 0; type < 10; ++type) {
      const std::size_t slot = made.slot(type % 8, type / 2, type % 4);
      made.type[slot] = static_cast<std::uint8_t>(type);
      made.amount[slot] = 60;
      made.base[slot] = static_cast<std::int16_t>(1000 * type);
      made.top[slot] = static_cast<std::int16_t>(1000 * type + 1500);
      made.opticalDepthTimesTen[slot] = 50;
    }
    bytes += test::wwmcaGrib(made);
  }
  return bytes;
}

/// Overwrites bytes of a good file: each four bytes of the input are a place (three) and a value (one).
std::string patched(std::string bytes, const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i + 3 < size; i += 4)
    bytes[(data[i] | data[i + 1] << 8 | data[i + 2] << 16) % bytes.size()] = static_cast<char>(data[i + 3]);
  return bytes;
}

void readAsRaw(std::string_view bytes) {
  constexpr std::size_t kCells = kSize * kSize;
  std::vector<fs::path> files;
  const auto take = [&](const char* name, std::size_t due) {
    files.push_back(folder() / name);
    const std::string_view part = bytes.substr(0, due);
    std::ofstream(files.back(), std::ios::binary | std::ios::trunc) << part;
    bytes.remove_prefix(part.size());
  };
  take("WWMCA_LYRD_CLOUD_PCTS_NH_2011011512", 4 * kCells);
  take("WWMCA_LYRD_TOPS_HGHTS_NH_2011011512", 8 * kCells);
  take("WWMCA_LYRD_CLOUD_TYPE_NH_2011011512", 4 * kCells);
  if (!bytes.empty()) take("WWMCA_PIXL_TIME_MEANS_NH_2011011512", 4 * kCells);
  if (!bytes.empty()) take("WWMCA_TOTAL_CLOUD_PCT_NH_2011011512", kCells);
  readAll(files);
}

}  // namespace

/// ecCodes itself leaks a little on some damaged messages.
extern "C" const char* __lsan_default_suppressions() { return "leak:libeccodes"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string good = goodFile();
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.find("GRIB") != std::string_view::npos)
    readAsGrib(bytes);
  else
    readAsRaw(bytes);
  if (size > 0 && size <= 256) readAsGrib(patched(good, data, size));
  return 0;
}
