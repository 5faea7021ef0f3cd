#pragma once
/// \file
/// Quantiles over the volume of a body.

#include <algorithm>
#include <vector>

namespace ifsi {

/// A value at a quadrature point and the volume it stands for.
struct VolumeSample {
  double value, volume;
};

/// The smallest of the values that at least the given part of the volume does not exceed (eq. 30); 0 without
/// samples. \pre 0 <= part <= 1, volumes > 0
[[nodiscard]] inline double volume_quantile(std::vector<VolumeSample> samples, double part) {
  if (samples.empty()) return 0.0;
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  double total = 0.0, below = 0.0;
  for (const auto& s : samples) total += s.volume;
  for (const auto& s : samples)
    if ((below += s.volume) >= part * total) return s.value;
  return samples.back().value;
}

}  // namespace ifsi
