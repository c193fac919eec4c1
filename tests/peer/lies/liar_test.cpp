// A peer whose engine is honest and one of whose messages is not: whichever field of it is wrong,
// nobody else crashes, or waits for ever.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <iostream>

#include "im/basics/byte_stream.h"
#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

/// Visits the fields of a message as a writer does, and leaves one of them otherwise than it was.
class Spoiler : public ByteStream<Spoiler> {
 public:
  static constexpr bool is_reading = true;
  /// Field `which`, counted from 0, becomes what `random` makes of it.
  Spoiler(std::uint64_t which, Random& random) : which_(which), random_(random) {}
  bool part(std::uint64_t& value, std::size_t size) {
    if (count_++ != which_) return true;
    value = size == 8 ? wrong_number(value) : size == 4 ? wrong_count(value) : wrong_byte(value);
    return true;
  }
  /// Each of its bytes may be wrong.
  template <class Number>
  bool varint(Number& number) {
    std::array<std::byte, varint_size_max> bytes{};
    put_varint(bytes.data(), number);
    std::size_t size = 0;
    for (std::uint64_t byte = 0x80; byte >= 0x80 && size < bytes.size(); ++size) {
      byte = static_cast<std::uint64_t>(bytes[size]);
      part(byte, 1);
      bytes[size] = static_cast<std::byte>(byte);
    }
    return ByteReader(std::span(bytes).first(size)).varint(number);
  }
  static bool check(bool is_sound) { return is_sound; }
  static std::uint64_t count_max() { return 4096; }
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t wrong_number(std::uint64_t value) {
    const double was = std::bit_cast<double>(value);
    const std::array numbers{std::nan(""), HUGE_VAL,  -HUGE_VAL, 1e300,      -1e300,
                             4e9,          was + 1e6, was - 1e6, was + 0.02, was - 0.02,
                             1.1 * was,    -was,      0.0};
    const auto which = static_cast<std::size_t>(below(random_, numbers.size() + 2));
    if (which < numbers.size()) return std::bit_cast<std::uint64_t>(numbers[which]);
    return which == numbers.size() ? ~std::uint64_t{0} : value + 1;
  }
  std::uint64_t wrong_count(std::uint64_t value) {
    const std::array<std::uint64_t, 7> counts{4'000'000'000, 0xffffffff, 0x7fc00000, value + 1,
                                              value - 1,     0,          value ^ 64};
    return counts[below(random_, counts.size())] & 0xffffffff;
  }
  std::uint64_t wrong_byte(std::uint64_t value) {
    const std::array<std::uint64_t, 6> bytes{255, 0, value ^ 1, value + 1, value ^ 16, value ^ 64};
    return bytes[below(random_, bytes.size())] & 255;
  }

  std::uint64_t which_, count_ = 0;
  Random& random_;
};

/// Face-offs are between goals, of which these scenes have none.
enum Kind : std::size_t {
  loss,
  entry,
  verdict,
  claims,
  handover,
  face_off,
  record,
  piece,
  kind_count
};

template <class Message>
bool spoil(std::vector<std::uint8_t>& bytes, Message message, Random& random) {
  if (!read(bytes, message)) return false;
  Message copy = message;
  Spoiler counter(~std::uint64_t{0}, random);
  exchange(counter, copy);
  Spoiler spoiler(random() % std::max<std::uint64_t>(1, counter.count()), random);
  exchange(spoiler, message);
  bytes = written(std::move(message));
  return true;
}

/// Which kind of message it was.
Kind spoil(std::vector<std::uint8_t>& bytes, const physics::Field& field, Random& random) {
  if (spoil(bytes, Loss{}, random)) return loss;
  if (spoil(bytes, Entry{.state = {.cuts = Cuts::whole(field)}}, random)) return entry;
  if (spoil(bytes, Verdict{}, random)) return verdict;
  if (spoil(bytes, Claims{}, random)) return claims;
  if (spoil(bytes, Handover{}, random)) return handover;
  if (spoil(bytes, FaceOffWord{}, random)) return face_off;
  if (spoil(bytes, PartRecord{}, random)) return record;
  return spoil(bytes, SnapshotPiece{}, random) ? piece : kind_count;
}

bool is_entry(std::span<const std::uint8_t> bytes) {
  Entry message{.state = {.cuts = Cuts::whole(field)}};
  return read(bytes, message);
}

/// Random peers, one of whom is a liar, in one message or in all that follow; in some plays another
/// one is killed before, or somebody joins.
void expect_no_harm(std::uint64_t first, std::uint64_t last) {
  std::array<std::atomic<std::uint64_t>, kind_count + 1> spoilt{};
  std::uint64_t named = 0;
  for (std::uint64_t seed = first; seed < last && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 2 + below(random, 3);
    const End liar = below(random, peer_count), victim = (liar + 1) % peer_count;
    Play play(below(random, 10) + 10 * seed, peer_count, 12);
    play.is_live = true;
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.office().patience = std::chrono::milliseconds(500);
    const bool is_about_entries = seed % 6 == 0;
    const std::uint64_t last_word = below(random, 3) == 0 && !is_about_entries
                                        ? 1 + below(random, 12 * 6 * (peer_count - 1))
                                        : 0;
    const std::uint64_t message =
                            is_about_entries ? 1 : 1 + below(random, 12 * 3 * (peer_count - 1)),
                        further = below(random, 2) == 0 ? 0 : 1'000'000;
    std::uint64_t said = 0;
    std::atomic<bool> has_lost = false;
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      has_lost = true;
      throw Killed();
    };
    play.before_window = [&](Session& session, End peer) {
      if (peer == victim && session.window() == 3 && last_word == 0 && seed % 2 == 0)
        play.invite(victim);
    };
    // If somebody is killed, one of the words that follow.
    play.on_the_way = [&](End peer, std::vector<std::uint8_t>& bytes) {
      if (peer != liar || (last_word != 0 && !has_lost)) return;
      if (is_about_entries && !is_entry(bytes)) return;
      if (++said < (last_word != 0 ? 1 + message % 8 : message) || said > message + further) return;
      ++spoilt[spoil(bytes, field, random)];
      if (further == 0) said = 1'000'000'000;
    };
    play.run();
    for (End peer = 0; peer < peer_count; ++peer) {
      EXPECT_NE(play.fates[peer], Fate::playing) << "peer " << peer;
      named += play.messages[peer].find("peer " + std::to_string(liar)) != std::string::npos;
    }
  }
  std::cout << named << " peers named a liar; spoilt:";
  for (const auto& count : spoilt) std::cout << ' ' << count;
  std::cout << '\n';
  for (const Kind kind : {loss, entry, verdict, claims, handover, record})
    EXPECT_GT(spoilt[kind], 0u) << "messages of kind " << kind << " were spoilt";
  EXPECT_GT(named, 0u);
}

