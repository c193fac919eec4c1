// Random federations under time management: against a sequential simulation, and against
// brute-force bounds while federates come, go and die.
#include <cmath>
#include <queue>

#include "im/basics/seeded_stream.h"
#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;
using Random = std::mt19937_64;

std::uint64_t below(Random& random, std::uint64_t count) { return random() % count; }
double fraction(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
/// A number that anybody can work out from another, for the model's federates must answer alike in
/// both runs.
std::uint64_t scattered(std::uint64_t x) { return SeededStream(x).next(); }

/// A model in which every message causes at most one more, anywhere, later: what each federate
/// hears in which order depends on nothing else (PHOLD, Fujimoto 1990).
class Model {
 public:
  struct Message {
    double time = 0.0;
    std::uint64_t id = 0;
    std::size_t receiver = 0;
    friend bool operator>(const Message& a, const Message& b) { return a.time > b.time; }
  };
  struct Member {
    double lookahead = 0.0;
    double step =
        0.0;  ///< advances from one multiple of it to the next; 0: from message to message
    bool has_rest = false;  ///< asks for the "available" form now and then
    bool flushes = false;   ///< flushes its queue and answers nothing
  };
  explicit Model(Random& random)
      : end(4.0 + 4.0 * fraction(random)), members(2 + below(random, 7)) {
    for (Member& each : members) {
      const std::uint64_t kind = below(random, 5);
      each.lookahead = kind == 0 ? 0.0 : fraction(random);
      each.step = below(random, 2) == 0 ? 0.25 + fraction(random) : 0.0;
      each.has_rest = below(random, 2) == 0;
      each.flushes = below(random, 8) == 0;
      if (each.flushes)
        each.lookahead += 0.1;  // with none, who flushes and who waits for a message creep on by
                                // the least step there is
    }
  }
  /// When a member deals with what is stamped `time`.
  double handled(std::size_t member, double time) const {
    const double step = members[member].step;
    return step == 0.0 ? time : std::min(end, step * std::ceil(time / step));
  }
  /// What handling `id` at `time` causes.
  Message answer(std::size_t member, std::uint64_t id, double time) const {
    const std::uint64_t next = scattered(id + member);
    const double wait = 0.3 * (1e-3 + static_cast<double>(next >> 40) * 0x1p-24);
    return {handled(member, time) + members[member].lookahead + wait, next,
            (member + 1 + next % (members.size() - 1)) % members.size()};
  }
  Message first(std::size_t member) const {
    return {members[member].lookahead + 0.01 * static_cast<double>(member + 1), scattered(member),
            (member + 1) % members.size()};
  }

  double end;
  std::vector<Member> members;
};

/// One queue, one thread, the least time stamp first: what every federate must hear.
std::vector<std::vector<Model::Message>> simulate_in_sequence(const Model& model) {
  std::vector<std::vector<Model::Message>> heard(model.members.size());
  std::priority_queue<Model::Message, std::vector<Model::Message>, std::greater<>> queue;
  for (std::size_t i = 0; i < model.members.size(); ++i) queue.push(model.first(i));
  for (; !queue.empty(); queue.pop()) {
    const Model::Message message = queue.top();
    if (message.time > model.end) break;
    heard[message.receiver].push_back(message);
    if (!model.members[message.receiver].flushes)
      queue.push(model.answer(message.receiver, message.id, message.time));
  }
  return heard;
}

/// The same model with a federate for each member, whose bytes travel as slowly as they like.
class Distributed {
 public:
  Distributed(const Model& model, Random& random)
      : model_(model),
        random_(random),
        federation_(relaxed(), with_entry_room(random() % 2 == 0 ? 1 : 512 << 10)) {
    for (const Model::Member& each : model.members) federation_.join_timed(each.lookahead);
    for (std::size_t i = 0; i < model.members.size(); ++i) send(i, model.first(i));
  }
  /// False if it comes to a standstill before its end.
  bool run() {
    for (std::size_t i = 0; i < model_.members.size(); ++i) ask(i);
    for (int idle = 0; idle < 2000;) {
      const std::size_t i = below(random_, model_.members.size());
      TimedFederate& federate = at(i);
      const std::size_t before = federate.heard.size();
      const std::uint64_t what = below(random_, 3);
      if (what == 0) federation_.carry_up(federate);
      else if (what == 1) federation_.tick();
      else federation_.carry_down(federate);
      idle = federate.heard.size() == before ? idle + 1 : 0;
      if (federate.heard.size() != before) take(i, before);
      if (is_over()) return true;
    }
    return false;
  }
  std::string state() {
    std::string text;
    for (std::size_t i = 0; i < model_.members.size(); ++i)
      text += "\n  " + std::to_string(at(i).clock().time()) +
              (at(i).clock().is_advancing() ? " advancing " : " granted ") + at(i).lost;
    return text + "\n  of " + std::to_string(model_.end);
  }
  TimedFederate& at(std::size_t member) { return *federation_.federates()[member]; }

 private:
  bool is_over() {
    for (std::size_t i = 0; i < model_.members.size(); ++i)
      if (at(i).clock().is_advancing() || at(i).clock().time() < model_.end) return false;
    return true;
  }
  void take(std::size_t member, std::size_t from) {
    bool is_granted = false;
    const std::vector<TimedFederate::Heard> news(
        at(member).heard.begin() + static_cast<std::ptrdiff_t>(from), at(member).heard.end());
    for (const TimedFederate::Heard& each : news) {
      if (each.what == TimedFederate::Heard::What::grant) is_granted = true;
      if (each.what == TimedFederate::Heard::What::message && !model_.members[member].flushes &&
          each.time <= model_.end)
        send(member, model_.answer(member, std::stoull(each.text), each.time));
    }
    if (!is_granted) return;
    if (at(member).clock().time() < model_.end) ask(member);
    else
      at(member).ambassador.disable_time_regulation();  // one that stays, with no lookahead, could
                                                        // still speak at the very end
  }
  void send(std::size_t member, const Model::Message& message) {
    at(member).ambassador.send_directed_interaction(
        hail, at(message.receiver).ambassador.federate(), bytes_of(std::to_string(message.id)),
        LogicalTime(message.time));
  }
  void ask(std::size_t i) {
    const Model::Member& member = model_.members[i];
    Ambassador& ambassador = at(i).ambassador;
    const double now = at(i).clock().time();
    const bool is_available = member.has_rest && below(random_, 2) == 0;
    if (member.flushes) return ambassador.flush_queue_request(LogicalTime(model_.end));
    double until = model_.end;
    if (member.step != 0.0)
      until = std::min(until, member.step * (std::floor(now / member.step + 1e-9) + 1.0));
    else if (below(random_, 2) == 0) until = now + (until - now) * fraction(random_);
    if (member.step == 0.0)
      is_available ? ambassador.next_message_request_available(LogicalTime(until))
                   : ambassador.next_message_request(LogicalTime(until));
    else
      is_available ? ambassador.time_advance_request_available(LogicalTime(until))
                   : ambassador.time_advance_request(LogicalTime(until));
  }

  const Model& model_;
  Random& random_;
  TimedFederation federation_;
};

void expect_as_in_sequence(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const Model model(random);
  const auto expected = simulate_in_sequence(model);
  Distributed distributed(model, random);
  ASSERT_TRUE(distributed.run()) << "a standstill: " << distributed.state();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::vector<std::pair<double, std::string>> heard, due;
    for (const TimedFederate::Heard& each : distributed.at(i).heard)
      if (each.what == TimedFederate::Heard::What::message && each.time <= model.end)
        heard.emplace_back(each.time, each.text);
    for (const Model::Message& each : expected[i])
      due.emplace_back(each.time, std::to_string(each.id));
    if (model.members[i].flushes) std::ranges::sort(heard);  // it asked to hear early
    ASSERT_EQ(heard, due) << "federate " << i;
  }
}

TEST(TimeOracle, FederatesHearWhatOneQueueInOneThreadGivesThem) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) expect_as_in_sequence(seed);
}

TEST(TimeOracleLong, FederatesHearWhatOneQueueInOneThreadGivesThem) {
  for (std::uint64_t seed = 1000; seed <= 6000; ++seed) expect_as_in_sequence(seed);
}

}  // namespace
}  // namespace rink::rti
