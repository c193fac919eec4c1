// Estimates when bytes sent now arrive, by the server's own clock, and measures the connection.
#pragma once

#include <cassert>
#include <cstdint>
#include <deque>
#include <optional>

namespace rink::game {

/// Estimates from questions and answers (Cristian 1989), without the assumption that both ways take
/// equally long: an answer has the instant of the server's clock at which the question arrived,
/// which is all that a key's stamp needs. Pure: real time is an argument and never falls.
class ServerClock {
 public:
  static constexpr double question_period = 1.0;  ///< s

  /// The number of the question to send now, if one is due.
  std::optional<std::uint64_t> ask(double now_s);
  /// Question `number` reached the server at `server_s` by its clock; the answer came at `now_s`.
  /// Answers to unknown questions are ignored.
  void answered(std::uint64_t number, double server_s, double now_s);
  /// Moves the estimates on to `now_s`, without jumps unless they are far off.
  void advance(double now_s);

  bool is_set() const { return !answers_.empty(); }
  /// The server's clock when bytes sent at `now_s` arrive, with a small reserve [s].
  double arrival(double now_s) const { return now_s + offset_; }
  /// How far behind arrival() all of the server's updates are known [s], if it sends one every
  /// `tick_s`.
  double delay(double tick_s) const {
    assert(tick_s >= 0.0);
    return round_trip_ + tick_s + margin;
  }

  double ping_s() const {
    return answers_.empty() ? 0.0 : answers_.back().round_trip;
  }  ///< of the last answer
  double jitter_s() const {
    return jitter_;
  }                     ///< mean difference of one round trip to the next (RFC 3550, 6.4.1)
  double loss() const;  ///< fraction of the last questions that had no answer within a second

  /// Asserts that questions are numbered in order, that no more samples are kept than are used, and
  /// that estimates exist once there is an answer.
  void check() const;

 private:
  static constexpr double margin = 5e-3;  ///< s: reserve for delays greater than the recent ones
  static constexpr double slew =
      0.1;  ///< how fast estimates move: a tenth of real time is not noticed
  static constexpr double jump_from = 0.25;      ///< s: greater errors are corrected by a jump
  static constexpr std::size_t remembered = 16;  ///< answers: a quarter of a minute
  static constexpr std::uint64_t hasty = 12;  ///< questions at the start, a tenth of a second apart
  static constexpr double
      held_up_times = 3.0,
      held_up_more =
          0.03;  ///< [1], [s]: answers that took this much longer than the middle one do not count
  struct Question {
    std::uint64_t number;
    double sent_s;
    bool is_answered;
  };
  struct Answer {
    double offset, round_trip;
  };

  std::deque<Question> questions_;
  std::deque<Answer> answers_;
  std::uint64_t next_ = 1;
  double next_at_s_ = 0.0, now_s_ = 0.0;
  double offset_ = 0.0, round_trip_ = 0.0, jitter_ = 0.0;
  bool is_first_ = true;
};

}  // namespace rink::game
