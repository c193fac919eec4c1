// Whole sessions of many nodes in threads of one process, with what each sends and what it costs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "game/peer/session/session.h"
#include "tests/peer/many/bytes_by_field.h"
#include "tests/peer/thread_mail.h"

namespace rink::peer::test {

/// What a node has sent since the counted windows began, and the processor time of its session
/// without its mail.
struct NodeCost {
  std::uint64_t messages = 0, bytes = 0;
  std::uint64_t agreement_messages = 0, agreement_bytes = 0;
  std::vector<std::uint64_t> messages_to, bytes_to;  ///< by node
  double processor_s = 0.0;
  SessionCounters before, after;
  double halo = 0.0, own = 0.0;  ///< at last [m]; own bodies then
  BytesByField fields;           ///< if they are kept
  std::uint64_t windows() const { return after.peer.windows - before.peer.windows; }
};

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class CountingMail final : public Mail {
 public:
  CountingMail(PostOffice& office, PeerNumber number, PeerNumber count) : mail_(office, number) {
    cost.messages_to.resize(count), cost.bytes_to.resize(count);
  }
  NodeCost cost;
  bool counts = false, is_agreement = false, keeps_fields = false;
  double seconds = 0.0;  ///< spent in here

  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override {
    const double begin = thread_seconds();
    if (counts) {
      ++cost.messages, cost.bytes += bytes.size();
      ++cost.messages_to[to], cost.bytes_to[to] += bytes.size();
      cost.agreement_messages += is_agreement,
          cost.agreement_bytes += is_agreement ? bytes.size() : 0;
      if (keeps_fields) cost.fields.count(bytes);
    }
    mail_.send(to, std::move(bytes));
    seconds += thread_seconds() - begin;
  }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    const double begin = thread_seconds();
    std::vector<std::uint8_t> bytes = mail_.receive(from);
    seconds += thread_seconds() - begin;
    return bytes;
  }

 private:
  ThreadMail mail_;
};

struct CountedRun {
  std::vector<NodeCost> nodes;              ///< by number
  std::vector<std::vector<Handover>> ends;  ///< of each node
};

struct CountedSettings {
  PeerNumber node_count = 2;
  double window = 0.02, halo = 0.3;  ///< s, m
  std::uint64_t warm_up = 10, windows = 20;
  std::size_t tree_from = SessionSettings{}.tree_from;
  bool is_replicated = true;
  bool keeps_fields = false;  ///< of messages, which takes time
  std::vector<Key> keys{};    ///< by time
};

/// All nodes play `whole`, which is at its start, until the counted windows are over.
inline CountedRun counted_run(const physics::World& whole, const CountedSettings& settings) {
  std::vector<Vector2> places;
  for (std::uint32_t body = 0; body < whole.body_count(); ++body)
    places.push_back(whole.position({body}));
  const Cuts cuts = Cuts::by_count(whole.spec().field, std::move(places), settings.node_count);
  PostOffice office(settings.node_count);
  CountedRun run;
  run.nodes.resize(settings.node_count), run.ends.resize(settings.node_count);
  const auto live = [&](PeerNumber number) {
    CountingMail mail(office, number, settings.node_count);
    mail.keeps_fields = settings.keeps_fields;
    SessionSettings own{.number = number,
                        .peer_count = settings.node_count,
                        .halo = settings.halo,
                        .is_replicated = settings.is_replicated,
                        .window_count = settings.warm_up + settings.windows,
                        .end_of = [window = settings.window](std::uint64_t k) {
                          return window * static_cast<double>(k);
                        }};
    own.keys = settings.keys, own.tree_from = settings.tree_from;
    own.hooks.when_sending = [&](Subject about) { mail.is_agreement = about == Subject::verdict; };
    Session session(whole, cuts, std::move(own), mail);
    while (session.window() < settings.warm_up) session.advance();
    mail.cost.before = session.counters();
    mail.counts = true;
    const double begin = thread_seconds() - mail.seconds;
    while (!session.is_over()) session.advance();
    mail.cost.processor_s = thread_seconds() - mail.seconds - begin;
    mail.counts = false;
    mail.cost.after = session.counters();
    mail.cost.halo = session.peer().halos().own();
    mail.cost.own = static_cast<double>(session.peer().owned().size());
    run.nodes[number] = std::move(mail.cost);
    run.ends[number] = session.end();
  };
  std::vector<std::jthread> threads;
  for (PeerNumber number = 0; number < settings.node_count; ++number)
    threads.emplace_back(live, number);
  threads.clear();
  return run;
}

}  // namespace rink::peer::test
