#pragma once
/// \file
/// Figures of a signal in time: extremes, amplitude, frequency.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ifsi {

/// Samples (t, value) in ascending order of t.
class Signal {
 public:
  struct Extreme {
    double t, value;
  };

  void add(double t, double value) { samples_.push_back({t, value}); }
  [[nodiscard]] bool empty() const { return samples_.empty(); }

  /// The latest value; 0 when there is none.
  [[nodiscard]] double last() const { return samples_.empty() ? 0.0 : samples_.back().value; }

  /// Largest value at or after t_from, the parabola through the sample and its neighbours taken to its top.
  [[nodiscard]] Extreme max(double t_from = -std::numeric_limits<double>::infinity()) const {
    return extreme(t_from, 1.0);
  }
  [[nodiscard]] Extreme min(double t_from = -std::numeric_limits<double>::infinity()) const {
    const Extreme e = extreme(t_from, -1.0);
    return {e.t, -e.value};
  }

  /// Frequency from upward crossings of the middle between the extremes at or after t_from; 0 with fewer than
  /// two.
  [[nodiscard]] double frequency(double t_from) const {
    const double middle = 0.5 * (max(t_from).value + min(t_from).value);
    double first = 0.0, last = 0.0;
    int n = 0;
    for (std::size_t k = 1; k < samples_.size(); ++k) {
      const Extreme &a = samples_[k - 1], &b = samples_[k];
      if (a.t < t_from || a.value >= middle || b.value < middle) continue;
      last = a.t + (b.t - a.t) * (middle - a.value) / (b.value - a.value);
      if (n++ == 0) first = last;
    }
    return n < 2 ? 0.0 : (n - 1) / (last - first);
  }

  /// Mean over time at or after t_from (trapezoidal).
  [[nodiscard]] double mean(double t_from) const {
    double sum = 0.0, length = 0.0;
    for (std::size_t k = 1; k < samples_.size(); ++k) {
      const Extreme &a = samples_[k - 1], &b = samples_[k];
      if (a.t < t_from) continue;
      sum += 0.5 * (a.value + b.value) * (b.t - a.t);
      length += b.t - a.t;
    }
    return length > 0.0 ? sum / length : 0.0;
  }

  /// At each sample the mean over the width around it, as far as that lies within the record: what is slower
  /// stays (a sine of frequency f keeps sin(pi f width) / (pi f width) of its amplitude), noise from step to
  /// step goes. Itself for a width of 0.
  [[nodiscard]] Signal averaged(double width) const {
    if (samples_.empty() || width <= 0.0) return *this;
    const Signal integral = integrated();
    Signal result;
    for (const Extreme& s : samples_) {
      const double from = s.t - 0.5 * width, to = s.t + 0.5 * width;
      if (from >= samples_.front().t && to <= samples_.back().t)
        result.add(s.t, (integral.at(to) - integral.at(from)) / width);
    }
    return result;
  }

  /// Value at time t, linear between samples, constant beyond the ends.
  [[nodiscard]] double at(double t) const {
    const auto right = std::lower_bound(samples_.begin(), samples_.end(), t,
                                        [](const Extreme& e, double time) { return e.t < time; });
    if (right == samples_.begin()) return right->value;
    if (right == samples_.end()) return samples_.back().value;
    const Extreme& left = *(right - 1);
    return left.value + (right->value - left.value) * (t - left.t) / (right->t - left.t);
  }

 private:
  /// Integral over time from the first sample on (trapezoidal), at the samples.
  [[nodiscard]] Signal integrated() const {
    Signal sums;
    double sum = 0.0;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (k > 0)
        sum += 0.5 * (samples_[k - 1].value + samples_[k].value) * (samples_[k].t - samples_[k - 1].t);
      sums.add(samples_[k].t, sum);
    }
    return sums;
  }
  [[nodiscard]] Extreme extreme(double t_from, double sign) const {
    std::size_t best = samples_.size();
    for (std::size_t k = 0; k < samples_.size(); ++k)
      if (samples_[k].t >= t_from &&
          (best == samples_.size() || sign * samples_[k].value > sign * samples_[best].value))
        best = k;
    if (best == samples_.size()) return {t_from, 0.0};
    const Extreme s = samples_[best];
    if (best == 0 || best + 1 == samples_.size()) return {s.t, sign * s.value};
    const Extreme &l = samples_[best - 1], &r = samples_[best + 1];
    const double dl = (s.value - l.value) / (s.t - l.t), dr = (r.value - s.value) / (r.t - s.t);
    const double curvature = (dr - dl) / (r.t - l.t);
    if (curvature * sign >= 0.0) return {s.t, sign * s.value};
    const double slope = dl + curvature * (s.t - l.t);  // at s, of the parabola through the three
    const double shift = -0.5 * slope / curvature;
    // With equal steps a top is never further above its sample than this; noise in unequal ones throws it far
    // away.
    const double most = std::max(sign * (s.value - l.value), sign * (s.value - r.value)) / 8.0;
    const double above = sign * 0.5 * slope * shift;
    return {above <= most ? s.t + shift : s.t, sign * s.value + std::min(above, most)};
  }

  std::vector<Extreme> samples_;
};

}  // namespace ifsi
