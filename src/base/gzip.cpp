// SPDX-License-Identifier: Apache-2.0
#include "base/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"

namespace cloudgen::base {
namespace {

constexpr int kGzip = 16, kWindowBits = 15;
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

Bytef* bytePointer(std::string_view bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
}

/// Hands the next bytes to a stream that has none left: it counts them in 32 bits.
void feed(z_stream& stream, std::string_view& bytes) {
  if (stream.avail_in > 0) return;
  const std::size_t taken = std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
  stream.next_in = bytePointer(bytes);
  stream.avail_in = static_cast<uInt>(taken);
  bytes.remove_prefix(taken);
}

}  // namespace

std::string gzipped(std::string_view bytes) {
  constexpr int kMemoryLevel = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowBits + kGzip, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw OutputError("gzip", "cannot start", "is there memory left?");
  const std::unique_ptr<z_stream, decltype(&deflateEnd)> owner(&stream, deflateEnd);
  std::string out;
  std::string block(kBlockBytes, '\0');
  int status = Z_OK;
  while (status == Z_OK) {
    feed(stream, bytes);
    stream.next_out = bytePointer(block);
    stream.avail_out = static_cast<uInt>(block.size());
    status = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    out.append(block, 0, block.size() - stream.avail_out);
  }
  return out;
}

bool isGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string unzipped(std::string_view bytes, const std::string& where, std::uint64_t limitBytes) {
  const auto fail = [&](const char* what) -> void {
    throw InputError(where, what, "write it again, or unpack it with gunzip to see");
  };
  z_stream stream{};
  if (inflateInit2(&stream, kWindowBits + kGzip) != Z_OK) fail("cannot be unpacked");
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, inflateEnd);
  std::string out;
  std::string block(kBlockBytes, '\0');
  while (true) {
    feed(stream, bytes);
    stream.next_out = bytePointer(block);
    stream.avail_out = static_cast<uInt>(block.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    out.append(block, 0, block.size() - stream.avail_out);
    if (out.size() > limitBytes) fail("holds more when unpacked than can be read");
    if (status == Z_STREAM_END && stream.avail_in == 0 && bytes.empty()) return out;
    if (status == Z_STREAM_END && inflateReset(&stream) == Z_OK) continue;
    if (status != Z_OK || (stream.avail_in == 0 && bytes.empty() && stream.avail_out > 0))
      fail("is broken or cut short: it cannot be unpacked");
  }
}

}  // namespace cloudgen::base
