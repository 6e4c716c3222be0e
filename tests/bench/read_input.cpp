// SPDX-License-Identifier: Apache-2.0
// What bench times, each in a process of its own:
//   read_input cloudgen FILE...  opens the files and visits every level or layer of every cell
//   read_input eccodes FILE...   decodes the values of every message with ecCodes alone
//   read_input bytes FILE...     reads the bytes and brings 16 and 32 bit numbers into the machine's order
// Prints a sum, so that nothing is optimised away.
#include <eccodes.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

#include "input/catalogue.hpp"

namespace {

using namespace cloudgen;

double sumOfSource(const std::vector<std::filesystem::path>& files) {
  const auto source = input::open(files);
  std::vector<std::uint32_t> cells(source->grid().size());
  std::iota(cells.begin(), cells.end(), 0u);
  double sum = 0;
  source->visitLayers(cells, [&](const field::StatedLayer& layer) { sum += layer.topMeters; });
  source->visitLevels(cells, [&](const field::Level& level) {
    for (const auto& [quantity, values] : level.values) sum += values.front();
  });
  return sum;
}

double sumOfMessages(const std::vector<std::filesystem::path>& files) {
  double sum = 0;
  for (const auto& file : files) {
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    int error = 0;
    std::vector<double> values;
    while (codes_handle* handle = codes_handle_new_from_file(nullptr, stream, PRODUCT_GRIB, &error)) {
      std::size_t count = 0;
      codes_get_size(handle, "values", &count);
      values.resize(count);
      codes_get_double_array(handle, "values", values.data(), &count);
      sum += values.front();
      codes_handle_delete(handle);
    }
    std::fclose(stream);
  }
  return sum;
}

template <class Value>
void reorder(std::vector<char>& bytes) {
  for (std::size_t i = 0; i + sizeof(Value) <= bytes.size(); i += sizeof(Value)) {
    Value value;
    std::memcpy(&value, bytes.data() + i, sizeof value);
    value = sizeof(Value) == 2 ? static_cast<Value>(__builtin_bswap16(static_cast<std::uint16_t>(value)))
                               : static_cast<Value>(__builtin_bswap32(static_cast<std::uint32_t>(value)));
    std::memcpy(bytes.data() + i, &value, sizeof value);
  }
}

double sumOfBytes(const std::vector<std::filesystem::path>& files) {
  double sum = 0;
  std::vector<std::vector<char>> all;
  for (const auto& file : files) {
    std::vector<char>& bytes = all.emplace_back(std::filesystem::file_size(file));
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    sum += static_cast<double>(std::fread(bytes.data(), 1, bytes.size(), stream));
    std::fclose(stream);
    const std::string name = file.filename().string();
    if (name.starts_with("WWMCA_LYRD_TOPS")) reorder<std::int16_t>(bytes);
    if (name.starts_with("WWMCA_PIXL_TIME")) reorder<std::int32_t>(bytes);
    sum += bytes.front();
  }
  return sum;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) return 2;
  const std::string how = arguments[1];
  const std::vector<std::filesystem::path> files(arguments + 2, arguments + count);
  try {
    std::printf("%.17g\n", how == "cloudgen"  ? sumOfSource(files)
                           : how == "eccodes" ? sumOfMessages(files)
                                              : sumOfBytes(files));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
