// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target over files and folders of seeds, each whole, cut short and with bytes flipped,
// so that a fuzzer is built and run where libFuzzer is not there.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void runVariants(std::vector<std::uint8_t> bytes) {
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  for (int part = 1; part < 16; ++part) LLVMFuzzerTestOneInput(bytes.data(), bytes.size() * part / 16);
  std::uint64_t state = 88172645463325252u;
  for (int round = 0; round < 64 && !bytes.empty(); ++round) {
    std::vector<std::uint8_t> mutated = bytes;
    for (int flip = 0; flip < 4; ++flip) {
      state ^= state << 13, state ^= state >> 7, state ^= state << 17;
      mutated[state % mutated.size()] ^= static_cast<std::uint8_t>(1u << (state >> 61));
    }
    LLVMFuzzerTestOneInput(mutated.data(), mutated.size());
  }
}

}  // namespace

int main(int count, char** arguments) {
  namespace fs = std::filesystem;
  std::vector<fs::path> seeds;
  for (int i = 1; i < count; ++i) {
    if (fs::is_directory(arguments[i]))
      for (const auto& entry : fs::recursive_directory_iterator(arguments[i]))
        if (entry.is_regular_file()) seeds.push_back(entry.path());
    if (fs::is_regular_file(arguments[i])) seeds.emplace_back(arguments[i]);
  }
  std::sort(seeds.begin(), seeds.end());
  for (const auto& seed : seeds) {
    std::ifstream stream(seed, std::ios::binary);
    runVariants({std::istreambuf_iterator<char>(stream), {}});
  }
  std::printf("%zu seeds\n", seeds.size());
  return seeds.empty() ? 1 : 0;
}
