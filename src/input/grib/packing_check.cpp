// SPDX-License-Identifier: Apache-2.0
// WMO Manual on Codes, FM 92 GRIB: data representation templates 5.0 to 5.61 and their data templates 7.x;
// edition 1: section 4. JPEG 2000 (ISO 15444-1 A.5.1) and PNG (11.2.2) by their headers.
#include "input/grib/packing_check.hpp"

#include <fmt/format.h>

#include <bit>

#include "base/error.hpp"
#include "input/grib/octets.hpp"

namespace cloudgen::input::grib {
namespace {

constexpr std::uint64_t kMostBits = 32;

[[noreturn]] void damaged(const Octets& octets, const std::string& what) {
  throw base::InputError(octets.where(), "has damaged data: " + what, "fetch the file again");
}

void require(bool holds, const Octets& octets, const char* what) {
  if (!holds) damaged(octets, what);
}

/// Numbers of equal width, one after another.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t left() const { return 8 * bytes_.size() - place_; }
  std::uint64_t next(std::uint64_t width) {
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < width; ++i, ++place_)
      value = value << 1 | (static_cast<unsigned char>(bytes_[place_ / 8]) >> (7 - place_ % 8) & 1u);
    return value;
  }
  void skip(std::uint64_t bits) { place_ += bits; }
  void toWholeByte() { place_ = (place_ + 7) / 8 * 8; }

 private:
  std::string_view bytes_;
  std::uint64_t place_ = 0;
};

/// Points that the bitmap says are there.
std::uint64_t presentPoints(std::string_view bitmap, std::size_t count) {
  std::uint64_t present = 0;
  const std::size_t whole = count / 8;
  for (std::size_t i = 0; i < whole; ++i)
    present += static_cast<unsigned>(std::popcount(static_cast<unsigned char>(bitmap[i])));
  if (count % 8)
    present += static_cast<unsigned>(
        std::popcount(static_cast<unsigned>(static_cast<unsigned char>(bitmap[whole])) >> (8 - count % 8)));
  return present;
}

/// Groups of complex packing: their references, widths and lengths, then as many bits as those say.
void checkGroups(const Octets& representation, std::string_view data, std::uint64_t coded, bool differences) {
  const auto& o = representation;
  const std::uint64_t referenceBits = o.whole(20, 1), groups = o.whole(32, 4), widthBase = o.whole(36, 1),
                      widthBits = o.whole(37, 1), lengthBase = o.whole(38, 4), lengthStep = o.whole(42, 1),
                      lastLength = o.whole(43, 4), lengthBits = o.whole(47, 1);
  require(o.whole(22, 1) <= 1 && o.whole(23, 1) <= 2, o, "an unknown way of grouping");
  require(referenceBits <= kMostBits && widthBits <= kMostBits && lengthBits <= kMostBits, o,
          "groups of absurd widths");
  Bits bits(data);
  if (differences) {
    const std::uint64_t order = o.whole(48, 1), octets = o.whole(49, 1);
    require(order <= 3 && octets <= 4, o, "differences of an unknown order");
    const std::uint64_t first = order == 0 ? 0 : (order + 1) * octets * 8;
    require(order == 0 || octets >= 1 || groups == 0, o, "differences without their first values");
    require(order <= coded && first <= bits.left(), o, "fewer octets than its groups need");
    bits.skip(first);
  }
  if (groups == 0) return require(coded == 0, o, "values without groups");
  require(groups <= coded, o, "more groups than values");
  const auto table = [&](std::uint64_t width) {
    require((groups * width + 7) / 8 * 8 <= bits.left(), o, "fewer octets than its groups need");
    const Bits start = bits;
    bits.skip(groups * width);
    bits.toWholeByte();
    return start;
  };
  table(referenceBits);
  Bits widths = table(widthBits), lengths = table(lengthBits);
  std::uint64_t values = 0, needed = 0;
  for (std::uint64_t group = 0; group < groups; ++group) {
    const std::uint64_t width = widthBase + widths.next(widthBits),
                        stated = lengthBase + lengths.next(lengthBits) * lengthStep,
                        length = group + 1 == groups ? lastLength : stated;
    require(width <= kMostBits && length <= coded - values, o, "groups larger than its values");
    values += length;
    needed += width * length;
  }
  require(values == coded, o, "groups that do not add up to its values");
  require(needed <= bits.left(), o, "fewer octets than its groups need");
}

void checkJpeg2000(const Octets& data, std::uint64_t coded) {
  constexpr std::uint64_t kStartAndSize = 0xff4fff51;
  require(data.has(1, 42) && data.whole(1, 4) == kStartAndSize, data, "no JPEG 2000 code stream");
  const std::uint64_t right = data.whole(9, 4), bottom = data.whole(13, 4), left = data.whole(17, 4),
                      top = data.whole(21, 4);
  require(right > left && bottom > top && (right - left) * (bottom - top) == coded && data.whole(41, 2) == 1,
          data, "a JPEG 2000 image of another size");
}

