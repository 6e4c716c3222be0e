// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "check/pack/read_pack.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// What a pack must be beyond bytes that can be walked. One finding a rule and array: the first that breaks it,
/// and how many do.
class PackRules {
 public:
  /// `start` is where the bytes of the pack begin.
  PackRules(const pack::RuntimePack& root, const char* start, FindingList& findings)
      : root_(root), start_(start), findings_(findings) {}

  void check();

 private:
  bool arraysAreThere();
  void checkAlignment();
  void checkArchetypes();
  void checkPuffs(const pack::Archetype& archetype, const std::string& name);
  void checkInstances();
  void checkRecords();
  void checkTiles();
  void checkPictures();
  void checkLight();
  void checkKeyframes();
  void error(std::string_view rule, std::string message);
  /// Tells of the entries of an array that break a rule, by `breaks(index)`.
  template <class Breaks>
  void each(std::string_view rule, std::string_view array, std::uint32_t count, std::string_view what,
            Breaks breaks);

  const pack::RuntimePack& root_;
  const char* start_;
  FindingList& findings_;
};

}  // namespace cloudgen::check
