// SPDX-License-Identifier: Apache-2.0
#include "input/grib/grib.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "input/grib/selection.hpp"

namespace cloudgen::input {
namespace {

using namespace grib;
using field::Quantity;

class GribSource : public field::Source {
 public:
  GribSource(Selection selection, const std::vector<std::filesystem::path>& files)
      : selection_(std::move(selection)) {
    const Handle leading(selection_.cloudWater().location);
    stored_ = readGrid(leading);
    for (const auto& file : files) info_.files.push_back(file.string());
    info_.format = leading.location().edition == 1 ? "GRIB1" : "GRIB2";
    info_.model = modelName(leading);
    info_.run = selection_.run;
    info_.validTime = selection_.valid;
    info_.fields = fieldLines(selection_);
    info_.missing = missingLines(selection_);
    info_.validTimes = {selection_.valid};
    for (const std::string& text : selection_.warnings) info_.warnings.push_back({"", text});
    for (const auto& [pressure, fields] : selection_.levels)
      if (fields.contains(Quantity::CloudCondensate) || fields.contains(Quantity::CloudLiquid) ||
          fields.contains(Quantity::CloudIce))
        info_.levels.values.push_back(pressure / 100);
    info_.levels.kind = "pressure";
    info_.levels.unit = "hPa";
    mistrustPercent();
  }

  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return stored_.grid; }

  field::Telling telling() const override { return field::Telling::Levels; }

  void visitLevels(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::Level&)>& visit) const override {
    for (const auto& [pressure, fields] : selection_.levels) {
      field::Level level{pressure, {}};
      for (const auto& [quantity, header] : fields) level.values.emplace(quantity, valuesAt(header, cells));
      visit(level);
    }
  }

  field::Surface surface(std::span<const std::uint32_t> cells) const override {
    field::Surface surface;
    if (selection_.surfaceHeight) surface.heightMeters = valuesAt(*selection_.surfaceHeight, cells);
    if (selection_.surfacePressure) surface.pressurePa = valuesAt(*selection_.surfacePressure, cells);
    return surface;
  }

 private:
  std::vector<float> valuesAt(const FieldHeader& header, std::span<const std::uint32_t> cells) const {
    const std::vector<double> all = Handle(header.location).values(stored_.size());
    std::vector<float> chosen;
    chosen.reserve(cells.size());
    for (const std::uint32_t cell : cells) {
      assert(cell < stored_.grid.size());
      const double value = all[stored_.place(cell)] * header.factor;
      const bool fits = std::abs(value) < std::numeric_limits<float>::max();
      chosen.push_back(fits ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN());
    }
    return chosen;
  }

  /// Some models write cover as 0..1 under a parameter that is defined in per cent: if no level passes 1, it
  /// is so.
  void mistrustPercent() {
    bool inPercent = false;
    for (const auto& [pressure, fields] : selection_.levels) {
      const auto found = fields.find(Quantity::CloudFraction);
      if (found == fields.end() || found->second.factor == 1) continue;
      inPercent = true;
      const std::vector<double> values = Handle(found->second.location).values(stored_.size());
      if (std::any_of(values.begin(), values.end(), [](double value) { return value > 1.01; })) return;
    }
    if (!inPercent) return;
    for (auto& [pressure, fields] : selection_.levels)
      if (const auto found = fields.find(Quantity::CloudFraction); found != fields.end())
        found->second.factor = 1;
    info_.warnings.push_back(
        {"cover_in_percent",
         "cloud fraction is defined in per cent but never passes 1: it is taken as 0..1"});
  }

  Selection selection_;
  StoredGrid stored_;
  field::SourceInfo info_;
};

}  // namespace

bool isGrib(std::string_view firstBytes) { return startsLikeGrib(firstBytes); }

std::unique_ptr<field::Source> openGrib(const std::vector<std::filesystem::path>& files, const OpenOptions&) {
  assert(!files.empty());
  std::vector<FieldHeader> headers;
  for (const auto& file : files)
    for (const FieldLocation& location : locateFields(file)) headers.push_back(readHeader(Handle(location)));
  const std::string where =
      files.size() == 1 ? files.front().string() : fmt::format("{} GRIB files", files.size());
  if (headers.empty())
    throw base::InputError(where, "holds no GRIB message", "check that it is the right file");
  return std::make_unique<GribSource>(select(headers, where), files);
}

}  // namespace cloudgen::input