void checkPng(const Octets& data, std::uint64_t coded, std::uint64_t bits) {
  require(data.has(1, 33) && data.whole(1, 8) == 0x89504e470d0a1a0a, data, "no PNG image");
  constexpr std::uint64_t kChannels[] = {1, 0, 3, 1, 2, 0, 4};
  const std::uint64_t width = data.whole(17, 4), height = data.whole(21, 4), depth = data.whole(25, 1),
                      colour = data.whole(26, 1);
  require(width > 0 && height > 0 && width <= coded && width * height == coded && colour <= 6, data,
          "a PNG image of another size");
  const std::uint64_t pixel = depth * kChannels[colour];
  require(pixel == bits || (bits > 4 && pixel == (bits + 7) / 8 * 8), data, "a PNG image of another depth");
  require(data.whole(29, 1) == 0, data, "an interlaced PNG image");
}

void checkPacking2(const FieldLocation& location, const std::array<std::string, 8>& sections,
                   std::size_t count) {
  const std::string where = location.name();
  const Octets representation(sections[5], where), bitmap(sections[6], where);
  const std::string_view packed = std::string_view(sections[7]).substr(5);
  const Octets data(packed, where);
  const std::uint64_t coded = representation.whole(6, 4), type = representation.whole(10, 2);
  const std::uint64_t indicator = bitmap.whole(6, 1);
  std::uint64_t present = count;
  if (indicator == 0) {
    require(bitmap.size() >= 6 + (count + 7) / 8, bitmap, "a bitmap shorter than its grid");
    present = presentPoints(std::string_view(sections[6]).substr(6), count);
  } else {
    require(indicator == 255, bitmap, "a bitmap that it does not define");
  }
  if (coded != present)
    damaged(data, fmt::format("{} values are packed where {} points want one", coded, present));
  if (type == 4) {
    const std::uint64_t precision = representation.whole(12, 1);
    require(precision == 1 || precision == 2, data, "floating point values of an unknown width");
    return require(coded * (precision == 1 ? 4 : 8) <= packed.size(), data, "fewer octets than values");
  }
  const std::uint64_t bits = representation.whole(20, 1);
  require(bits <= kMostBits, data, "values of absurd width");
  switch (type) {
    case 0:
    case 61:
      if (type == 61) (void)representation.whole(21, 4);
      return require((coded * bits + 7) / 8 <= packed.size(), data, "fewer octets than values");
    case 2:
    case 3:
      return checkGroups(representation, packed, coded, type == 3);
    case 40:
    case 40000:
      return bits == 0 ? void() : checkJpeg2000(data, coded);
    case 41:
    case 40010:
      return bits == 0 ? void() : checkPng(data, coded, bits);
    case 42: {
      const std::uint64_t block = representation.whole(23, 1), interval = representation.whole(24, 2);
      return require(
          (block == 8 || block == 16 || block == 32 || block == 64) && interval >= 1 && interval <= 4096,
          data, "an unknown way of compressing");
    }
    default:
      throw base::InputError(where, fmt::format("is packed in a way that is not read (template 5.{})", type),
                             "pack it anew, as with `grib_set -r -s packingType=grid_simple in.grb out.grb`");
  }
}

void checkPacking1(const FieldLocation& location, const std::array<std::string, 8>& sections,
                   std::size_t count) {
  const Octets bitmap(sections[3], location.name()), data(sections[4], location.name());
  std::uint64_t present = count;
  if (bitmap.size() > 0) {
    require(bitmap.whole(5, 2) == 0, bitmap, "a bitmap that it does not define");
    require(bitmap.size() >= 6 + (count + 7) / 8, bitmap, "a bitmap shorter than its grid");
    present = presentPoints(std::string_view(sections[3]).substr(6), count);
  }
  const std::uint64_t flags = data.whole(4, 1), bits = data.whole(11, 1);
  require(bits <= kMostBits, data, "values of absurd width");
  require((flags & 0x80) == 0, data, "spherical harmonics on a grid of points");
  if (flags & 0x40) return;
  require(bits == 0 || (present * bits + 7) / 8 <= data.size() - 11, data, "fewer octets than values");
}

}  // namespace

void checkPacking(const FieldLocation& location, const std::array<std::string, 8>& sections,
                  std::size_t count) {
  if (location.edition == 1)
    checkPacking1(location, sections, count);
  else
    checkPacking2(location, sections, count);
}

}  // namespace cloudgen::input::grib
