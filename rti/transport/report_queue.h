// Events on their way to a listener that may throw.
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace rink::rti {

/// Events in the order in which they came. Each is reported once: if a listener throws, the present
/// event counts as reported, and those after it come first the next time.
template <class Event>
class ReportQueue {
 public:
  void add(Event event) { coming_.push_back(std::move(event)); }
  /// True if all that came was reported.
  bool is_empty() const { return coming_.empty() && next_ == reporting_.size(); }
  /// Calls `report(event)` for all that came before the call.
  template <class Report>
  void report_all(Report report) {
    report_rest(report);
    reporting_.swap(coming_);
    report_rest(report);
  }
  /// Calls `visit(event)` for each that is not reported yet.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t at = next_; at < reporting_.size(); ++at) visit(reporting_[at]);
    for (const Event& event : coming_) visit(event);
  }

 private:
  template <class Report>
  void report_rest(Report& report) {
    while (next_ < reporting_.size()) report(std::as_const(reporting_[next_++]));
    reporting_.clear();
    next_ = 0;
  }

  std::vector<Event> coming_, reporting_;
  std::size_t next_ = 0;  ///< of reporting_
};

}  // namespace rink::rti
