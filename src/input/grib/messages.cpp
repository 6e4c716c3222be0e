// SPDX-License-Identifier: Apache-2.0
// Layout of messages: WMO Manual on Codes, FM 92 GRIB edition 2 (regulation 92.2) and edition 1.
#include "input/grib/messages.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <optional>

#include "base/error.hpp"

namespace cloudgen::input::grib {
namespace {

constexpr std::uint64_t kIndicator2 = 16, kIndicator1 = 8, kEnd = 4;
constexpr std::uint64_t kLargestMessage = std::uint64_t{1} << 30;
/// Bulletin headings and padding between messages are at most this long.
constexpr std::uint64_t kLongestGap = 65536;

std::uint64_t bigEndian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

class Scanner {
 public:
  explicit Scanner(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (error || !stream_)
      throw base::InputError(file.string(), "cannot be read", "check the path and its permissions");
  }

  std::vector<FieldLocation> fields() {
    while (const auto start = nextMessage()) readMessage(*start);
    return std::move(fields_);
  }

 private:
  std::string bytes(std::uint64_t offset, std::uint64_t length) {
    std::string text(length, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(text.data(), static_cast<std::streamsize>(length));
    text.resize(static_cast<std::size_t>(stream_.gcount()));
    return text;
  }

  /// The start of the next message at or after the place reached, over a short gap; nothing at the end of the
  /// file.
  std::optional<std::uint64_t> nextMessage() {
    if (place_ >= size_) return std::nullopt;
    const std::string gap = bytes(place_, std::min(size_ - place_, kLongestGap));
    const std::size_t found = gap.find("GRIB");
    if (found != std::string::npos) return place_ + found;
    if (message_ == 0 || size_ - place_ <= kLongestGap) return std::nullopt;
    throw base::InputError(fmt::format("{}, byte {}", file_.string(), place_),
                           fmt::format("no GRIB message follows message {}", message_),
                           "fetch the file again");
  }

  std::string here() const {
    return fmt::format("{}, message {} at byte {}", file_.string(), message_, start_);
  }

  [[noreturn]] void damaged(const std::string& what) const {
    throw base::InputError(here(), what, "fetch the file again");
  }

  void readMessage(std::uint64_t start) {
    ++message_;
    start_ = start;
    const std::string indicator = bytes(start, kIndicator2);
    if (indicator.size() < kIndicator2) damaged("is cut short within its first section");
    const int edition = static_cast<unsigned char>(indicator[7]);
    if (edition != 1 && edition != 2)
      damaged(fmt::format("is of GRIB edition {}, which does not exist", edition));
    const std::uint64_t length = edition == 2 ? bigEndian(std::string_view(indicator).substr(8, 8))
                                              : bigEndian(std::string_view(indicator).substr(4, 3));
    if (length > kLargestMessage) damaged(fmt::format("states an absurd length of {} bytes", length));
    if (length > size_ - start)
      damaged(fmt::format("is cut short: {} bytes are stated, {} are there", length, size_ - start));
    if (length < kIndicator2 + kEnd || bytes(start + length - kEnd, kEnd) != "7777")
      damaged("does not end with 7777 where its length says");
    if (edition == 1)
      keepMessage1(length);
    else
      readSections(length);
    place_ = start + length;
  }

  /// Sections 1, 2 and 3 (if flagged) and 4 must fill the message: ecCodes trusts their lengths.
  void keepMessage1(std::uint64_t length) {
    const std::string product = bytes(start_ + kIndicator1, 8);
    const int flags = static_cast<unsigned char>(product[7]);
    const bool present[] = {true, (flags & 0x80) != 0, (flags & 0x40) != 0, true};
    const std::uint64_t least[] = {28, 6, 6, 11}, end = start_ + length - kEnd;
    std::uint64_t offset = start_ + kIndicator1;
    for (int section = 0; section < 4; ++section) {
      if (!present[section]) continue;
      const std::string head = bytes(offset, 3);
      const std::uint64_t size = bigEndian(head);
      if (offset + 3 > end || size < least[section] || size > end - offset)
        damaged(fmt::format("has a damaged section {} at byte {}", section + 1, offset));
      offset += size;
    }
    if (offset != end) damaged("has sections that do not fill it");
    fields_.push_back({file_, 1, message_, start_, {{start_, length}}});
  }

  /// Sections 2 to 7 may repeat; each section 7 closes a field, which takes the latest of those before.
  void readSections(std::uint64_t length) {
    std::array<Part, 8> latest{};
    Part bitmap;
    latest[0] = {start_, kIndicator2};
    const std::uint64_t end = start_ + length - kEnd;
    const std::size_t before = fields_.size();
    for (std::uint64_t offset = start_ + kIndicator2; offset < end;) {
      const std::string head = bytes(offset, std::min<std::uint64_t>(6, end - offset));
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
    FieldLocation field{file_, 2, message_, start_, {}};
    for (std::size_t number = 0; number < latest.size(); ++number) {
      if (latest[number].length == 0 && number != 2)
        damaged(fmt::format("lacks section {} before its data", number));
      if (latest[number].length > 0) field.sections.push_back(latest[number]);
    }
    fields_.push_back(std::move(field));
  }

  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, place_ = 0, message_ = 0, start_ = 0;
  std::vector<FieldLocation> fields_;
};

}  // namespace

std::string FieldLocation::name() const {
  return fmt::format("{}, message {} at byte {}", file.string(), message, messageOffset);
}

bool startsLikeGrib(std::string_view firstBytes) { return firstBytes.find("GRIB") != std::string_view::npos; }

std::vector<FieldLocation> locateFields(const std::filesystem::path& file) { return Scanner(file).fields(); }

std::string readField(const FieldLocation& location) {
  std::ifstream stream(location.file, std::ios::binary);
  std::string message;
  for (const Part& part : location.sections) {
    const std::size_t place = message.size();
    message.resize(place + part.length);
    stream.seekg(static_cast<std::streamoff>(part.offset));
    if (!stream.read(message.data() + place, static_cast<std::streamsize>(part.length)))
      throw base::InputError(location.name(), "cannot be read any more",
                             "leave input files alone while they are read");
  }
  if (location.edition == 1) return message;
  message += "7777";
  for (int i = 0; i < 8; ++i) message[15 - i] = static_cast<char>(message.size() >> (8 * i));
  return message;
}

}  // namespace cloudgen::input::grib
