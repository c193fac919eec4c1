// Who has the shared key is let in, both ways; nobody else gets a byte more than they sent.
#include <gtest/gtest.h>

#include <random>

#include "rti/admission/handshake.h"
#include "rti/transport/staged/guard.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "tests/rti/rig.h"
#include "tests/rti/seeded.h"

namespace rink::rti::testing {
namespace {

SharedKey key_of(std::string_view secret) { return SharedKey(std::as_bytes(std::span(secret))); }
const SharedKey& ours() {
  static const SharedKey key = key_of("the harbour's own secret");
  return key;
}
const SharedKey& another() {
  static const SharedKey key = key_of("a secret of somebody else");
  return key;
}

/// Two ends and what they have said.
struct Talk {
  Handshake federate, rti;
  std::vector<std::byte> up, down;
  Talk(const SharedKey& federates, const SharedKey& rtis, std::string_view federation = "rink",
       std::string_view served = "rink", unsigned seed = 1)
      : federate(federates, Role::federate, federation, nonce_of(seed)),
        rti(rtis, Role::rti, served, nonce_of(seed + 1000)) {}
  static void carry(Handshake& from, Handshake& to, std::vector<std::byte>& said) {
    const Bytes bytes = from.outgoing();
    said.insert(said.end(), bytes.begin(), bytes.end());
    Bytes left = bytes;
    to.receive(left);
    from.clear_outgoing();
  }
  void talk() {
    for (int i = 0; i < 3; ++i) {
      carry(federate, rti, up);
      EXPECT_LE(down.size() + rti.outgoing().size(), up.size())
          << "the RTI's end may not say more than it heard";
      carry(rti, federate, down);
    }
  }
};

using State = Handshake::State;

TEST(Admission, TwoEndsOfOneKeyProveItToEachOther) {
  Talk scene(ours(), ours());
  scene.talk();
  EXPECT_EQ(scene.federate.state(), State::proven);
  EXPECT_EQ(scene.rti.state(), State::proven);
}

TEST(Admission, AnotherKeyFederationOrVersionIsRefusedWithAWord) {
  Talk wrong_key(ours(), another());
  wrong_key.talk();
  EXPECT_EQ(wrong_key.rti.state(), State::failed);
  EXPECT_EQ(wrong_key.federate.why(), "the RTI refuses us: wrong key");
  Talk elsewhere(ours(), ours(), "rink", "pond");
  elsewhere.talk();
  EXPECT_EQ(elsewhere.federate.why(), "the RTI refuses us: other federation");
  Handshake rti(ours(), Role::rti, "rink", nonce_of(1)),
      federate(ours(), Role::federate, "rink", nonce_of(2));
  std::vector<std::byte> hello(federate.outgoing().begin(), federate.outgoing().end());
  hello[frame_head_max + 1] ^= std::byte{1};
  Bytes bytes = hello;
  EXPECT_EQ(rti.receive(bytes), State::failed);
  const std::string both = "other version: " + std::to_string(protocol_version ^ 1) +
                           ", the RTI speaks " + std::to_string(protocol_version);
  EXPECT_EQ(rti.why(), both);
  Bytes answer = rti.outgoing();
  EXPECT_EQ(federate.receive(answer), State::failed);
  EXPECT_EQ(federate.why(), "the RTI refuses us: " + both);
}

class OlderAdmission : public ::testing::TestWithParam<std::uint16_t> {};
INSTANTIATE_TEST_SUITE_P(OfElevenAndTwelve, OlderAdmission, ::testing::Values(11, 12));

TEST_P(OlderAdmission, IsRefusedInTheFormThatItReadsAndUnderstoodWhenItRefuses) {
  std::vector<std::byte> hello =
      values_of(std::uint32_t{0x28}, std::uint8_t{58}, GetParam(), nonce_of(3), std::uint8_t{4});
  const std::vector<std::byte> rink = bytes_of("rink");
  hello.insert(hello.end(), rink.begin(), rink.end());
  Handshake rti(ours(), Role::rti, "rink", nonce_of(1));
  Bytes bytes = hello;
  EXPECT_EQ(rti.receive(bytes), State::failed);
  const std::string why = "other version: " + std::to_string(GetParam()) + ", the RTI speaks 13";
  std::vector<std::byte> refused =
      values_of(std::uint32_t{0x27}, std::uint8_t{65}, std::uint8_t{7}, std::uint8_t{0x24});
  const std::vector<std::byte> text = bytes_of(why);
  refused.insert(refused.end(), text.begin(), text.end());
  EXPECT_TRUE(std::ranges::equal(rti.outgoing(), refused));

  Handshake federate(ours(), Role::federate, "rink", nonce_of(2));
  const std::vector<std::byte> head =
      values_of(std::uint32_t{0x28}, std::uint8_t{58}, std::uint16_t{13});
  EXPECT_TRUE(std::ranges::equal(federate.outgoing().first(head.size()), head));
  bytes = refused;
  EXPECT_EQ(federate.receive(bytes), State::failed);
  EXPECT_EQ(federate.why(), "the RTI refuses us: " + why);
}

TEST(Admission, TheFederateTurnsAwayFromAnRtiWithoutTheKey) {
  Handshake federate(ours(), Role::federate, "rink", nonce_of(1));
  // Somebody who says yes to everybody: a challenge of any kind, then the federate's own proof
  // back.
  std::vector<std::byte> challenge =
      values_of(std::uint32_t{33}, MessageKind::challenge, nonce_of(2));
  federate.clear_outgoing();
  Bytes bytes = challenge;
  ASSERT_EQ(federate.receive(bytes), State::going_on);
  std::vector<std::byte> echoed(federate.outgoing().begin(), federate.outgoing().end());
  echoed[frame_head_max] = static_cast<std::byte>(MessageKind::admitted);
  bytes = echoed;
  EXPECT_EQ(federate.receive(bytes), State::failed);
  EXPECT_EQ(federate.why(), "the RTI does not have this end's key");
}

TEST(Admission, AReplayedConversationProvesNothing) {
  Talk first(ours(), ours());
  first.talk();
  Handshake rti(ours(), Role::rti, "rink", nonce_of(77));
  Bytes bytes = first.up;
  EXPECT_EQ(rti.receive(bytes), State::failed);
  Handshake federate(ours(), Role::federate, "rink", nonce_of(78));
  bytes = first.down;
  EXPECT_EQ(federate.receive(bytes), State::failed);
}

TEST(Admission, AReflectedProofIsNobodys) {
  // A stranger who opens two conversations with an RTI can't answer one with the other, nor with
  // what the RTI itself says.
  const ProofBasis basis{nonce_of(1), nonce_of(2), "rink"};
  const Proof federates = ours().prove(Role::federate, basis),
              rtis = ours().prove(Role::rti, basis);
  EXPECT_TRUE(ours().is_proven(Role::federate, basis, federates));
  EXPECT_FALSE(ours().is_proven(Role::federate, basis, rtis));
  EXPECT_FALSE(ours().is_proven(Role::rti, basis, federates));
  EXPECT_FALSE(ours().is_proven(Role::federate, {basis.rti, basis.federate, "rink"}, federates));
  EXPECT_FALSE(ours().is_proven(Role::federate, {basis.federate, basis.rti, "pond"}, federates));
  EXPECT_FALSE(another().is_proven(Role::federate, basis, federates));
}

TEST(Admission, EveryTruncatedOrSpoiltConversationStopsShortOfAProof) {
  Talk whole(ours(), ours());
  whole.talk();
  for (std::size_t size = 0; size < whole.up.size(); ++size) {
    Handshake rti(ours(), Role::rti, "rink", nonce_of(1001));
    Bytes bytes = Bytes(whole.up).first(size);
    EXPECT_NE(rti.receive(bytes), State::proven) << size;
    EXPECT_LE(rti.outgoing().size(), size);
  }
  for (std::size_t bit = 0; bit < 8 * whole.up.size(); ++bit) {
    std::vector<std::byte> spoilt = whole.up;
    spoilt[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    Handshake rti(ours(), Role::rti, "rink", nonce_of(1001));
    Bytes bytes = spoilt;
    EXPECT_NE(rti.receive(bytes), State::proven) << bit;
    EXPECT_LE(rti.outgoing().size(), spoilt.size());
  }
}

TEST(Admission, ConversationsMayBeCutAnywhereAndWhatFollowsThemIsLeft) {
  Talk whole(ours(), ours());
  whole.talk();
  std::vector<std::byte> bytes = whole.up;
  const std::vector<std::byte> after = bytes_of("what follows");
  bytes.insert(bytes.end(), after.begin(), after.end());
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    Handshake rti(ours(), Role::rti, "rink", nonce_of(1001));
    Bytes first = Bytes(bytes).first(cut), second = Bytes(bytes).subspan(cut);
    rti.receive(first);
    rti.receive(second);
    EXPECT_EQ(rti.state(), State::proven);
    EXPECT_EQ(first.size() + second.size(), after.size()) << cut;
  }
}

TEST(Admission, AStrangersFrameIsAtMostAKibibyteAndNeverEmpty) {
  for (const std::uint32_t length :
       {0u, static_cast<std::uint32_t>(frame_max_to_join) + 1u, 0xffffffffu}) {
    Handshake rti(ours(), Role::rti, "rink", nonce_of(1));
    const std::vector<std::byte> header = values_of(length);
    Bytes bytes = header;
    EXPECT_EQ(rti.receive(bytes), State::failed) << length << ", before anything of it is gathered";
    EXPECT_EQ(rti.why(), "the other end does not speak this protocol");
  }
  Handshake rti(ours(), Role::rti, "rink", nonce_of(1));
  const std::vector<std::byte> header = values_of(std::uint32_t{frame_max_to_join});
  Bytes bytes = header;
  EXPECT_EQ(rti.receive(bytes), State::going_on);
}

TEST(Admission, RandomBytesGetNoMoreThanTheyAre) {
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::vector<std::byte> bytes = values_of(static_cast<std::uint32_t>(1 + random() % 60));
    const std::size_t size = random() % 80;
    const std::uint8_t kinds[] = {1, 3, 58, 59, 118};
    bytes.push_back(static_cast<std::byte>(kinds[random() % 5]));
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(random()));
    Handshake rti(ours(), Role::rti, "rink", nonce_of(seed));
    Bytes left = bytes;
    EXPECT_NE(rti.receive(left), State::proven);
    EXPECT_LE(rti.outgoing().size(), bytes.size());
  }
}