TEST(Liar, HarmsNobodyByAnyFieldOfAnyMessage) { expect_no_harm(0, 60); }

class LiarLong : public testing::TestWithParam<std::uint64_t> {};
TEST_P(LiarLong, HarmsNobodyByAnyFieldOfAnyMessage) {
  expect_no_harm(200 + 400 * GetParam(), 600 + 400 * GetParam());
}
INSTANTIATE_TEST_SUITE_P(Part, LiarLong, testing::Range<std::uint64_t>(0, 10));

/// Its digests are of another story than anybody else's, who would repeat the window for ever to
/// have the same.
TEST(Liar, WhoseClaimsNobodyCanAgreeWithIsNamedAndTheOthersGoOn) {
  Play play(0, 3, 30);
  play.is_live = true;
  play.on_the_way = [](End peer, std::vector<std::uint8_t>& bytes) {
    Claims claims;
    if (peer != 1 || !read(bytes, claims) || claims.window < 5) return;
    for (ClaimedFlight& flight : claims.flights) flight.state ^= 1;
    bytes = written(claims);
  };
  std::array<std::string, 3> losses;
  play.before_window = [&](Session& session, End peer) { losses[peer] = session.last_loss(); };
  play.run();
  for (const End honest : {0, 2}) {
    EXPECT_EQ(play.fates[honest], Fate::done);
    EXPECT_NE(losses[honest].find("peer 1 "), std::string::npos) << losses[honest];
  }
  EXPECT_NE((losses[0] + losses[2]).find("peer 1 claims what cannot be agreed with of body "),
            std::string::npos)
      << losses[0] << losses[2];
}

/// Its own engine is honest, and so takes part in each recovery that it begins: the window would be
/// undone for ever. Where it asks one peer alone, this one passes the question on, and must not be
/// taken for the liar.
TEST(Liar, WhoAsksInEachWindowForAPeerThatAnswersIsNamedAndTheOthersGoOn) {
  constexpr std::uint64_t lies_max = 600;
  for (const bool asks_all : {true, false}) {
    Play play(0, 4, 30);
    play.is_live = true;
    play.office().patience = std::chrono::seconds(20);
    std::uint64_t lies = 0, last = 0;
    play.on_the_way = [&](End peer, std::vector<std::uint8_t>& bytes) {
      Claims claims;
      if (peer != 1 || !read(bytes, claims) || claims.window < 5 || lies == lies_max) return;
      if (!asks_all && std::exchange(last, claims.window) == claims.window) return;
      bytes = written(Loss{.step = claims.window, .questions = {{3, Answer::open}}});
      ++lies;
    };
    std::array<std::string, 4> losses;
    std::array<std::vector<PeerNumber>, 4> gone;
    play.before_window = [&](Session& session, End peer) {
      losses[peer] = session.last_loss(), gone[peer] = session.lost();
    };
    play.run();
    EXPECT_GT(lies, 0u);
    EXPECT_LT(lies, lies_max);
    for (const End honest : {0, 2, 3}) {
      EXPECT_EQ(play.fates[honest], Fate::done) << play.messages[honest];
      EXPECT_EQ(gone[honest], (std::vector<PeerNumber>{1}));
    }
    EXPECT_NE((losses[0] + losses[2] + losses[3])
                  .find("peer 1 asks again and again for peers that answer"),
              std::string::npos)
        << losses[0] << losses[2] << losses[3];
    EXPECT_TRUE(play.expect_truth_of_logs());
  }
}

/// Who believed it would keep a number that nobody has, which the next newcomer gets.
TEST(Liar, WhoTellsTheLossOfAPeerThatNeverWasIsNamedAndTheOthersGoOn) {
  Play play(0, 3, 30);
  play.is_live = true;
  play.on_the_way = [](End peer, std::vector<std::uint8_t>& bytes) {
    Claims claims;
    if (peer == 1 && read(bytes, claims) && claims.window >= 5)
      bytes = written(Loss{.step = claims.window, .gone = {3}});
  };
  std::array<std::string, 3> losses;
  std::array<std::vector<PeerNumber>, 3> gone;
  play.before_window = [&](Session& session, End peer) {
    losses[peer] = session.last_loss();
    gone[peer] = session.lost();
  };
  play.run();
  for (const End honest : {0, 2}) {
    EXPECT_EQ(play.fates[honest], Fate::done);
    EXPECT_EQ(gone[honest], (std::vector<PeerNumber>{1}));
  }
  EXPECT_NE((losses[0] + losses[2]).find("peer 1 sends the loss of peer 3, which never was"),
            std::string::npos)
      << losses[0] << losses[2];
}

}  // namespace
}  // namespace rink::peer::test
