#pragma once
/// \file
/// Wall-clock time spent in named sections of a run.

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace ifsi {

/// Totals per section, in the order of first use. Sections may nest; each total includes what is inside it.
class Timers {
 public:
  struct Section {
    std::string name;
    double seconds = 0.0;
    long calls = 0;
  };

  /// Adds the time from its construction to its destruction. The Timers must outlive it.
  class Scope {
   public:
    Scope(Timers& timers, std::size_t section) : timers_(timers), section_(section) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() { timers_.add(section_, std::chrono::duration<double>(Clock::now() - start_).count()); }

   private:
    using Clock = std::chrono::steady_clock;
    Timers& timers_;
    std::size_t section_;
    Clock::time_point start_ = Clock::now();
  };

  /// `auto timing = timers.scope("assembly");` times the rest of the block.
  [[nodiscard]] Scope scope(std::string_view name) { return Scope(*this, index(name)); }
  [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }
  /// Seconds spent so far in a section; 0 when it was never entered.
  [[nodiscard]] double seconds(std::string_view name) const {
    for (const Section& s : sections_)
      if (s.name == name) return s.seconds;
    return 0.0;
  }

 private:
  std::size_t index(std::string_view name) {
    for (std::size_t i = 0; i < sections_.size(); ++i)
      if (sections_[i].name == name) return i;
    sections_.push_back({std::string(name)});
    return sections_.size() - 1;
  }
  void add(std::size_t section, double seconds) {
    sections_[section].seconds += seconds;
    ++sections_[section].calls;
  }
  std::vector<Section> sections_;
};

}  // namespace ifsi
