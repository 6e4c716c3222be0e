// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

namespace cloudgen::shape {

/// A stochastic L-system without context, drawn by a turtle (Prusinkiewicz and Lindenmayer 1990; for clouds
/// Jimenez de Parga 2018). Letters are rewritten by productions; at the end ground symbols make balls of
/// cloud where the turtle stands. Its other symbols:
///   F forward    + - left, right    & ^ down, up    \ / roll    | about    [ ] keep and go back to a place
///   > < smaller, larger             ~ turn by chance
struct Grammar {
  struct Production {
    double weight = 1;  ///< of its chance among those of one symbol
    std::string to;
  };
  struct Ground {
    double radius = 1;  ///< in steps
  };

  std::string axiom;
  std::map<char, std::vector<Production>> productions;
  std::map<char, Ground> ground;
  int depth = 1;             ///< how often symbols are rewritten
  double angleDegrees = 30;  ///< of a turn; ~ turns by at most that
  double shrink = 0.8;       ///< of step and radius, by >
};

/// Reads the text of a *.lsystem.json (schemas/lsystem.schema.json). Throws InputError that names `where`:
/// also for brackets that do not match, and for a grammar that could make more than 300,000 symbols.
Grammar grammarFromJson(const std::string& json, const std::string& where);

/// Where a ground symbol was drawn, in steps; the turtle starts at the origin, on the condensation level, and
/// looks up.
struct GrownBall {
  glm::dvec3 center;
  double radius;
};

/// Draws the grammar. Each choice is a random number whose address is the symbol's place in the derivation,
/// so that a change in one branch leaves the others as they are. At most 20,000 balls; further ones are left
/// out.
std::vector<GrownBall> grow(const Grammar& grammar, std::uint64_t seed, std::uint64_t variant);

}  // namespace cloudgen::shape
