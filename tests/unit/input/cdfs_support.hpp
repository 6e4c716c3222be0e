// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numeric>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "input/cdfs/cdfs.hpp"

#include "support/made_wwmca.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {

inline constexpr int kSmall = 16;  ///< cells of 1524 km: the pole is cell (8, 8)
inline const base::UtcTime kNoon = base::utcFromCivil(2011, 1, 15, 12);

/// One layer in one cell of a clear analysis.
struct OneLayer {
  int type = 3, amount = 60;
  int base = 900, top = 1500, opticalDepthTimesTen = 90, ageMinutes = 0;
  int column = 9, row = 9, layer = 0;
};

inline void put(test::MadeAnalysis& made, const OneLayer& one) {
  const std::size_t slot = made.slot(one.column, one.row, one.layer);
  made.type[slot] = static_cast<std::uint8_t>(one.type);
  made.amount[slot] = static_cast<std::uint8_t>(one.amount);
  made.base[slot] = static_cast<std::int16_t>(one.base);
  made.top[slot] = static_cast<std::int16_t>(one.top);
  made.opticalDepthTimesTen[slot] = static_cast<std::uint16_t>(one.opticalDepthTimesTen);
  made.ageMinutes[slot / 4] = static_cast<std::uint16_t>(one.ageMinutes);
  std::uint8_t& total = made.totalCover[slot / 4];
  total = static_cast<std::uint8_t>(std::max<int>(total, one.amount));
}

inline test::MadeAnalysis analysisWith(const std::vector<OneLayer>& layers, bool south = false) {
  test::MadeAnalysis made = test::clearAnalysis(south, kNoon, kSmall);
  for (const OneLayer& layer : layers) put(made, layer);
  return made;
}

inline std::vector<field::StatedLayer> layersOf(const field::Source& source) {
  std::vector<std::uint32_t> cells(source.grid().size());
  std::iota(cells.begin(), cells.end(), 0u);
  std::vector<field::StatedLayer> layers;
  source.visitLayers(cells, [&](const field::StatedLayer& layer) { layers.push_back(layer); });
  return layers;
}

/// The text of the warning of that kind; nothing: "".
inline std::string warningOf(const field::Source& source, const std::string& id) {
  for (const field::Warning& warning : source.info().warnings)
    if (warning.id == id) return warning.text;
  return "";
}

inline bool says(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

inline std::unique_ptr<field::Source> fromGrib(const test::MadeAnalysis& made) {
  const test::Scratch scratch;
  return openCdfs({test::writeWwmcaGrib(made, scratch.path())}, {}, kSmall);
}

inline std::unique_ptr<field::Source> fromRaw(const test::MadeAnalysis& made,
                                              std::endian order = std::endian::big,
                                              const OpenOptions& options = {}) {
  const test::Scratch scratch;
  return openCdfs(test::writeWwmcaRaw(made, scratch.path(), order), options, kSmall);
}

/// What a failing call complains about.
template <class Call>
std::string complaintOf(const Call& call) {
  try {
    call();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace cloudgen::input
