// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/raw_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <span>

#include "base/error.hpp"

namespace cloudgen::input::cdfs {
namespace {

struct Form {
  RawField field;
  std::string_view prefix;
  std::size_t bytesPerCell;
  std::string_view what;
};
constexpr std::array kForms{
    Form{RawField::Type, "WWMCA_LYRD_CLOUD_TYPE_", kLayers, "4 layers of one byte"},
    Form{RawField::Amount, "WWMCA_LYRD_CLOUD_PCTS_", kLayers, "4 layers of one byte"},
    Form{RawField::Top, "WWMCA_LYRD_TOPS_HGHTS_", 2 * kLayers, "4 layers of 16 bits"},
    Form{RawField::Time, "WWMCA_PIXL_TIME_MEANS_", 4, "one value of 32 bits"},
    Form{RawField::TotalCover, "WWMCA_TOTAL_CLOUD_PCT_", 1, "one byte"},
};

const Form& formOf(RawField field) {
  return *std::find_if(kForms.begin(), kForms.end(), [&](const Form& form) { return form.field == field; });
}

/// YYYYMMDDHH.
std::optional<base::UtcTime> hourOf(std::string_view digits) {
  long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.size() != 10 || error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  const int hour = static_cast<int>(value % 100), day = static_cast<int>(value / 100 % 100);
  const int month = static_cast<int>(value / 10000 % 100), year = static_cast<int>(value / 1000000);
  if (value < 0 || hour > 23 || day < 1 || day > 31 || month < 1 || month > 12) return std::nullopt;
  return base::utcFromCivil(year, month, day, hour);
}

std::int64_t minutesSince1967(base::UtcTime time) {
  return (time.seconds - base::utcFromCivil(1967, 12, 31).seconds) / 60;
}

void readWhole(const RawFile& file, std::size_t cells, void* target) {
  const Form& form = formOf(file.field);
  const std::size_t due = cells * form.bytesPerCell;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file.path, error);
  if (error)
    throw base::InputError(file.path.string(), "cannot be read", "check the path and its permissions");
  if (size != due)
    throw base::InputError(
        file.path.string(),
        fmt::format("has {} bytes where {} are due ({} in each of {} cells)", size, due, form.what, cells),
        "fetch the file again");
  std::ifstream stream(file.path, std::ios::binary);
  if (!stream.read(static_cast<char*>(target), static_cast<std::streamsize>(due)))
    throw base::InputError(file.path.string(), "cannot be read", "check its permissions");
}

std::int16_t swapped(std::int16_t value) {
  return static_cast<std::int16_t>(__builtin_bswap16(static_cast<std::uint16_t>(value)));
}
std::int32_t swapped(std::int32_t value) {
  return static_cast<std::int32_t>(__builtin_bswap32(static_cast<std::uint32_t>(value)));
}

/// How many of the values are there at all, and plausible as they stand and with their bytes swapped.
struct Plausible {
  std::uint64_t stated = 0, straight = 0, reversed = 0;

  std::endian order() const {
    constexpr bool little = std::endian::native == std::endian::little;
    return (straight >= reversed) == little ? std::endian::little : std::endian::big;
  }
  bool decides() const { return straight != reversed; }
  std::uint64_t in(std::endian order) const { return order == std::endian::native ? straight : reversed; }
};

template <class Value, class Test>
Plausible plausibilityOf(std::span<const Value> values, const Test& test) {
  Plausible found;
  for (const Value value : values) {
    found.stated += value != 0;
    found.straight += value != 0 && test(value);
    found.reversed += value != 0 && test(swapped(value));
  }
  return found;
}

/// The files of one hemisphere while they are read.
class RawSet {
 public:
  RawSet(const std::vector<RawFile>& files, std::size_t half, Analysis& analysis)
      : files_(files), analysis_(analysis), cells_(analysis.mesh.size()), first_(half * cells_) {}

  void read(std::optional<std::endian> forced) {
    std::vector<std::int32_t> times;
    for (const RawFile& file : files_) readOne(file, times);
    const std::endian order = orderOf(times, forced);
    if (order != std::endian::native && !analysis_.top.empty())
      for (std::int16_t& top : tops()) top = swapped(top);
    keepAges(times, order);
  }

 private:
  std::span<std::int16_t> tops() const {
    return std::span(analysis_.top).subspan(first_ * kLayers, cells_ * kLayers);
  }

