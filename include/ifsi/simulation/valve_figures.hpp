#pragma once
/// \file
/// The figures of a heart valve over a beat.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/io/run.hpp"

namespace ifsi {

/// Area that the free edge of a leaflet encloses with the two planes of its commissures, seen along the axis.
/// \param edge nodes in order of the angle; \param from, to angles of the planes (or cuts) at its ends;
/// \param radius of the vessel, beyond which nothing counts.
[[nodiscard]] inline double orifice_area(const std::vector<Vec<double, 3>>& edge, double from, double to,
                                         double radius) {
  std::vector<Vec<double, 2>> line;
  for (const auto& x : edge) {
    const double scale = std::min(1.0, radius / std::max(std::hypot(x[0], x[1]), 1e-300));
    line.push_back({scale * x[0], scale * x[1]});
  }
  const auto on_plane = [&](const Vec<double, 2>& x, double angle) {
    const double r = std::hypot(x[0], x[1]);
    return Vec<double, 2>{r * std::cos(angle), r * std::sin(angle)};
  };
  line.insert(line.begin(), on_plane(line.front(), from));
  line.push_back(on_plane(line.back(), to));
  double twice = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k)
    twice += line[k - 1][0] * line[k][1] - line[k - 1][1] * line[k][0];
  return 0.5 * twice;
}

/// The curves of a beat, of the whole valve, and the figures that follow from them. Definitions:
/// docs/cases/semilunar_valve.md.
class ValveCurves {
 public:
  struct Sample {
    double t, flow, area, speed, pressure_drop;  ///< s, cm^3/s, cm^2, cm/s, dyn/cm^2
    double stress, det_F, volume_change;         ///< of the leaflets: s1_p99 (eq. 30), the smallest, relative
  };
  void add(const Sample& sample) { samples_.push_back(sample); }
  /// Columns of history.csv that hold the samples, and a sample as a row of them.
  [[nodiscard]] static std::vector<Column> columns();
  [[nodiscard]] static std::vector<double> row(const Sample& s) {
    return {s.t, s.flow, s.area, s.speed, s.pressure_drop, s.stress, s.det_F, s.volume_change};
  }
  /// Reads back what an interrupted run has written until t_end. \param file history.csv
  void read(const std::string& file, double t_end);

  struct Figures {
    double goa_rest = 0.0, goa_max = 0.0, goa_end = 0.0, t_open = 0.0, t_close = 0.0, t_turn = 0.0;
    double jet_peak = 0.0, jet_closing = 0.0, drop_mean = 0.0, drop_peak = 0.0, eoa = 0.0;
    double forward = 0.0, closing = 0.0, leak = 0.0;
    double s1_p99 = 0.0, det_F_min = 1.0, volume_change = 0.0;
    [[nodiscard]] double regurgitant_fraction() const {
      return forward > 0.0 ? (closing + leak) / forward : 0.0;
    }
  };
  /// \param rho density of the blood
  [[nodiscard]] Figures figures(double rho) const;

 private:
  void find_opening(Figures& f) const;
  void find_volumes(Figures& f) const;
  void find_jets(Figures& f) const;

  std::vector<Sample> samples_;
};

/// Writes the figures to the summary; those of a whole beat are held to what is normal in man.
void report(Run& run, const ValveCurves::Figures& figures, bool whole_beat);

}  // namespace ifsi
