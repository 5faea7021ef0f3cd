#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ifsi::detail {
namespace {

constexpr double file_progress_part = 0.02, file_progress_seconds = 10.0;

/// mpirun gives its processes a pseudo-terminal whatever its own output is; the launcher tells what that is.
bool on_terminal() {
  if (const char* told = std::getenv("IFSI_TERMINAL")) return std::string(told) == "1";
  return std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && isatty(STDOUT_FILENO) == 1;
}

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

}  // namespace

Console::Console(bool verbose) : verbose_(verbose), terminal_(on_terminal()) {}

bool Console::open_log(const std::string& file, bool append) {
  log_.open(file, append ? std::ios::app : std::ios::out);
  return static_cast<bool>(log_);
}

double Console::elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void Console::clear_progress() {
  if (progress_shown_) std::fputs("\r\033[K", stdout);
  progress_shown_ = false;
  std::fflush(stdout);
}

void Console::print(const std::string& text) {
  clear_progress();
  std::puts(text.c_str());
  std::fflush(stdout);
}

void Console::failure(const std::string& text) {
  clear_progress();
  note("error: " + text);
}

void Console::line(const std::string& text) {
  note(text);
  print(text);
}

void Console::note(const std::string& text) {
  if (log_.is_open()) log_ << text << std::endl;
}

void Console::detail(const std::string& text) {
  note(text);
  if (verbose_) print(text);
}

std::string Console::time_left(double done) {
  if (first_done_ < 0.0) first_done_ = std::min(done, 1.0);
  const double rate = (done - first_done_) / elapsed();
  return rate > 0.0 ? duration_text(std::max(0.0, 1.0 - done) / rate) : "?";
}

void Console::progress(double done, const std::string& text) {
  note(text);
  const std::string shown = fmt::format("{:3.0f} %  {}  ETA {}", 100.0 * done, text, time_left(done));
  if (terminal_) {
    std::fputs(("\r\033[K" + shown).c_str(), stdout);
    std::fflush(stdout);
    progress_shown_ = true;
  } else if (line_due(done)) {
    print(shown);
    printed_done_ = done;
    printed_at_ = elapsed();
  }
}

bool Console::line_due(double done) const {
  return done >= 1.0 || done >= printed_done_ + file_progress_part ||
         elapsed() >= printed_at_ + file_progress_seconds;
}

}  // namespace ifsi::detail
