// What a client that computes is sent is not trusted: whatever byte of it is wrong, it refuses,
// asks for all again, and is exact after that; or it is told trajectories.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "game/replication/trajectory_codec.h"
#include "tests/exact/exact_rink.h"

namespace rink::game {
namespace {

/// A watcher that keeps the messages of the host.
struct Keeper final : Client {
  using Client::Client;
  std::vector<std::vector<std::byte>> messages;

 private:
  void receive_host_message(rti::Bytes content) override {
    messages.emplace_back(content.begin(), content.end());
  }
};

/// All that one watcher of a part of a crowd is sent, or of all: the first message begins the
/// conversation.
std::vector<std::vector<std::byte>> conversation(double seconds, bool sees_all = false) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = sees_all ? "none" : "region",
                            .clients = 2,
                            .view_fraction = 0.3,
                            .server = {.policy = "exact", .replay = keys_for(scene, 2, seconds)}});
  const rti::Fom fom = load_rink_fom(rink::test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectModel model(fom);
  rti::InProcessEndpoint endpoint(rink.network());
  Keeper keeper(
      fom, model,
      {.federation = "rink", .name = "keeper", .view_fraction = 0.2, .only_watches = true});
  rti::FederateLink link(keeper.ambassador(), endpoint, endpoint.connect("rti"));
  rti::FederateLinks links;
  links.add(link);
  const auto exchange = [&] {
    endpoint.poll({}, links);
    link.flush(rink.now);
  };
  exchange(), rink.start(), exchange();
  for (int tick = 0; tick < static_cast<int>(30.0 * seconds); ++tick) rink.tick(), exchange();
  return keeper.messages;
}

TEST(ExactReader, ReadsWhatItIsSentAndNeverAWrongLength) {
  const auto messages = conversation(2.0);
  ASSERT_GT(messages.size(), 40u);
  ExactReplicas replicas;
  for (const auto& message : messages)
    ASSERT_EQ(replicas.receive(message), ExactReplicas::Result::exact);
  EXPECT_GT(replicas.counters().hashes, 0u);
  for (std::size_t size = 0; size < messages[0].size(); size += 1 + size / 8) {
    ExactReplicas cut;
    EXPECT_NE(cut.receive(rti::Bytes(messages[0]).first(size)), ExactReplicas::Result::exact)
        << size;
    EXPECT_FALSE(cut.is_exact());
  }
}

/// The first bit says that a conversation begins, and the next eight in which version.
TEST(ExactReader, AnotherVersionIsRefused) {
  std::vector<std::byte> first = conversation(0.1)[0];
  ASSERT_EQ(static_cast<std::uint64_t>(std::to_integer<unsigned>(first[0]) >> 1 |
                                       (std::to_integer<unsigned>(first[1]) & 1u) << 7),
            exact::exact_version);
  for (const unsigned bit : {1u, 2u, 5u}) {
    std::vector<std::byte> other = first;
    other[0] ^= static_cast<std::byte>(1u << bit);
    ExactReplicas replicas;
    EXPECT_EQ(replicas.receive(other), ExactReplicas::Result::resend);
    EXPECT_FALSE(replicas.is_exact());
    EXPECT_EQ(replicas.receive(first), ExactReplicas::Result::exact);
  }
}

/// Every byte of the first message, and every one of a later one, is once another.
TEST(ExactReader, AWrongByteIsRefusedOrFoundByTheHashAndARepeatMendsIt) {
  const auto messages = conversation(3.0);
  std::uint64_t refused = 0, survived = 0;
  const auto play = [&](std::size_t which, std::size_t at, std::byte wrong) {
    ExactReplicas replicas;
    bool is_refused = false;
    for (std::size_t k = 0; k <= which; ++k) {
      std::vector<std::byte> message = messages[k];
      if (k == which) message[at] ^= wrong;
      is_refused = replicas.receive(message) != ExactReplicas::Result::exact;
    }
    ++(is_refused ? refused : survived);
    // The conversation begins anew with what was sent first.
    ExactReplicas::Result result = ExactReplicas::Result::waiting;
    for (std::size_t k = 0; k <= which; ++k) result = replicas.receive(messages[k]);
    EXPECT_EQ(result, ExactReplicas::Result::exact) << which << " " << at;
  };
  for (std::size_t at = 0; at < messages[0].size(); at += 3)
    play(0, at, static_cast<std::byte>(1u << at % 8));
  std::size_t largest = 1;
  for (std::size_t k = 2; k < 30; ++k)
    if (messages[k].size() > messages[largest].size()) largest = k;
  for (std::size_t at = 0; at < messages[largest].size(); ++at)
    play(largest, at, static_cast<std::byte>(1u << at % 8));
  EXPECT_GT(refused, 20u);
  RecordProperty("survived", std::to_string(survived));
}

/// A receiver whose arithmetic is another's: each conversation ends in a wrong hash.
TEST(ExactReader, AHashThatStaysWrongIsHopeless) {
  const auto messages = conversation(4.0, true);
  ExactReplicas replicas;
  ExactReplicas::Result last = ExactReplicas::Result::exact;
  for (std::uint32_t attempt = 0; attempt < ExactReplicas::wrong_in_row_max; ++attempt) {
    EXPECT_NE(last, ExactReplicas::Result::hopeless);
    last = ExactReplicas::Result::exact;
    for (std::size_t k = 0; k < messages.size() && last == ExactReplicas::Result::exact; ++k) {
      std::vector<std::byte> message = messages[k];
      // The first body's lowest bits: nobody but the hash finds them.
      if (k == 0) message[message.size() / 2] ^= std::byte{1};
      last = replicas.receive(message);
    }
    EXPECT_FALSE(replicas.is_exact());
    EXPECT_NE(replicas.error(), "");
  }
  EXPECT_EQ(last, ExactReplicas::Result::hopeless);
}

}  // namespace
}  // namespace rink::game
