// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace cloudgen::check {

/// Names and what they stand for, added and never removed. Packed: a scene of 500 MB can have millions.
/// Pointers to values stay good.
template <typename Value>
class NameTable {
 public:
  /// The value of a name, or null.
  const Value* find(std::string_view name) const {
    const std::uint32_t slot = slots_.empty() ? 0 : slots_[slotOf(name, hashOf(name))].entry;
    return slot == 0 ? nullptr : &values_[slot - 1];
  }

  /// The value of the name, and whether it is new.
  std::pair<Value*, bool> add(std::string_view name, Value value) {
    if (2 * values_.size() >= slots_.size()) grow();
    const std::uint32_t hash = hashOf(name);
    Slot& slot = slots_[slotOf(name, hash)];
    if (slot.entry != 0) return {&values_[slot.entry - 1], false};
    values_.push_back(std::move(value));
    text_.insert(text_.end(), name.begin(), name.end());
    ends_.push_back(text_.size());
    slot = {hash, static_cast<std::uint32_t>(values_.size())};
    return {&values_.back(), true};
  }

 private:
  struct Slot {
    std::uint32_t hash = 0, entry = 0;  ///< counted from 1; 0 is free
  };

  static std::uint32_t hashOf(std::string_view name) {
    return static_cast<std::uint32_t>(std::hash<std::string_view>()(name));
  }

  std::string_view nameOf(std::uint32_t entry) const {
    const std::size_t start = entry == 1 ? 0 : ends_[entry - 2];
    return {text_.data() + start, ends_[entry - 1] - start};
  }

  /// The slot that holds the name, or the free one where it belongs.
  std::size_t slotOf(std::string_view name, std::uint32_t hash) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (slots_[at].entry != 0 && (slots_[at].hash != hash || nameOf(slots_[at].entry) != name))
      at = (at + 1) & mask;
    return at;
  }

  void grow() {
    const std::vector<Slot> old =
        std::exchange(slots_, std::vector<Slot>(slots_.empty() ? 64 : 2 * slots_.size()));
    const std::size_t mask = slots_.size() - 1;
    for (const Slot& slot : old) {
      if (slot.entry == 0) continue;
      std::size_t at = slot.hash & mask;
      while (slots_[at].entry != 0) at = (at + 1) & mask;
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;  ///< a power of two of them
  std::vector<char> text_;   ///< all names, one behind the other
  std::vector<std::size_t> ends_;
  std::deque<Value> values_;
};

}  // namespace cloudgen::check
