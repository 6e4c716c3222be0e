// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target over so many mutations of seeds: mutate_NAME COUNT FILE... Bits flipped, bytes set to what breaks
// things, words moved and ends cut; the same for the same count and seeds.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::uint64_t state = 88172645463325252u;

std::uint64_t next() {
  state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  return state;
}

void mutate(std::vector<std::uint8_t>& bytes) {
  constexpr std::uint8_t kAwkward[] = {0, 1, 0x7f, 0x80, 0xff, 0xfe, 4, 16};
  const std::size_t at = next() % bytes.size(), word = at & ~std::size_t{3};
  switch (next() % 5) {
    case 0: bytes[at] ^= static_cast<std::uint8_t>(1u << (next() & 7)); return;
    case 1: bytes[at] = kAwkward[next() & 7]; return;
    case 2:
      if (word + 4 <= bytes.size()) std::memset(&bytes[word], kAwkward[next() & 7], 4);
      return;
    case 3:
      if (const std::size_t from = (next() % bytes.size()) & ~std::size_t{3}; std::max(from, word) + 4 <= bytes.size())
        std::memmove(&bytes[word], &bytes[from], 4);
      return;
    default:
      if (next() % 16 == 0) bytes.resize(1 + next() % bytes.size());
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) return 2;
  const long rounds = std::atol(arguments[1]);
  std::vector<std::vector<std::uint8_t>> seeds;
  for (int i = 2; i < count; ++i) {
    std::ifstream stream(arguments[i], std::ios::binary);
    seeds.push_back({std::istreambuf_iterator<char>(stream), {}});
    if (seeds.back().empty()) return 2;
  }
  for (long round = 0; round < rounds; ++round) {
    std::vector<std::uint8_t> bytes = seeds[static_cast<std::size_t>(round) % seeds.size()];
    // Few changes: most must get past the verifier.
    for (std::uint64_t changes = 1 + next() % 3; changes > 0; --changes) mutate(bytes);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%ld mutations\n", rounds);
  return 0;
}
