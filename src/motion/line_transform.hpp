// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace cloudgen::motion {

enum class Ends { Periodic, Walls };

/// Between the values at the middles of n cells in a row and their shares of the waves on which the second
/// difference acts as a factor: sines and cosines where the row closes on itself, cosines (DCT-II) between walls
/// that nothing passes. By complex fast Fourier transforms of any length (mixed radix, Stockham's order), two real
/// lines in one; those between walls as in Makhoul 1980, "A fast cosine transform in one and two dimensions".
class LineTransform {
 public:
  LineTransform(int cells, Ends ends);

  /// kLanes lines, place i of lane l at [i * kLanes + l].
  void forward(float* lines) const;
  void backward(float* lines) const;
  /// The second difference of wave i is minus this times it; rises from 0 to at most 4.
  float factor(int wave) const { return factors_[static_cast<std::size_t>(wave)]; }

 private:
  struct Turn {
    float cosine, sine;
  };
  static Turn turn(double share);
  void fourier(float* lines, float* spare, bool backwards) const;

  int cells_;
  std::vector<int> radices_;
  std::vector<Turn> turns_;        ///< of i n-ths of a whole turn, backwards
  std::vector<Turn> quarterTurns_;  ///< that a wave is shifted by
  std::vector<int> places_;        ///< of the cells, in the order that is transformed
  std::vector<float> factors_;
};

}  // namespace cloudgen::motion