/// Somebody on the way, who hears all and alters one bit of what comes down.
struct Meddler final : TransportStage {
  std::string heard;
  std::size_t come = 0, alters = ~std::size_t{0};  ///< bytes; the number of the altered one
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts)
      heard.append(reinterpret_cast<const char*>(part.data()), part.size());
    TransportStage::send(connection, parts);
  }

 private:
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    std::vector<std::byte> passed(bytes.begin(), bytes.end());
    if (alters - come < passed.size()) passed[alters - come] ^= std::byte{16};
    come += passed.size();
    TransportStage::on_bytes(connection, passed);
  }
};

/// An RTI and a federate on a carrier, each with a key or none.
class Gate {
 public:
  Gate(Carrier carrier, const SharedKey* rtis, const SharedKey* federates)
      : execution_(harbour(), {}), host_(execution_) {
    Transport& server =
        carrier == Carrier::tcp ? static_cast<Transport&>(server_tcp_) : server_local_;
    Transport& client =
        carrier == Carrier::tcp ? static_cast<Transport&>(client_tcp_) : client_local_;
    server_ = &server;
    host_.add(at_rti_.emplace(server));
    if (rtis != nullptr)
      guard_ = &at_rti_->add<Guard>(*rtis, GuardSettings{}, [this] { return now; });
    client_ = &at_federate_.emplace(client);
    meddler = &at_federate_->add<Meddler>();
    if (federates != nullptr)
      at_federate_->add<Guard>(*federates, GuardSettings{.role = Role::federate},
                               [this] { return now; });
    if (carrier == Carrier::in_process) server_local_.listen("rti");
    const ConnectionId id =
        carrier == Carrier::tcp
            ? client_tcp_.connect("127.0.0.1", server_tcp_.listen("127.0.0.1", 0))
            : client_local_.connect("rti");
    link_.emplace(ambassador, *client_, id);
    links_.add(*link_);
  }
  void run() {
    for (int i = 0; i < 12; ++i) {
      links_.flush(now);
      client_->poll(std::chrono::milliseconds(1), links_);
      host_.poll(std::chrono::milliseconds(1));
      host_.match();
      host_.flush();
    }
  }
  double now = 0.0;
  Meddler* meddler = nullptr;  ///< between the federate and its guard
  Recorder heard;
  Ambassador ambassador{harbour(), heard};
  const FederateLink& link() const { return *link_; }
  const FederationExecution& execution() const { return execution_; }
  /// Of the first connection.
  TransportCounters traffic() const { return server_->counters(0); }
  std::uint64_t refused() const { return guard_->refused(); }

