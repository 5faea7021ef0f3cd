#pragma once
/// \file
/// Outcome of a run: metrics, checks against references, cost; written as summary.json.

#include <string>
#include <utility>
#include <vector>

#include "ifsi/io/parameters.hpp"

namespace ifsi {

/// One figure held against a reference. `tolerance` is relative to |reference|; absolute when reference is 0.
struct Check {
  std::string name;
  double value, reference, tolerance;
  bool pass;
  std::string source;
};

struct Summary {
  std::string case_name;
  int ranks = 1, threads = 1;  ///< threads: per rank
  long dofs = 0, steps = 0, newton_total = 0, gmres_total = 0;
  double wall_s = 0.0;
  double cpu_s = 0.0;        ///< user and system time, all ranks
  double peak_rss_mb = 0.0;  ///< largest resident memory of each rank, summed [1e6 B]
  std::vector<std::pair<std::string, double>> metrics;
  std::vector<Check> checks;
  std::vector<std::pair<std::string, double>> timers;  ///< seconds, the slowest rank of each section
  std::string date;                                    ///< end of the run, UTC, ISO 8601
  std::vector<std::pair<std::string, Parameters::Value>> parameters;
};

/// JSON text; the build's version, commit, compiler, flags and processor are added. NaN becomes null.
[[nodiscard]] std::string to_json(const Summary& summary);

}  // namespace ifsi