  void readOne(const RawFile& file, std::vector<std::int32_t>& times) {
    const std::size_t all = analysis_.cells();
    switch (file.field) {
      case RawField::Type:
        Analysis::provide(analysis_.type, all * kLayers, kNotFilled);
        return readWhole(file, cells_, analysis_.type.data() + first_ * kLayers);
      case RawField::Amount:
        Analysis::provide(analysis_.amount, all * kLayers, std::uint8_t{0});
        return readWhole(file, cells_, analysis_.amount.data() + first_ * kLayers);
      case RawField::Top:
        Analysis::provide(analysis_.top, all * kLayers, kNoHeight);
        return readWhole(file, cells_, analysis_.top.data() + first_ * kLayers);
      case RawField::Time:
        times.resize(cells_);
        return readWhole(file, cells_, times.data());
      case RawField::TotalCover:
        Analysis::provide(analysis_.totalCover, all, std::uint8_t{255});
        return readWhole(file, cells_, analysis_.totalCover.data() + first_);
    }
  }

  const std::filesystem::path& pathOf(RawField field) const {
    return std::find_if(files_.begin(), files_.end(),
                        [&](const RawFile& file) { return file.field == field; })
        ->path;
  }

  std::endian orderOf(const std::vector<std::int32_t>& times, std::optional<std::endian> forced) {
    const std::int64_t now = minutesSince1967(analysis_.time);
    constexpr std::int64_t kTenDays = 14400;
    const Plausible byTime = plausibilityOf(std::span(times), [&](std::int32_t minutes) {
      return minutes > now - kTenDays && minutes < now + kTenDays;
    });
    Plausible byHeight;
    if (!analysis_.top.empty())
      byHeight = plausibilityOf(std::span<const std::int16_t>(tops()),
                                [](std::int16_t height) { return height > 0 && height < 22000; });
    const Plausible& witness = byTime.decides() ? byTime : byHeight;
    const std::endian order = forced ? *forced : witness.decides() ? witness.order() : std::endian::big;
    if (byTime.stated > 0 && 2 * byTime.in(order) < byTime.stated)
      throw base::InputError(
          pathOf(RawField::Time).string(),
          fmt::format("has {} of {} times further than ten days from the hour in its name, {}",
                      byTime.stated - byTime.in(order), byTime.stated,
                      forced ? "in the byte order that was asked for" : "in either byte order"),
          forced ? "leave the byte order to be told by the times" : "check that it is the right file");
    sayOrder(order, forced.has_value(), witness.decides() ? &byTime == &witness ? "times" : "heights" : "");
    return order;
  }

  void sayOrder(std::endian order, bool forced, std::string_view witness) {
    const std::string name = order == std::endian::big ? "big-endian" : "little-endian";
    const std::string where = files_.front().half == Hemisphere::North ? "north" : "south";
    const std::string how = forced            ? "as asked for"
                            : witness.empty() ? "assumed: neither times nor heights tell"
                                              : fmt::format("told by its {}", witness);
    analysis_.fields.push_back(fmt::format("byte order of the {}: {}, {}", where, name, how));
    if (order == std::endian::little || forced || witness.empty())
      analysis_.warnings.push_back(
          {"byte_order", fmt::format("the {}ern raw files are taken as {} ({})", where, name, how)});
  }

  void keepAges(const std::vector<std::int32_t>& times, std::endian order) {
    if (times.empty()) return;
    if (std::all_of(times.begin(), times.end(), [](std::int32_t minutes) { return minutes == 0; })) {
      analysis_.warnings.push_back(
          {"no_times", fmt::format("{} holds no time at all: no layer is dropped for its age",
                                   pathOf(RawField::Time).string())});
      return;
    }
    Analysis::provide(analysis_.ageMinutes, analysis_.cells(), std::int16_t{0});
    const std::int64_t now = minutesSince1967(analysis_.time);
    for (std::size_t i = 0; i < cells_; ++i) {
      const std::int32_t minutes = order == std::endian::native ? times[i] : swapped(times[i]);
      analysis_.ageMinutes[first_ + i] =
          minutes == 0 ? kNeverObserved
                       : static_cast<std::int16_t>(std::clamp<std::int64_t>(now - minutes, -32768, 32766));
    }
  }

  const std::vector<RawFile>& files_;
  Analysis& analysis_;
  std::size_t cells_, first_;
};

}  // namespace

std::optional<RawFile> rawFileOf(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  for (const Form& form : kForms) {
    if (!name.starts_with(form.prefix)) continue;
    const std::string_view rest = std::string_view(name).substr(form.prefix.size());
    const bool north = rest.starts_with("NH_");
    if (!north && !rest.starts_with("SH_")) return std::nullopt;
    if (rest.size() > 13 && rest[13] != '.') return std::nullopt;
    const auto time = hourOf(rest.substr(3, 10));
    if (!time) return std::nullopt;
    return RawFile{path, form.field, north ? Hemisphere::North : Hemisphere::South, *time};
  }
  return std::nullopt;
}

void readRaw(const std::vector<RawFile>& files, std::size_t half, std::optional<std::endian> forced,
             Analysis& analysis) {
  RawSet(files, half, analysis).read(forced);
}

}  // namespace cloudgen::input::cdfs
