#include "ifsi/simulation/valve_figures.hpp"

#include "ifsi/core/error.hpp"
#include "ifsi/simulation/profiles.hpp"

namespace ifsi {

namespace {
constexpr double mmHg = 1333.22;  // dyn/cm^2
}

std::vector<Column> ValveCurves::columns() {
  return {{"t", "s"},
          {"flow", "cm^3/s"},
          {"goa", "cm^2"},
          {"v_max", "cm/s"},
          {"pressure_drop", "dyn/cm^2"},
          {"s1_p99", "dyn/cm^2"},
          {"det_f_min", "-"},
          {"volume_change", "-"}};
}

void ValveCurves::read(const std::string& file, double t_end) {
  std::vector<std::vector<double>> rows;
  for (const Column& column : columns()) {
    const auto curve = read_profile(file, column.name + " [" + column.unit + "]");
    if (!curve) throw Error(ExitCode::file, file + ": no column \"" + column.name + "\"");
    rows.resize(curve->size());
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].push_back((*curve)[k].second);
  }
  for (const auto& x : rows)
    if (x[0] <= t_end * (1.0 + 1e-12)) add({x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]});
}

/// First and last crossing of the middle between the area at rest and the largest one.
void ValveCurves::find_opening(Figures& f) const {
  const double half = 0.5 * (f.goa_rest + f.goa_max);
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &a = samples_[k - 1], &b = samples_[k];
    if ((a.area < half) == (b.area < half)) continue;
    const double t = a.t + (b.t - a.t) * (half - a.area) / (b.area - a.area);
    if (f.t_open == 0.0) f.t_open = t;
    if (b.area < half) f.t_close = t;
  }
}

/// Net volume that has passed: the most of it, what has come back when the flow stops first, and at the end.
void ValveCurves::find_volumes(Figures& f) const {
  double passed = 0.0, at_stop = 0.0;
  bool stopped = false;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &a = samples_[k - 1], &b = samples_[k];
    passed += 0.5 * (b.t - a.t) * (a.flow + b.flow);
    if (passed >= f.forward) f.forward = passed, f.t_turn = b.t, stopped = false, at_stop = passed;
    if (!stopped && b.flow < 0.0) at_stop = std::min(at_stop, passed);
    stopped = stopped || (b.flow >= 0.0 && at_stop < f.forward);
  }
  f.closing = f.forward - at_stop, f.leak = at_stop - passed;
}

/// Fastest while blood goes forward, and after it has turned.
void ValveCurves::find_jets(Figures& f) const {
  for (const Sample& s : samples_) {
    double& jet = s.t <= f.t_turn ? f.jet_peak : f.jet_closing;
    jet = std::max(jet, s.speed);
  }
}

ValveCurves::Figures ValveCurves::figures(double rho) const {
  Figures f;
  if (samples_.empty()) return f;
  f.goa_rest = samples_.front().area, f.goa_end = samples_.back().area;
  for (const Sample& s : samples_) {
    f.goa_max = std::max(f.goa_max, s.area);
    f.drop_peak = std::max(f.drop_peak, s.pressure_drop), f.s1_p99 = std::max(f.s1_p99, s.stress);
    f.det_F_min = std::min(f.det_F_min, s.det_F);
    f.volume_change = std::max(f.volume_change, std::abs(s.volume_change));
  }
  find_opening(f), find_volumes(f), find_jets(f);
  double time = 0.0, drop = 0.0, square = 0.0;  // while blood goes forward against a positive difference
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample& s = samples_[k];
    const double dt = s.t - samples_[k - 1].t;
    if (s.flow <= 0.0 || s.pressure_drop <= 0.0) continue;
    time += dt, drop += dt * s.pressure_drop, square += dt * s.flow * s.flow;
  }
  if (time == 0.0) return f;
  f.drop_mean = drop / time;
  f.eoa = std::sqrt(square / time) / std::sqrt(2.0 * f.drop_mean / rho);
  return f;
}

void report(Run& run, const ValveCurves::Figures& f, bool whole_beat) {
  run.metric("goa_rest", f.goa_rest, "cm^2"), run.metric("goa_max", f.goa_max, "cm^2");
  run.metric("goa_end", f.goa_end, "cm^2");
  run.metric("t_open", f.t_open, "s"), run.metric("t_close", f.t_close, "s");
  run.metric("t_turn", f.t_turn, "s");
  run.metric("jet_peak", f.jet_peak, "cm/s"), run.metric("jet_closing", f.jet_closing, "cm/s");
  run.metric("pressure_drop_mean", f.drop_mean / mmHg, "mmHg");
  run.metric("pressure_drop_peak", f.drop_peak / mmHg, "mmHg");
  run.metric("eoa", f.eoa, "cm^2");
  run.metric("forward_volume", f.forward, "cm^3"), run.metric("closing_volume", f.closing, "cm^3");
  run.metric("leak_volume", f.leak, "cm^3");
  run.metric("regurgitant_fraction", f.regurgitant_fraction());
  run.metric("s1_p99", f.s1_p99, "dyn/cm^2"), run.metric("det_f_min", f.det_F_min);
  run.metric("volume_change_max", f.volume_change);
  if (!whole_beat) return;
  const std::string source = "normal adults, Baumgartner et al., J. Am. Soc. Echocardiogr. 22 (2009) 1-23";
  run.check_between("goa_max", f.goa_max, 3.0, 4.5, source + ": 3 to 4 cm^2; this vessel is a wide one");
  run.check_at_most("jet_peak", f.jet_peak, 250.0, source + ": no stenosis up to 2.5 m/s");
  run.check_at_most("regurgitant_fraction", f.regurgitant_fraction(), 0.05, "goal of the case");
}

}  // namespace ifsi
