// SPDX-License-Identifier: Apache-2.0
// Layout of messages: WMO Manual on Codes, FM 92 GRIB edition 2 (regulation 92.2) and edition 1.
#include "input/grib/messages.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>

#include "base/error.hpp"
#include "input/grib/file_bytes.hpp"

namespace cloudgen::input::grib {
namespace {

constexpr std::uint64_t kIndicator2 = 16, kIndicator1 = 8, kEnd = 4;
constexpr std::uint64_t kLargestMessage = std::uint64_t{1} << 30;
/// Bulletin headings and padding between messages are at most this long.
constexpr std::uint64_t kLongestGap = 65536;
/// Headers are short; the longest are lists of points a row or coordinates a level.
constexpr std::uint64_t kLongestHead = 1 << 20;
constexpr std::size_t kMostFields = 1 << 20;

std::uint64_t bigEndian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

class Scanner {
 public:
  explicit Scanner(const std::filesystem::path& file)
      : file_(std::make_shared<const std::filesystem::path>(file)), bytes_(file) {}

  std::vector<FieldHead> fields() {
    while (const auto start = nextMessage()) readMessage(*start);
    return std::move(fields_);
  }

 private:
  /// The start of the next message at or after the place reached, over a short gap; nothing at the end of the
  /// file.
  std::optional<std::uint64_t> nextMessage() {
    if (place_ >= bytes_.size()) return std::nullopt;
    if (bytes_.read(place_, 4) == "GRIB") return place_;
    const std::uint64_t left = bytes_.size() - place_;
    const std::size_t found = bytes_.read(place_, kLongestGap).find("GRIB");
    if (found != std::string::npos) return place_ + found;
    if (message_ == 0 || left <= kLongestGap) return std::nullopt;
    throw base::InputError(fmt::format("{}, byte {}", file_->string(), place_),
                           fmt::format("no GRIB message follows message {}", message_),
                           "fetch the file again, or cut off what is not GRIB");
  }

  [[noreturn]] void damaged(const std::string& what) const {
    throw base::InputError(FieldLocation{file_, 0, message_, start_, {}}.name(), what,
                           "fetch the file again");
  }

  void readMessage(std::uint64_t start) {
    ++message_;
    start_ = start;
    const std::string indicator = bytes_.read(start, kIndicator2);
    if (indicator.size() < kIndicator2) damaged("is cut short within its first section");
    const int edition = static_cast<unsigned char>(indicator[7]);
    if (edition != 1 && edition != 2)
      damaged(fmt::format("is of GRIB edition {}, which does not exist", edition));
    std::uint64_t length = edition == 2 ? bigEndian(std::string_view(indicator).substr(8, 8))
                                        : bigEndian(std::string_view(indicator).substr(4, 3));
    if (edition == 1) length = longLength1(length);
    if (length > kLargestMessage) damaged(fmt::format("states an absurd length of {} bytes", length));
    if (length > bytes_.size() - start)
      damaged(fmt::format("is cut short: {} bytes are stated, {} are there", length, bytes_.size() - start));
    if (length < kIndicator2 + kEnd) damaged("states a length too short for a message");
    if (edition == 1)
      keepMessage1(length);
    else
      keepMessage2(length);
    if (bytes_.read(start + length - kEnd, kEnd) != "7777")
      damaged("does not end with 7777 where its length says");
    place_ = start + length;
  }

  /// Edition 1 has three octets for the length. ECMWF's way to state more: the first bit set, the rest in
  /// units of 120 octets, and what is too much in the length of section 4.
  std::uint64_t longLength1(std::uint64_t stated) {
    if (!(stated & 0x800000)) return stated;
    std::uint64_t offset = start_ + kIndicator1;
    const std::string product = bytes_.read(offset, 8);
    if (product.size() < 8) damaged("is cut short within its first section");
    const int flags = static_cast<unsigned char>(product[7]);
    offset += bigEndian(std::string_view(product).substr(0, 3));
    for (const int flag : {0x80, 0x40})
      if (flags & flag) offset += bigEndian(bytes_.read(offset, 3));
    const std::uint64_t excess = bigEndian(bytes_.read(offset, 3));
    if (excess >= 120) return stated;
    return (stated & 0x7fffff) * 120 - excess + kEnd;
  }

