// SPDX-License-Identifier: Apache-2.0
#include "runtime/runtime.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace cloudgen::runtime {
namespace {

constexpr Status kNoMemory{"there is no memory for the pack"};

/// The most puffs that clouds can ask for, all in their finest level.
std::uint64_t finestPuffs(const PackView& pack, std::span<const pack::Instance> clouds) {
  std::uint64_t puffs = 0;
  for (const pack::Instance& cloud : clouds) {
    const ArchetypeInfo& archetype = pack.archetypes()[cloud.archetype()];
    puffs += *std::max_element(archetype.count.begin(), archetype.count.begin() + archetype.levels);
  }
  return puffs;
}

}  // namespace

Status Runtime::open(const char* path, const RuntimeOptions& options) noexcept {
  std::unique_ptr<State> state(new (std::nothrow) State);
  const Status opened = state ? state->pack.open(path) : kNoMemory;
  return finish(std::move(state), opened, options);
}

Status Runtime::open(std::span<const std::uint8_t> bytes, const RuntimeOptions& options) noexcept {
  std::unique_ptr<State> state(new (std::nothrow) State);
  const Status opened = state ? state->pack.open(bytes) : kNoMemory;
  return finish(std::move(state), opened, options);
}

Status Runtime::finish(std::unique_ptr<State> state, Status opened, const RuntimeOptions& options) noexcept {
  state_.reset();
  if (!opened) return opened;
  const PackView& pack = state->pack;
  state->options = options;
  try {
    state->timeline = Timeline(pack);
    state->lighting = Lighting(pack, false);
    state->list = DrawList(pack, pack.instances().size(), pack.tiles().size(), finestPuffs(pack, pack.instances()),
                           options.lazy);
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  }
  const pack::Sun& sun = *pack.root().sun();
  state->lighting.setSun({sun.azimuth_degrees(), sun.elevation_degrees()});
  state_ = std::move(state);
  return {};
}

Status Runtime::startEndless(const EndlessOptions& options) noexcept {
  State& state = *state_;
  EndlessSky sky;
  if (const Status made = EndlessSky::make(state.pack, options, sky); !made) return made;
  try {
    Lighting lighting(state.pack, true);
    const pack::Sun& sun = *state.pack.root().sun();
    lighting.setSun({sun.azimuth_degrees(), sun.elevation_degrees()});
    DrawList list(state.pack, sky.instances().size(), 0, finestPuffs(state.pack, sky.instances()), state.options.lazy);
    state.lighting = std::move(lighting);
    state.list = std::move(list);
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  }
  state.endless = std::move(sky);
  state.isEndless = state.cloudsChanged = true;
  return {};
}

std::size_t Runtime::mostClouds() const noexcept {
  return state_->isEndless ? state_->endless.instances().size() : state_->pack.instances().size();
}

float Runtime::groundMeters() const noexcept {
  const pack::Frame* frame = state_->pack.root().frame();
  return frame && std::isfinite(frame->ground_meters()) ? frame->ground_meters() : 0.0f;
}

void Runtime::setTime(double seconds) noexcept {
  if (state_->isEndless || !state_->timeline.moves()) return;
  state_->timeline.setTime(seconds);
  state_->cloudsChanged = true;
}

Frame Runtime::update(const Camera& camera) noexcept {
  State& state = *state_;
  Frame frame;
  if (state.isEndless && state.endless.moveTo(camera.eye) > 0) {
    state.cloudsChanged = true;
    state.list.forget();
  }
  const CloudSet clouds = state.isEndless
                              ? CloudSet{state.endless.instances(), {}, 0}
                              : CloudSet{state.timeline.instances(), state.pack.tiles(), state.timeline.tileSlackMeters()};
  frame.cloudsChanged = std::exchange(state.cloudsChanged, false);
  frame.puffsChanged = state.list.update(clouds, camera, state.options.detail);
  state.facing.update(state.pack, clouds, state.list.selection(), camera.eye);
  frame.puffs = state.list.puffs();
  frame.clouds = clouds.instances;
  frame.locked = state.facing.locked();
  frame.orderErrorMeters = state.list.orderErrorMeters();
  return frame;
}

}  // namespace cloudgen::runtime
