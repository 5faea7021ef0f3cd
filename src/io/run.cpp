#include "ifsi/io/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include "atomic_file.hpp"
#include "console.hpp"
#include "ifsi/io/checkpoint.hpp"
#include "ifsi/io/root.hpp"
#include "ifsi/io/summary.hpp"
#include "run_end.hpp"
#include "run_options.hpp"

namespace ifsi {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t signal_received = 0;
void note_signal(int) { signal_received = 1; }

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// The slowest rank of each section that rank 0 has entered.
std::vector<std::pair<std::string, double>> slowest(const Timers& timers, const Communicator& comm) {
  std::vector<std::pair<std::string, double>> totals;
  const long n = comm.max(comm.is_root() ? static_cast<long>(timers.sections().size()) : 0L);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    const std::string name = broadcast(comm, comm.is_root() ? timers.sections()[i].name : "");
    totals.emplace_back(name, comm.max(timers.seconds(name)));
  }
  return totals;
}

std::string check_text(const Check& c) {
  return fmt::format("  {}  {} = {:.6g}, reference {:.6g}, tolerance {:.3g} ({})",
                     c.pass ? "ok    " : "FAILED", c.name, c.value, c.reference, c.tolerance, c.source);
}

}  // namespace

struct Run::State {
  State(CaseInfo info_, detail::RunOptions options_, Communicator comm_)
      : info(std::move(info_)), options(std::move(options_)), comm(comm_), console(options.verbose) {}

  CaseInfo info;
  detail::RunOptions options;
  Communicator comm;
  detail::Console console;
  bool parsed = false;
  std::string restart_file;
  std::vector<std::pair<std::string, Parameters::Value>>
      parameters;  // as parsed: the variables may die before the run
  std::vector<std::pair<std::string, double>> metrics;
  std::vector<std::string> units;
  std::vector<Check> checks;

  void end_if_asked(const Parameters& params) const;
  void open_output();
  void find_restart();
  void print_outcome();
  [[nodiscard]] ExitCode outcome() const;
};

void Run::State::end_if_asked(const Parameters& params) const {
  std::string text;
  if (options.help) text = options.help_text + "\nParameters:\n" + params.table();
  if (options.describe) text = info.name + ": " + info.description + "\n";
  if (options.params) text = params.table();
  if (options.print_config) text = params.to_toml();
  if (options.check) text = info.name + ": the configuration is valid\n";
  if (text.empty()) return;
  if (comm.is_root()) std::fputs(text.c_str(), stdout);
  throw detail::EndedByOption{};
}

void Run::State::open_output() {
  on_root(comm, [&] {
    const fs::path out(options.out);
    std::error_code error;
    fs::create_directories(out, error);
    fs::remove(out / "STOP", error);
    fs::remove(out / "summary.json",
               error);  // there is one if and only if the run in this folder has finished
    if (!console.open_log((out / "log.txt").string(), options.restart.has_value()))
      throw Error(ExitCode::file, "cannot write in the output folder '" + options.out +
                                      "'; expected --out DIR, a folder that can be made and written");
  });
}

void Run::State::find_restart() {
  if (!options.restart) return;
  restart_file = *options.restart;
  if (restart_file.empty()) on_root(comm, [&] { restart_file = latest_checkpoint(options.out); });
  restart_file = broadcast(comm, restart_file);
}

void Run::State::print_outcome() {
  for (std::size_t i = 0; i < metrics.size(); ++i)
    console.line(fmt::format("  {} = {:.9g} {}", metrics[i].first, metrics[i].second, units[i]));
  for (const Check& c : checks) console.line(check_text(c));
}

/// A metric that is not finite is worse than a missed reference.
ExitCode Run::State::outcome() const {
  for (const auto& [name, value] : metrics)
    if (!std::isfinite(value))
      throw Error(ExitCode::invalid_state,
                  fmt::format("metric {} is {}; expected a finite number", name, value));
  for (const Check& c : checks)
    if (!c.pass) return ExitCode::check_failed;
  return ExitCode::ok;
}

Run::Run(int argc, const char* const* argv, CaseInfo info, Communicator comm) {
  detail::RunOptions options = detail::read_options(argc, argv, info.name, info.description);
  state_ = std::make_unique<State>(std::move(info), std::move(options), comm);
}

Run::~Run() = default;