  /// Sections 1, 2 and 3 (if flagged) and 4 must fill the message: ecCodes trusts their lengths.
  void keepMessage1(std::uint64_t length) {
    const std::string product = bytes_.read(start_ + kIndicator1, 8);
    const int flags = static_cast<unsigned char>(product[7]);
    const bool present[] = {true, (flags & 0x80) != 0, (flags & 0x40) != 0, true};
    const std::uint64_t least[] = {28, 32, 6, 11}, end = start_ + length - kEnd;
    FieldLocation field{file_, 1, message_, start_, {}};
    field.sections[0] = {start_, kIndicator1};
    std::uint64_t offset = start_ + kIndicator1;
    for (std::size_t section = 0; section < 4; ++section) {
      if (!present[section]) continue;
      if (offset + 3 > end) damaged(fmt::format("has no section {}", section + 1));
      std::uint64_t size = bigEndian(bytes_.read(offset, 3));
      if (section == 3 && length > 0x7fffff) size = end - offset;
      if (size < least[section] || size > end - offset)
        damaged(fmt::format("has a damaged section {} at byte {}", section + 1, offset));
      field.sections[section + 1] = {offset, size};
      offset += size;
    }
    if (offset != end) damaged("has sections that do not fill it");
    fields_.push_back({field, 0, text(1, field.sections[1]), text(2, field.sections[2]), {}});
  }

  /// Sections 2 to 7 may repeat; each section 7 closes a field, which takes the latest of those before.
  void keepMessage2(std::uint64_t length) {
    std::array<Part, 8> latest{};
    Part bitmap;
    latest[0] = {start_, kIndicator2};
    const std::uint64_t end = start_ + length - kEnd;
    const std::size_t before = fields_.size();
    for (std::uint64_t offset = start_ + kIndicator2; offset < end;) {
      const std::string head = bytes_.read(offset, std::min<std::uint64_t>(6, end - offset));
      if (head.size() < 5) damaged("has a section cut short");
      const Part section{offset, bigEndian(std::string_view(head).substr(0, 4))};
      const int number = static_cast<unsigned char>(head[4]);
      constexpr std::uint64_t kLeast[] = {0, 21, 5, 14, 9, 11, 6, 5};
      if (number < 1 || number > 7 || section.length < kLeast[number] || section.length > end - offset)
        damaged(fmt::format("has a damaged section at byte {}", offset));
      latest[static_cast<std::size_t>(number)] = section;
      // A field may refer to a bitmap given before (indicator 254).
      if (number == 6 && head.size() > 5 && static_cast<unsigned char>(head[5]) == 254) latest[6] = bitmap;
      if (number == 6) bitmap = latest[6];
      if (number == 7) keepField(latest);
      offset += section.length;
    }
    if (fields_.size() == before) damaged("holds no data section");
  }

  void keepField(const std::array<Part, 8>& latest) {
    for (std::size_t number = 0; number < latest.size(); ++number)
      if (latest[number].length == 0 && number != 2)
        damaged(fmt::format("lacks section {} before its data", number));
    const int discipline = static_cast<unsigned char>(bytes_.read(start_ + 6, 1).at(0));
    if (fields_.size() >= kMostFields) damaged(fmt::format("is one field more than {}", kMostFields));
    fields_.push_back({FieldLocation{file_, 2, message_, start_, latest}, discipline, text(1, latest[1]),
                       text(3, latest[3]), text(4, latest[4])});
  }

  std::shared_ptr<const std::string> text(std::size_t number, const Part& part) {
    if (part.length > kLongestHead) damaged(fmt::format("has an absurd section at byte {}", part.offset));
    auto& [offset, text] = latestText_[number];
    if (!text || offset != part.offset || part.length == 0) {
      offset = part.offset;
      text = std::make_shared<const std::string>(bytes_.read(part.offset, part.length));
    }
    return text;
  }

  std::shared_ptr<const std::filesystem::path> file_;
  FileBytes bytes_;
  std::uint64_t place_ = 0, message_ = 0, start_ = 0;
  std::array<std::pair<std::uint64_t, std::shared_ptr<const std::string>>, 8> latestText_;
  std::vector<FieldHead> fields_;
};

}  // namespace

std::string FieldLocation::name() const {
  return fmt::format("{}, message {} at byte {}", file->string(), message, messageOffset);
}

bool startsLikeGrib(std::string_view firstBytes) {
  for (std::size_t at = firstBytes.find("GRIB"); at != std::string_view::npos;
       at = firstBytes.find("GRIB", at + 1))
    if (at + 7 < firstBytes.size() && (firstBytes[at + 7] == 1 || firstBytes[at + 7] == 2)) return true;
  return firstBytes.starts_with("GRIB");
}

std::vector<FieldHead> locateFields(const std::filesystem::path& file) { return Scanner(file).fields(); }

std::array<std::string, 8> readSections(const FieldLocation& location) {
  std::ifstream stream(*location.file, std::ios::binary);
  std::array<std::string, 8> sections;
  for (std::size_t number = 0; number < sections.size(); ++number) {
    const Part& part = location.sections[number];
    if (part.length == 0) continue;
    sections[number].resize(static_cast<std::size_t>(part.length));
    stream.seekg(static_cast<std::streamoff>(part.offset));
    if (!stream.read(sections[number].data(), static_cast<std::streamsize>(part.length)))
      throw base::InputError(location.name(), "cannot be read any more",
                             "leave input files alone while they are read");
  }
  return sections;
}

}  // namespace cloudgen::input::grib
