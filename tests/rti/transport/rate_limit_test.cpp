// Who sends faster than allowed is dropped, whatever the cuts; who keeps to the limit never is.
#include <gtest/gtest.h>

#include <random>

#include "rti/admission/token_bucket.h"
#include "rti/transport/staged/rate_limiter.h"
#include "tests/rti/rig.h"
#include "tests/rti/transport/scripted_transport.h"

namespace rink::rti::testing {
namespace {

TEST(RateLimit, ABucketGivesASecondsWorthAtOnceAndItsRateFromThenOn) {
  TokenBucket bucket(100.0, 5.0);
  EXPECT_TRUE(bucket.take(100.0, 5.0));
  EXPECT_FALSE(bucket.take(1.0, 5.0));
  EXPECT_TRUE(bucket.take(50.0, 5.5));
  EXPECT_FALSE(bucket.take(1.0, 5.5));
  EXPECT_TRUE(bucket.take(100.0, 99.0)) << "no more than a second's worth is saved";
  EXPECT_FALSE(bucket.take(1.0, 99.0));
  TokenBucket unlimited(0.0, 0.0);
  EXPECT_TRUE(unlimited.take(1e18, 0.0));
}

/// Counts what is passed on.
struct ByteCount final : TransportListener {
  std::size_t bytes = 0;
  int opened = 0, closed = 0;
  CloseReason reason = CloseReason::failed;
  void on_open(ConnectionId) override { ++opened; }
  void on_bytes(ConnectionId, Bytes heard) override { bytes += heard.size(); }
  void on_close(ConnectionId, CloseReason why, const std::string&) override {
    ++closed;
    reason = why;
  }
};

struct LimitedLine {
  explicit LimitedLine(const RateLimit& limit)
      : limiter(limited.add<RateLimiter>(limit, [this] { return now; })) {
    server.listen("rti");
    id = client.connect("rti");
    hear();
  }
  void say(Bytes bytes) { client.send(id, std::span(&bytes, 1)); }
  void hear() {
    limited.poll({}, here);
    client.poll({}, there);
  }
  double now = 0.0;
  InProcessNetwork network;
  InProcessEndpoint server{network}, client{network};
  StagedTransport limited{server};
  RateLimiter& limiter;
  ByteCount here, there;
  ConnectionId id = 0;
};

/// So many frames of so many bytes of messages each.
std::vector<std::byte> frames(int count, std::uint32_t size) {
  std::vector<std::byte> bytes;
  for (int i = 0; i < count; ++i) {
    const std::vector<std::byte> header = values_of(size);
    bytes.insert(bytes.end(), header.begin(), header.end());
    bytes.resize(bytes.size() + size);
  }
  return bytes;
}

/// The same in both forms by turns.
std::vector<std::byte> frames_of_both_forms(int count, std::uint32_t size) {
  std::vector<std::byte> bytes;
  for (int i = 0; i < count; ++i) {
    const std::vector<std::byte> frame =
        i % 2 == 0 ? in_frame(std::vector<std::byte>(size, std::byte{7})) : frames(1, size);
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  return bytes;
}

TEST(RateLimit, WhoSendsMoreBytesThanAllowedIsClosedAndNamed) {
  LimitedLine line({.bytes_per_s = 1000.0});
  for (int second = 0; second < 20; ++second, line.now += 1.0) {
    line.say(frames(4, 246));
    line.hear();
  }
  EXPECT_EQ(line.here.bytes, 20'000u);
  line.say(frames(5, 246));
  line.hear();
  line.hear();
  EXPECT_EQ(line.here.closed, 1);
  EXPECT_EQ(line.here.reason, CloseReason::too_fast);
  EXPECT_STREQ(to_string(line.here.reason), "sent faster than allowed");
  EXPECT_EQ(line.there.closed, 1);
  EXPECT_EQ(line.here.bytes, 20'000u) << "what is too much is not passed on";
  EXPECT_EQ(line.limiter.closed(), 1u);
}

TEST(RateLimit, WhoExceedsItIsSentTheLastWordsFirst) {
  LimitedLine line({.bytes_per_s = 1000.0, .last_words = bytes_of("too fast")});
  line.say(frames(5, 246));
  line.hear();
  line.hear();
  EXPECT_EQ(line.there.bytes, 8u);
  EXPECT_EQ(line.there.closed, 1);
}

TEST(RateLimit, FramesCountHoweverTheyAreCut) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    LimitedLine line({.frames_per_s = 50.0});
    const std::vector<std::byte> allowed = frames_of_both_forms(
        50, static_cast<std::uint32_t>(seed % 50 == 0 ? 40'000 : 1 + random() % 30));
    for (Bytes left = allowed; !left.empty();) {
      const std::size_t size =
          std::min<std::size_t>(left.size(), 1 + random() % (seed % 50 == 0 ? 9'999 : 40));
      line.say(left.first(size));
      left = left.subspan(size);
      line.hear();
    }
    EXPECT_EQ(line.here.closed, 0);
    EXPECT_EQ(line.here.bytes, allowed.size());
    line.say(frames(1, 1));
    line.hear();
    line.hear();
    EXPECT_EQ(line.here.reason, CloseReason::too_fast);
  }
}

/// Bytes and datagrams as a script says, behind a limit.
struct LimitedScript {
  explicit LimitedScript(const RateLimit& limit, ConnectionId connections = 1)
      : limiter(limited.add<RateLimiter>(limit, [this] { return now; })) {
    for (ConnectionId id = 0; id < connections; ++id) inner.opens(id);
    hear();
  }
  void hear() { limited.poll({}, ear); }
  struct Ear final : TransportListener {
    std::map<ConnectionId, std::size_t> bytes, datagrams, datagram_bytes;
    std::map<ConnectionId, CloseReason> closed;
    void on_open(ConnectionId) override {}
    void on_bytes(ConnectionId id, Bytes heard) override { bytes[id] += heard.size(); }
    void on_datagram(ConnectionId id, Bytes heard) override {
      ++datagrams[id], datagram_bytes[id] += heard.size();
    }
    void on_close(ConnectionId id, CloseReason why, const std::string&) override {
      closed[id] = why;
    }
  };
  double now = 0.0;
  ScriptedTransport inner;
  StagedTransport limited{inner};
  RateLimiter& limiter;
  Ear ear;
};

TEST(RateLimit, DatagramsCountAsTheirBytesBesideThoseOfTheStream) {
  LimitedScript script({.bytes_per_s = 1000.0});
  script.inner.says(0, std::vector<std::byte>(400));
  for (int i = 0; i < 6; ++i) script.inner.says_by_datagram(0, std::vector<std::byte>(100));
  script.hear();
  EXPECT_EQ(script.ear.datagram_bytes[0], 600u);
  EXPECT_TRUE(script.ear.closed.empty()) << "a second's worth";
  script.inner.says_by_datagram(0, std::vector<std::byte>(1));
  script.inner.says_by_datagram(0, std::vector<std::byte>(1));
  script.inner.says(0, std::vector<std::byte>(1));
  script.hear();
  script.hear();
  EXPECT_EQ(script.ear.datagram_bytes[0], 600u)
      << "what is too much is not passed on, nor what follows it";
  EXPECT_EQ(script.ear.bytes[0], 400u);
  EXPECT_EQ(script.ear.closed.at(0), CloseReason::too_fast);
  EXPECT_EQ(script.limiter.closed(), 1u);
  EXPECT_EQ(script.inner.closed, std::vector{ConnectionId{0}}) << "once";
}

TEST(RateLimit, ADatagramCountsAsAFrame) {
  LimitedScript script({.frames_per_s = 50.0});
  script.inner.says(0, frames(20, 10));
  for (int i = 0; i < 30; ++i) script.inner.says_by_datagram(0, std::vector<std::byte>(1191));
  script.hear();
  EXPECT_EQ(script.ear.datagrams[0], 30u);
  EXPECT_TRUE(script.ear.closed.empty());
  script.inner.says_by_datagram(0, {});
  script.hear();
  EXPECT_EQ(script.ear.datagrams[0], 30u) << "an empty one too";
  EXPECT_EQ(script.ear.closed.at(0), CloseReason::too_fast);
}

TEST(RateLimit, EachConnectionHasItsOwnAndANewOneOfAnOldNumberBeginsAnew) {
  LimitedScript script({.bytes_per_s = 100.0}, 2);
  script.inner.says_by_datagram(0, std::vector<std::byte>(101));
  script.inner.says_by_datagram(1, std::vector<std::byte>(100));
  script.hear();
  EXPECT_EQ(script.ear.datagram_bytes[1], 100u) << "what another one says costs it nothing";
  EXPECT_TRUE(script.ear.closed.contains(0) && !script.ear.closed.contains(1));
  script.inner.opens(0);
  script.inner.says_by_datagram(0, std::vector<std::byte>(100));
  script.hear();
  EXPECT_EQ(script.ear.datagram_bytes[0], 100u);
}

TEST(RateLimit, DatagramsOfAConnectionThatIsNotOpenAreNotPassedOn) {
  LimitedScript script({}, 1);
  script.inner.says_by_datagram(1, std::vector<std::byte>(10));
  script.hear();
  EXPECT_TRUE(script.ear.datagrams.empty());
}

}  // namespace
}  // namespace rink::rti::testing
