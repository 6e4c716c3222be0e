// SPDX-License-Identifier: Apache-2.0
#include "runtime/endless.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <string>

namespace cloudgen::runtime {
namespace {

/// The finaliser of SplitMix64 (Steele et al. 2014): bits that depend on every bit of the address.
std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return bits ^ bits >> 31;
}
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return mixed(mixed(a) ^ b); }
float unit(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

constexpr std::string_view kHeaps = "Cu Sc", kMiddle = "As Ac Ns", kHigh = "Ci Cs Cc";
constexpr float kSheetMeters = 24'000, kVeilMeters = 30'000;
/// Sizes of clouds, of what is asked for.
constexpr float kNarrowest = 0.75f, kWidest = 1.25f;

std::vector<EndlessLayer> codeOf(int heaps, int middle, int high, float apart, bool clustered) {
  return {{kHeaps, heaps, 600, 1800, apart, 0, clustered},
          {kMiddle, middle, 3000, 5000, kWidest * kSheetMeters, kSheetMeters, false},
          {kHigh, high, 7000, 9000, kWidest * kVeilMeters, kVeilMeters, false}};
}

/// The archetypes of the first genus that the pack has.
std::vector<std::uint16_t> archetypesOf(const PackView& pack, std::string_view genera) {
  std::vector<std::uint16_t> found;
  for (std::size_t at = 0; at < genera.size() && found.empty(); at = genera.find(' ', at) + 1) {
    const std::string_view genus = genera.substr(at, genera.find(' ', at) - at);
    const auto& archetypes = *pack.root().archetypes();
    for (std::uint32_t a = 0; a < archetypes.size() && a <= 0xffff; ++a)
      if (const auto* name = archetypes.Get(a)->genus(); name && name->string_view() == genus)
        found.push_back(static_cast<std::uint16_t>(a));
    if (genera.find(' ', at) == genera.npos) break;
  }
  return found;
}

/// How many columns each of `rows` rows has, for `count` places in all.
int columnsOf(int row, int rows, int count) { return (row + 1) * count / rows - row * count / rows; }

}  // namespace

const std::vector<EndlessLayer>* layersOf(std::string_view code) noexcept {
  static const std::array<std::vector<EndlessLayer>, 5> kCodes{codeOf(0, 0, 0, 0, false), codeOf(9, 0, 1, 4000, false),
                                                               codeOf(28, 1, 1, 4000, false), codeOf(71, 2, 2, 0, false),
                                                               codeOf(196, 2, 2, 0, true)};
  if (code.size() != 4 || (code[0] != 'd' && code[0] != 'n') || code[1] < '0' || code[1] > '4' || code[2] != '0' ||
      code[3] != '0')
    return nullptr;
  return &kCodes[static_cast<std::size_t>(code[1] - '0')];
}

Status EndlessSky::make(const PackView& pack, const EndlessOptions& options, EndlessSky& sky) noexcept {
  sky = EndlessSky();
  const auto* layers = layersOf(options.weatherCode);
  if (!layers) return {"the weather code is not one of d000, d100, d200, d300 and d400"};
  if (!(options.nearestMeters > 0 && options.nearestMeters < 1e6f)) return {"the nearest distance is none"};
  // A cloud stands within a quarter of the side of its middle place, which changes half a side away.
  sky.side_ = 4 * options.nearestMeters;
  try {
    for (std::size_t l = 0; l < layers->size(); ++l) sky.addLayer(pack, (*layers)[l], mixed(options.seed, l));
  } catch (const std::bad_alloc&) {
    sky = EndlessSky();
    return {"there is no memory for the sky"};
  }
  sky.moveTo({0, 0, 0});
  return {};
}

void EndlessSky::addLayer(const PackView& pack, const EndlessLayer& layer, std::uint64_t seed) {
  const auto archetypes = archetypesOf(pack, layer.genera);
  if (archetypes.empty() || layer.clouds == 0) return;
  constexpr int kOfCluster = 7;
  const int places = layer.clustered ? layer.clouds / kOfCluster : layer.clouds;
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<float>(places)))));
  std::vector<Slot> grid;
  for (int row = 0; row < rows; ++row) {
    const int columns = columnsOf(row, rows, places);
    for (int column = 0; column < columns; ++column) {
      const float width = side_ / static_cast<float>(columns), depth = side_ / static_cast<float>(rows);
      Slot slot;
      slot.middle = {(static_cast<float>(column) + 0.5f) * width, 0, (static_cast<float>(row) + 0.5f) * depth};
      // Clusters keep a gap between them; single clouds their distance.
      const float gap = layer.clustered ? 0.35f * std::min(width, depth) : layer.apartMeters;
      slot.half = {std::clamp(0.5f * (width - gap), 0.0f, 0.25f * side_), 0,
                   std::clamp(0.5f * (depth - gap), 0.0f, 0.25f * side_)};
      slot.lowest = layer.lowestMeters;
      slot.highest = layer.highestMeters;
      grid.push_back(slot);
    }
  }
  for (int i = 0; i < layer.clouds; ++i) {
    Slot slot = grid[static_cast<std::size_t>(i) % grid.size()];
    slot.seed = mixed(seed, static_cast<std::uint64_t>(i));
    const std::uint16_t archetype = archetypes[mixed(slot.seed, 1) % archetypes.size()];
    const float own = pack.root().archetypes()->Get(archetype)->width_meters();
    float scale = kNarrowest + (kWidest - kNarrowest) * unit(mixed(slot.seed, 2));
    if (layer.widthMeters > 0 && own > 0) scale *= layer.widthMeters / own;
    slots_.push_back(slot);
    clouds_.emplace_back(pack::Vec3(0, 0, 0), archetype, std::uint8_t{0}, std::uint8_t{255}, scale, 1.0f);
  }
}

void EndlessSky::place(Slot& slot, pack::Instance& cloud) noexcept {
  const std::uint64_t here = mixed(slot.seed, mixed(static_cast<std::uint64_t>(slot.column), static_cast<std::uint64_t>(slot.row)));
  const auto about = [](float half, std::uint64_t bits) { return half * (2 * unit(bits) - 1); };
  const double x = static_cast<double>(slot.column) * side_ + slot.middle.x + about(slot.half.x, mixed(here, 3)),
               z = static_cast<double>(slot.row) * side_ + slot.middle.z + about(slot.half.z, mixed(here, 4));
  const float y = slot.lowest + (slot.highest - slot.lowest) * unit(mixed(here, 5));
  cloud = pack::Instance({static_cast<float>(x), y, static_cast<float>(z)}, cloud.archetype(),
                         static_cast<std::uint8_t>(mixed(here, 6) % kYawSteps), cloud.sunlight(), cloud.scale(),
                         cloud.optical_depth_factor());
}

std::size_t EndlessSky::moveTo(const Vec3& eye) noexcept {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    const auto column = static_cast<std::int64_t>(std::floor((eye.x - slot.middle.x) / side_ + 0.5f)),
               row = static_cast<std::int64_t>(std::floor((eye.z - slot.middle.z) / side_ + 0.5f));
    if (column == slot.column && row == slot.row) continue;
    slot.column = column;
    slot.row = row;
    place(slot, clouds_[i]);
    ++moved;
  }
  return moved;
}

}  // namespace cloudgen::runtime
