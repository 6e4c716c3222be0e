// SPDX-License-Identifier: Apache-2.0
#include "motion/line_transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "motion/lines.hpp"

namespace cloudgen::motion {
namespace {

constexpr int kPairs = kLanes / 2;  ///< lane l is the real part of what lane l + kPairs is the imaginary part of

std::vector<int> radicesOf(int count) {
  std::vector<int> radices;
  for (const int radix : {4, 2, 3, 5})
    for (; count % radix == 0; count /= radix) radices.push_back(radix);
  for (int radix = 7; count > 1; ++radix)
    for (; count % radix == 0; count /= radix) radices.push_back(radix);
  return radices;
}

}  // namespace

LineTransform::Turn LineTransform::turn(double share) {
  const double angle = 2 * std::numbers::pi * share;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

LineTransform::LineTransform(int cells, Ends ends) : cells_(cells), radices_(radicesOf(cells)) {
  const auto count = static_cast<std::size_t>(cells);
  turns_.resize(count), quarterTurns_.resize(count), places_.resize(count), factors_.resize(count);
  for (int i = 0; i < cells; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double share = static_cast<double>(i) / cells;
    turns_[at] = turn(-share);
    quarterTurns_[at] = turn(ends == Ends::Walls ? -share / 4 : 0);
    places_[at] = ends == Ends::Walls ? (i < (cells + 1) / 2 ? 2 * i : 2 * (cells - i) - 1) : i;
    const double half = std::sin(std::numbers::pi * share * (ends == Ends::Walls ? 0.5 : 1));
    factors_[at] = static_cast<float>(4 * half * half);
  }
}

/// The transform with exp(-2 pi i j k / n); backwards that with the other sign, by changing the parts. The result
/// is in `lines`.
void LineTransform::fourier(float* lines, float* spare, bool backwards) const {
  const int real = backwards ? kPairs : 0, imaginary = kPairs - real;
  float *from = lines, *to = spare;
  int length = cells_, stride = 1;
  std::vector<float> sums(2 * kPairs);
  for (const int radix : radices_) {
    const int blocks = length / radix;
    for (int block = 0; block < blocks; ++block)
      for (int q = 0; q < stride; ++q) {
        const auto source = [&](int j) {
          return from + static_cast<std::ptrdiff_t>(q + stride * (block + blocks * j)) * kLanes;
        };
        const auto target = [&](int r) {
          return to + static_cast<std::ptrdiff_t>(q + stride * (radix * block + r)) * kLanes;
        };
        const auto put = [&](int r, const float* re, const float* im) {
          const Turn by = turns_[static_cast<std::size_t>(r * block * (cells_ / length))];
          float* const out = target(r);
          for (int l = 0; l < kPairs; ++l) {
            const float a = re[l], b = im[l];
            out[real + l] = a * by.cosine - b * by.sine;
            out[imaginary + l] = a * by.sine + b * by.cosine;
          }
        };
        if (radix == 4) {
          const float *a = source(0), *b = source(1), *c = source(2), *d = source(3);
          float re[4][kPairs], im[4][kPairs];
          for (int l = 0; l < kPairs; ++l) {
            const float evenRe = a[real + l] + c[real + l], evenIm = a[imaginary + l] + c[imaginary + l],
                        gapRe = a[real + l] - c[real + l], gapIm = a[imaginary + l] - c[imaginary + l],
                        oddRe = b[real + l] + d[real + l], oddIm = b[imaginary + l] + d[imaginary + l],
                        oddGapRe = b[real + l] - d[real + l], oddGapIm = b[imaginary + l] - d[imaginary + l];
            re[0][l] = evenRe + oddRe, im[0][l] = evenIm + oddIm;
            re[1][l] = gapRe + oddGapIm, im[1][l] = gapIm - oddGapRe;
            re[2][l] = evenRe - oddRe, im[2][l] = evenIm - oddIm;
            re[3][l] = gapRe - oddGapIm, im[3][l] = gapIm + oddGapRe;
          }
          for (int r = 0; r < 4; ++r) put(r, re[r], im[r]);
          continue;
        }
        for (int r = 0; r < radix; ++r) {
          float re[kPairs] = {}, im[kPairs] = {};
          for (int j = 0; j < radix; ++j) {
            const Turn by = turns_[static_cast<std::size_t>(j * r % radix * (cells_ / radix))];
            const float* const value = source(j);
            for (int l = 0; l < kPairs; ++l) {
              re[l] += value[real + l] * by.cosine - value[imaginary + l] * by.sine;
              im[l] += value[real + l] * by.sine + value[imaginary + l] * by.cosine;
            }
          }
          put(r, re, im);
        }
      }
    std::swap(from, to);
    length /= radix, stride *= radix;
  }
  if (from != lines) std::copy(from, from + static_cast<std::ptrdiff_t>(cells_) * kLanes, lines);
}

void LineTransform::forward(float* lines) const {
  std::vector<float> ordered(static_cast<std::size_t>(cells_) * kLanes), spare(ordered.size());
  for (int i = 0; i < cells_; ++i)
    std::copy_n(lines + places_[static_cast<std::size_t>(i)] * kLanes, kLanes, &ordered[static_cast<std::size_t>(i * kLanes)]);
  fourier(ordered.data(), spare.data(), false);
  // Two real lines a and b went as a + ib. Of each, wave k keeps the real part and wave n - k minus the imaginary
  // part of the amplitude, turned.
  for (int k = 0; k <= cells_ / 2; ++k) {
    const int mirrored = (cells_ - k) % cells_;
    const Turn by = quarterTurns_[static_cast<std::size_t>(k)];
    const float *const here = &ordered[static_cast<std::size_t>(k * kLanes)],
                *const there = &ordered[static_cast<std::size_t>(mirrored * kLanes)];
    float *const low = lines + k * kLanes, *const high = lines + mirrored * kLanes;
    for (int l = 0; l < kPairs; ++l) {
      const float aRe = 0.5f * (here[l] + there[l]), aIm = 0.5f * (here[kPairs + l] - there[kPairs + l]),
                  bRe = 0.5f * (here[kPairs + l] + there[kPairs + l]), bIm = 0.5f * (there[l] - here[l]);
      high[l] = -(aRe * by.sine + aIm * by.cosine);
      high[kPairs + l] = -(bRe * by.sine + bIm * by.cosine);
      low[l] = aRe * by.cosine - aIm * by.sine;
      low[kPairs + l] = bRe * by.cosine - bIm * by.sine;
    }
  }
}

void LineTransform::backward(float* lines) const {
  std::vector<float> amplitudes(static_cast<std::size_t>(cells_) * kLanes), spare(amplitudes.size());
  const float scale = 1.0f / static_cast<float>(cells_);
  for (int k = 0; k <= cells_ / 2; ++k) {
    const int mirrored = (cells_ - k) % cells_;
    const Turn by = quarterTurns_[static_cast<std::size_t>(k)];
    const float *const low = lines + k * kLanes, *const high = lines + mirrored * kLanes;
    float *const here = &amplitudes[static_cast<std::size_t>(k * kLanes)],
          *const there = &amplitudes[static_cast<std::size_t>(mirrored * kLanes)];
    const bool alone = k == mirrored;  // its amplitude is real
    for (int l = 0; l < kPairs; ++l) {
      const auto amplitude = [&](float cosine, float sine, float& re, float& im) {
        re = alone ? scale * cosine / by.cosine : scale * (cosine * by.cosine - sine * by.sine);
        im = alone ? 0 : -scale * (cosine * by.sine + sine * by.cosine);
      };
      float aRe, aIm, bRe, bIm;
      amplitude(low[l], high[l], aRe, aIm);
      amplitude(low[kPairs + l], high[kPairs + l], bRe, bIm);
      there[l] = aRe + bIm, there[kPairs + l] = bRe - aIm;
      here[l] = aRe - bIm, here[kPairs + l] = aIm + bRe;
    }
  }
  fourier(amplitudes.data(), spare.data(), true);
  for (int i = 0; i < cells_; ++i)
    std::copy_n(&amplitudes[static_cast<std::size_t>(i * kLanes)], kLanes, lines + places_[static_cast<std::size_t>(i)] * kLanes);
}

}  // namespace cloudgen::motion