 private:
  FederationExecution execution_;
  FederationHost host_;
  InProcessNetwork network_;
  InProcessEndpoint server_local_{network_}, client_local_{network_};
  TcpTransport server_tcp_, client_tcp_;
  std::optional<StagedTransport> at_rti_, at_federate_;
  Guard* guard_ = nullptr;
  Transport *server_ = nullptr, *client_ = nullptr;
  std::optional<FederateLink> link_;
  FederateLinks links_;
};

class Admissions : public ::testing::TestWithParam<Carrier> {};
INSTANTIATE_TEST_SUITE_P(Carriers, Admissions, ::testing::Values(Carrier::in_process, Carrier::tcp),
                         [](const auto& each) { return name_of(each.param); });

TEST_P(Admissions, WhoHasTheKeyJoinsAsEver) {
  Gate scene(GetParam(), &ours(), &ours());
  scene.ambassador.join("rink", "ferry", "tester");
  scene.run();
  EXPECT_TRUE(scene.ambassador.is_joined());
  EXPECT_EQ(scene.refused(), 0u);
  EXPECT_EQ(scene.meddler->heard.find("ferry"), std::string::npos) << "it is sealed";
}

TEST_P(Admissions, WhoHearsAnAlteredByteAfterwardsLeavesAndSaysWhy) {
  Gate sound(GetParam(), &ours(), &ours());
  sound.ambassador.join("rink", "ferry", "tester");
  sound.run();
  const std::size_t size = sound.meddler->come;
  const std::size_t admission = 2 * (frame_head_max + 33);
  ASSERT_GT(size, admission + frame_head_size(1));
  for (std::size_t at = admission + frame_head_size(1); at < size; at += 7) {
    Gate scene(GetParam(), &ours(), &ours());
    scene.meddler->alters = at;
    scene.ambassador.join("rink", "ferry", "tester");
    scene.run();
    ASSERT_TRUE(scene.link().is_finished()) << at << " of " << size;
    EXPECT_EQ(scene.link().close_reason(), CloseReason::failed);
    EXPECT_EQ(scene.heard.lost, "what came was altered on its way, or not sealed by our key");
    EXPECT_EQ(scene.execution().federate_count(), 0u);
  }
}

