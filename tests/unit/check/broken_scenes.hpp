// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cloudgen::check::test {

/// One edit of the good scene that breaks it, and the finding that it must lead to.
struct Broken {
  std::string what, from, to;
  std::string rule;
  int lineOffset = 0;     ///< of the finding, from the line of `from`
  bool bySchema = false;  ///< the official schema rejects it too
};

std::vector<Broken> brokenScenes();

}  // namespace cloudgen::check::test