void Run::parse() {
  State& s = *state_;
  if (!s.options.describe) params.load(s.options.config, s.options.assignments);
  s.end_if_asked(params);
  s.find_restart();
  s.open_output();
  signal_received = 0;
  std::signal(SIGTERM, note_signal);
  std::signal(SIGINT, note_signal);
  for (const std::string& key : params.keys()) s.parameters.emplace_back(key, params.value(key));
  s.parsed = true;
  log(fmt::format("{}: {}; ranks: {}, output: {}", s.info.name, s.info.description, s.comm.size(),
                  s.options.out));
}

const Communicator& Run::comm() const { return state_->comm; }
std::string Run::path(const std::string& name) const {
  return (fs::path(state_->options.out) / name).string();
}
bool Run::restarted() const { return state_->options.restart.has_value(); }
std::string Run::restart_file() const { return state_->restart_file; }

void Run::log(const std::string& line) {
  if (comm().is_root()) state_->console.line(line);
}
void Run::detail(const std::string& line) {
  if (comm().is_root()) state_->console.detail(line);
}
void Run::progress(double done, const std::string& line) {
  if (comm().is_root()) state_->console.progress(done, line);
}
void Run::log_failure(const std::string& message) {
  if (comm().is_root()) state_->console.failure(message);
}

CsvFile Run::csv(const std::string& name, const std::vector<Column>& columns, double resume_at) {
  CsvFile file;
  if (restarted()) comm().barrier();  // other ranks may still be reading the rows that the file keeps
  on_root(comm(), [&] {
    file = restarted() ? CsvFile(path(name), columns, resume_at) : CsvFile(path(name), columns);
  });
  return file;
}

void Run::metric(const std::string& name, double value, const std::string& unit) {
  state_->metrics.emplace_back(name, value);
  state_->units.push_back(unit);
}

bool Run::add_check(const std::string& name, double value, double reference, double tolerance, bool pass,
                    const std::string& source) {
  state_->checks.push_back({name, value, reference, tolerance, pass, source});
  return pass;
}

bool Run::check(const std::string& name, double value, double reference, double tolerance,
                const std::string& source) {
  const double allowed = reference == 0.0 ? tolerance : tolerance * std::abs(reference);
  return add_check(name, value, reference, tolerance, std::abs(value - reference) <= allowed, source);
}

bool Run::check_between(const std::string& name, double value, double min, double max,
                        const std::string& source) {
  const double middle = 0.5 * (min + max), half = 0.5 * (max - min);
  const double tolerance = middle == 0.0 ? half : half / std::abs(middle);
  return add_check(name, value, middle, tolerance, value >= min && value <= max, source);
}

bool Run::check_at_most(const std::string& name, double value, double bound, const std::string& source) {
  return add_check(name, value, bound, 0.0, value <= bound, "at most; " + source);
}

bool Run::check_at_least(const std::string& name, double value, double bound, const std::string& source) {
  return add_check(name, value, bound, 0.0, value >= bound, "at least; " + source);
}

bool Run::stop_requested() {
  std::error_code error;
  const bool file = comm().is_root() && fs::remove(path("STOP"), error);
  return comm().any(file || signal_received != 0);
}

ExitCode Run::finish() {
  State& s = *state_;
  if (!s.parsed) throw std::logic_error("the driver of '" + s.info.name + "' did not call Run::parse");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  Summary summary;
  summary.case_name = s.info.name;
  summary.ranks = comm().size();
  summary.threads = threads;
  summary.dofs = totals.dofs;
  summary.steps = totals.steps;
  summary.newton_total = totals.newton;
  summary.gmres_total = totals.gmres;
  summary.wall_s = s.console.elapsed();
  summary.cpu_s = comm().sum(seconds(usage.ru_utime) + seconds(usage.ru_stime));
  summary.peak_rss_mb = comm().sum(static_cast<double>(usage.ru_maxrss) * 1024e-6);  // the system counts KiB
  summary.metrics = s.metrics;
  summary.checks = s.checks;
  summary.timers = slowest(timers, comm());
  summary.date = now_utc();
  summary.parameters = s.parameters;
  on_root(comm(), [&] {
    s.print_outcome();
    detail::write_atomically(path("summary.json"), to_json(summary));
    s.console.line(
        fmt::format("{}: finished in {:.1f} s, {}", s.info.name, summary.wall_s, path("summary.json")));
  });
  return s.outcome();
}

}  // namespace ifsi
