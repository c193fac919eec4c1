// Progress lines and the time left.
#include "loadgen/run/progress.h"

#include <cmath>
#include <string>

namespace rink::loadgen {
namespace {

std::string left_text(double left_s) {
  const auto whole = static_cast<long>(std::ceil(left_s));
  const std::string seconds = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (seconds.size() < 2 ? "0" : "") + seconds;
}

std::string position(std::size_t number, std::size_t count) {
  const std::string total = std::to_string(count), own = std::to_string(number);
  return "[" + std::string(total.size() - own.size(), ' ') + own + "/" + total + "] ";
}

std::string words_for(const Cell& cell) {
  return (cell.part.empty() ? "" : cell.part + ": ") + cell.scheme + ", " + cell.policy + ", " +
         std::to_string(cell.clients) + " clients, seed " + std::to_string(cell.seed);
}

}  // namespace

Progress::Progress(std::ostream& out, bool is_terminal, std::size_t cell_count,
                   double expected_cell_s)
    : out_(out),
      is_terminal_(is_terminal),
      cell_count_(cell_count),
      expected_cell_s_(expected_cell_s) {}

double Progress::left_s() const {
  if (expected_of_)
    return (expected_s_ - expected_done_s_) *
           (expected_done_s_ > 0.0 ? spent_s_ / expected_done_s_ : 1.0);
  const double cell_s =
      finished_count_ == 0 ? expected_cell_s_ : spent_s_ / static_cast<double>(finished_count_);
  return cell_s * static_cast<double>(cell_count_ - finished_count_);
}

void Progress::starts(const Cell& cell) {
  if (!is_terminal_) return;
  out_ << "\r\033[K" << position(finished_count_ + 1, cell_count_) << words_for(cell) << "   about "
       << left_text(left_s()) << " left" << std::flush;
}

void Progress::finished(const RunRecord& record, double took_s) {
  ++finished_count_;
  spent_s_ += took_s;
  if (expected_of_) expected_done_s_ += expected_of_(record.cell);
  clear();
  const std::string line = position(finished_count_, cell_count_) + words_for(record.cell);
  if (!record.valid) {
    out_ << line << ": INVALID: " << record.why_invalid << "\n" << std::flush;
  } else if (!is_terminal_) {
    out_ << line << ", about " << left_text(left_s()) << " left\n" << std::flush;
  }
}

void Progress::clear() {
  if (is_terminal_) out_ << "\r\033[K" << std::flush;
}

}  // namespace rink::loadgen
