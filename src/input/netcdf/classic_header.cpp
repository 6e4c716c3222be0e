// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/classic_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include "base/error.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::uint64_t kMostListed = 1 << 20;
/// NC_MAX_NAME; netCDF-C copies longer names beyond the end of its callers' buffers.
constexpr std::uint64_t kMostName = 256;
enum Tag : std::uint64_t { kNothing = 0, kDimensions = 10, kVariables = 11, kAttributes = 12 };

struct Placed {
  std::string name;
  std::uint64_t begin = 0, bytes = 0;  ///< of one record for record variables
  bool record = false;
};

class Header {
 public:
  Header(const std::filesystem::path& path, std::string name)
      : name_(std::move(name)), stream_(path, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(path, error);
    if (error || !stream_) fail("cannot be read");
  }

  bool check() {
    std::array<char, 4> magic{};
    if (!stream_.read(magic.data(), 4) || !isClassic({magic.data(), 4})) return false;
    version_ = magic[3];
    place_ = 4;
    records_ = count();
    readDimensions();
    readAttributes();
    readVariables();
    checkPlaces();
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw base::InputError(name_, what, "fetch the file again");
  }

  std::uint64_t bigEndian(int bytes) {
    std::array<unsigned char, 8> buffer{};
    if (!stream_.read(reinterpret_cast<char*>(buffer.data()), bytes)) fail("is cut short within its header");
    place_ += static_cast<std::uint64_t>(bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | buffer[static_cast<std::size_t>(i)];
    return value;
  }
  std::uint64_t word() { return bigEndian(4); }
  /// A count or a length: 8 bytes in CDF-5.
  std::uint64_t count() { return bigEndian(version_ == 5 ? 8 : 4); }

  void skip(std::uint64_t bytes) {
    const std::uint64_t padded = (bytes + 3) / 4 * 4;
    if (bytes > size_ || padded > size_ - place_) fail("is cut short within its header");
    place_ += padded;
    stream_.seekg(static_cast<std::streamoff>(place_));
  }

  std::string text() {
    const std::uint64_t length = count();
    if (length > kMostName || length > size_ - place_) fail("has a damaged name in its header");
    std::string value(length, '\0');
    stream_.read(value.data(), static_cast<std::streamsize>(length));
    stream_.seekg(static_cast<std::streamoff>(place_));
    skip(length);
    return value;
  }

  std::uint64_t listed(Tag tag) {
    const std::uint64_t found = word(), number = count();
    if (found == kNothing && number == 0) return 0;
    if (found != tag || number > kMostListed || number > size_ - place_) fail("has a damaged header");
    return number;
  }

  std::uint64_t typeBytes() {
    const std::uint64_t type = word();
    constexpr std::array<std::uint64_t, 12> kBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type < 1 || type > (version_ == 5 ? 11u : 6u)) fail("has a damaged type in its header");
    return kBytes[type];
  }

  static std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    return b > 0 && a > UINT64_MAX / 4 / b ? UINT64_MAX / 4 : a * b;
  }

  void readDimensions() {
    for (std::uint64_t left = listed(kDimensions); left > 0; --left) {
      text();
      lengths_.push_back(count());
    }
  }

  void readAttributes() {
    for (std::uint64_t left = listed(kAttributes); left > 0; --left) {
      text();
      const std::uint64_t bytes = typeBytes();
      skip(product(count(), bytes));
    }
  }

  void readVariables() {
    for (std::uint64_t left = listed(kVariables); left > 0; --left) {
      Placed variable;
      variable.name = text();
      const std::uint64_t rank = count();
      if (rank > 1024) fail("has a damaged header");
      std::uint64_t values = 1;
      for (std::uint64_t i = 0; i < rank; ++i) {
        const std::uint64_t dimension = count();
        if (dimension >= lengths_.size()) fail("has a damaged header");
        const std::uint64_t length = lengths_[dimension];
        if (length == 0 && i > 0) fail("has a damaged header");
        if (length == 0)
          variable.record = true;
        else
          values = product(values, length);
      }
      readAttributes();
      variable.bytes = product(values, typeBytes());
      count();  // The size that is stored here says less than the dimensions do.
      variable.begin = bigEndian(version_ == 1 ? 4 : 8);
      placed_.push_back(std::move(variable));
    }
  }

  void checkPlaces() const {
    std::uint64_t record = 0, recordVariables = 0;
    for (const Placed& variable : placed_)
      if (variable.record) record += (variable.bytes + 3) / 4 * 4, ++recordVariables;
    for (const Placed& variable : placed_) {
      if (recordVariables == 1 && variable.record) record = variable.bytes;
      if (variable.record && records_ == 0) continue;
      const std::uint64_t before = variable.record ? product(records_ - 1, record) : 0;
      if (variable.begin > size_ || before > size_ - variable.begin ||
          variable.bytes > size_ - variable.begin - before)
        fail(fmt::format("is cut short: {} bytes are too few for variable {}", size_, variable.name));
    }
  }

  std::string name_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, place_ = 0, records_ = 0;
  int version_ = 1;
  std::vector<std::uint64_t> lengths_;
  std::vector<Placed> placed_;
};

}  // namespace

bool isClassic(std::string_view firstBytes) {
  return firstBytes.size() >= 4 && firstBytes.starts_with("CDF") &&
         (firstBytes[3] == 1 || firstBytes[3] == 2 || firstBytes[3] == 5);
}

bool checkClassicHeader(const std::filesystem::path& path, const std::string& name) {
  return Header(path, name).check();
}

}  // namespace cloudgen::input::netcdf
