// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/selection.hpp"

namespace cloudgen::runtime {

/// When the list is made anew. Larger limits cost less and err more.
struct LazyOptions {
  float moveMeters = 40;            ///< the list holds until the camera has moved by this much
  float turnRadians = 0.10f;        ///< or turned
  int slices = 5;                   ///< a new list is made over so many frames
  std::size_t mostPuffs = 4 << 20;  ///< that are ever drawn at once
};

/// The puffs that a camera sees, the farthest first. The list is kept while the camera stays near the place where it was
/// made; meanwhile the next one is made, a slice a frame, from a third of the limits on. A camera that leaves the limits
/// before the next list is ready gets a whole new one at once. Two puffs may be out of order only where their distances
/// from the eye differ by less than `orderErrorMeters`, or by 1/1024 of the distance; everything that is in view is in
/// the list.
class DrawList {
 public:
  DrawList() = default;
  /// For sets of at most so many clouds, tiles and puffs in all. Throws std::bad_alloc; nothing is allocated later.
  DrawList(const PackView& pack, std::size_t instances, std::size_t tiles, std::uint64_t puffs,
           const LazyOptions& options);

  /// The list for this frame. True if it is another one than in the frame before.
  bool update(const CloudSet& clouds, const Camera& camera, const DetailOptions& detail) noexcept;
  /// What `update` must not keep: the clouds or the detail changed.
  void forget() noexcept { isMade_ = isMaking_ = false; }

  std::size_t capacity() const noexcept { return keys_.size(); }
  std::span<const DrawPuff> puffs() const noexcept { return {lists_[shown_].data(), count_}; }
  float orderErrorMeters() const noexcept { return orderError_; }
  const Selection& selection() const noexcept { return selection_; }

 private:
  bool isWithin(const Camera& made, const Camera& now, float share) const noexcept;
  void begin(const CloudSet& clouds, const Camera& camera, const DetailOptions& detail) noexcept;
  /// Goes on with the next list; true once it is shown.
  bool advance(std::uint64_t work) noexcept;

  LazyOptions options_;
  Selection selection_;
  std::vector<DrawPuff> lists_[2], half_;  ///< shown and next; sorted by the low byte
  std::vector<std::uint16_t> halfKeys_, keys_;
  int shown_ = 0;
  std::size_t count_ = 0;
  bool isMade_ = false, isMaking_ = false;
  int passesDone_ = 0;
  RadixPass pass_;
  bool isPassBegun_ = false;
  std::size_t passMoved_ = 0;
  bool isSelected_ = false;
  Camera madeFor_, makingFor_;
  std::uint64_t lastWork_ = 0;
  float orderError_ = 0;
};

}  // namespace cloudgen::runtime
