// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "image/picture.hpp"

namespace cloudgen::test {

inline double luma(const glm::vec3& color) { return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; }

/// Mean structural similarity of two pictures of one size (Wang et al. 2004, "Image quality assessment: from error
/// visibility to structural similarity"), of their encoded luma in windows of 8 x 8 pixels every 4: 1 for the same.
inline double ssim(const image::Picture& a, const image::Picture& b) {
  constexpr int kWindow = 8, kStep = 4;
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  double sum = 0;
  int windows = 0;
  for (int top = 0; top + kWindow <= a.height; top += kStep)
    for (int left = 0; left + kWindow <= a.width; left += kStep) {
      double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
      for (int j = top; j < top + kWindow; ++j)
        for (int i = left; i < left + kWindow; ++i) {
          const double p = luma(a.at(i, j)), q = luma(b.at(i, j));
          x += p, y += q, xx += p * p, yy += q * q, xy += p * q;
        }
      constexpr double n = kWindow * kWindow;
      x /= n, y /= n;
      const double vx = xx / n - x * x, vy = yy / n - y * y, cov = xy / n - x * y;
      sum += (2 * x * y + kC1) * (2 * cov + kC2) / ((x * x + y * y + kC1) * (vx + vy + kC2));
      ++windows;
    }
  return sum / std::max(windows, 1);
}

}  // namespace cloudgen::test