TEST_P(Admissions, WhoHasNoneIsToldSoInNoMoreBytesThanTheySent) {
  Gate scene(GetParam(), &ours(), nullptr);
  scene.ambassador.join("rink", "f", "");
  scene.run();
  EXPECT_EQ(scene.heard.refusal, Refusal::not_admitted);
  EXPECT_EQ(scene.execution().counters().bytes_received, 0u) << "the RTI proper never heard of it";
  EXPECT_EQ(scene.refused(), 1u);
  EXPECT_LE(scene.traffic().bytes_sent, scene.traffic().bytes_received);
}

TEST_P(Admissions, WhoHasAnotherIsToldSoInNoMoreBytesThanTheySent) {
  Gate scene(GetParam(), &ours(), &another());
  scene.ambassador.join("rink", "ferry", "tester");
  scene.run();
  EXPECT_TRUE(scene.link().is_finished());
  EXPECT_EQ(scene.link().close_reason(), CloseReason::failed);
  EXPECT_EQ(scene.heard.lost, "the RTI refuses us: wrong key");
  EXPECT_EQ(scene.execution().counters().bytes_received, 0u);
  EXPECT_LE(scene.traffic().bytes_sent, scene.traffic().bytes_received);
}

TEST_P(Admissions, AFederateWithAKeySaysNothingToAnRtiThatAsksForNone) {
  Gate scene(GetParam(), nullptr, &ours());
  scene.ambassador.join("rink", "ferry", "tester");
  scene.run();
  EXPECT_TRUE(scene.link().is_finished());
  EXPECT_FALSE(scene.ambassador.is_joined());
  EXPECT_EQ(scene.execution().federate_count(), 0u);
  EXPECT_EQ(scene.heard.lost, "closed before it proved that it has our key: does it ask for one?");
}

TEST_P(Admissions, ASilentStrangerIsClosedAfterSomePatience) {
  Gate scene(GetParam(), &ours(), nullptr);
  scene.run();
  EXPECT_FALSE(scene.link().is_finished());
  scene.now = 3.1;
  scene.run();
  EXPECT_TRUE(scene.link().is_finished());
  EXPECT_EQ(scene.traffic().bytes_sent, 0u);
  EXPECT_EQ(scene.refused(), 1u);
}

}  // namespace
}  // namespace rink::rti::testing
