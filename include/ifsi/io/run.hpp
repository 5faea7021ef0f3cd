#pragma once
/// \file
/// One run of a case: command line, output folder, log, metrics and checks, summary, exit code.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ifsi/core/communicator.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/core/timers.hpp"
#include "ifsi/io/csv.hpp"
#include "ifsi/io/parameters.hpp"

namespace ifsi {

struct CaseInfo {
  std::string name, description;
};

/// What a driver works with. Declare the parameters, call parse(), compute, hand over metrics and checks.
/// Every rank makes the same calls; only rank 0 writes and prints.
///
/// Options: --config FILE, --set key=value (repeatable), --out DIR, --restart[=FILE], --verbose, and those
/// that print and end: --help, --describe, --params, --print-config, --check.
class Run {
 public:
  Run(int argc, const char* const* argv, CaseInfo info, Communicator comm = Communicator());
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run();

  Parameters params;
  Timers timers;
  /// Sums over the whole run, for the summary.
  struct Totals {
    long dofs = 0, steps = 0, newton = 0, gmres = 0;
  } totals;
  int threads = 1;  ///< per rank

  /// Reads configuration and command line into the declared parameters and opens the output folder. Throws
  /// Error(configuration) or Error(file); does not return for the options that print and end.
  void parse();

  [[nodiscard]] const Communicator& comm() const;
  /// Path of a file in the output folder.
  [[nodiscard]] std::string path(const std::string& name) const;
  /// True when this run continues an earlier one; restart_file() is then the checkpoint to read.
  [[nodiscard]] bool restarted() const;
  [[nodiscard]] std::string restart_file() const;

  /// A line for the terminal and log.txt.
  void log(const std::string& line);
  /// A line for log.txt (and, with --verbose, the terminal): a Newton iteration, for instance.
  void detail(const std::string& line);
  /// A line per time step. `done` in [0, 1] is the part of the work that is behind. A terminal shows it in
  /// place, with the time left; a file gets a line whenever another 2 % are done or 10 s have passed; log.txt
  /// gets all.
  void progress(double done, const std::string& line);

  /// Collective. CSV table in the output folder; a restarted run keeps the rows up to `resume_at` in the
  /// first column.
  [[nodiscard]] CsvFile csv(const std::string& name, const std::vector<Column>& columns,
                            double resume_at = 0.0);

  /// Figures of the run. A metric that is not finite makes the run fail with ExitCode::invalid_state.
  void metric(const std::string& name, double value, const std::string& unit = "");
  /// |value - reference| <= tolerance |reference| (tolerance itself when reference is 0). Returns whether it
  /// holds; a check that fails makes the run end with ExitCode::check_failed.
  bool check(const std::string& name, double value, double reference, double tolerance,
             const std::string& source);
  /// min <= value <= max, recorded as the middle and half the width.
  bool check_between(const std::string& name, double value, double min, double max,
                     const std::string& source);
  /// One-sided: value <= bound, value >= bound; recorded with tolerance 0 and the side named in the source.
  bool check_at_most(const std::string& name, double value, double bound, const std::string& source);
  bool check_at_least(const std::string& name, double value, double bound, const std::string& source);

  /// Collective. True once SIGTERM or SIGINT came to any rank or a file STOP lies in the output folder. The
  /// time loop then writes a checkpoint and throws Error(ExitCode::stopped).
  [[nodiscard]] bool stop_requested();

  /// Collective: writes summary.json and prints metrics and checks. Called by run_case.
  ExitCode finish();
  /// Adds the message of a failure to log.txt, where there is one.
  void log_failure(const std::string& message);

 private:
  struct State;
  bool add_check(const std::string& name, double value, double reference, double tolerance, bool pass,
                 const std::string& source);
  std::unique_ptr<State> state_;
};

/// A whole main(): starts MPI, makes the run, calls `body`, finishes, and returns the exit code. A failure is
/// reported once; when only some ranks fail, the others are ended with the same code.
int run_case(int argc, char** argv, const CaseInfo& info, const std::function<void(Run&)>& body);

}  // namespace ifsi
