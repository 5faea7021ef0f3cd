#pragma once
/// \file
/// Terminal and log file of a run: lines, and progress with the time left.

#include <chrono>
#include <fstream>
#include <string>

namespace ifsi::detail {

class Console {
 public:
  explicit Console(bool verbose);

  /// Opens log.txt; false when it cannot be written.
  bool open_log(const std::string& file, bool append);
  void line(const std::string& text);
  void detail(const std::string& text);
  void progress(double done, const std::string& text);
  /// Notes a failure in the log and leaves the terminal to its message.
  void failure(const std::string& text);
  [[nodiscard]] double elapsed() const;

 private:
  using Clock = std::chrono::steady_clock;
  void note(const std::string& text);
  void print(const std::string& text);
  void clear_progress();
  [[nodiscard]] std::string time_left(double done);
  [[nodiscard]] bool line_due(double done) const;

  bool verbose_, terminal_;
  std::ofstream log_;
  Clock::time_point start_ = Clock::now();
  bool progress_shown_ = false;
  double first_done_ = -1.0;                       // a restarted run begins in the middle
  double printed_done_ = -1.0, printed_at_ = 0.0;  // of the last progress line in a file
};

}  // namespace ifsi::detail
