// Several federation executions in one host: who may make and remove them, and that they know
// nothing of each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/federation_directory.h"
#include "rti/refusal_words.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

/// A host without a fixed federation, in process.
class FreePort {
 public:
  FreePort() : host_(directory), server_(network_), clients_(network_) {
    directory.offer(harbour());
    server_.listen("rti");
    host_.add(server_);
  }
  Station& connect(const Fom& fom = harbour()) {
    Station& station = stations_.emplace_back(fom);
    station.link =
        std::make_unique<FederateLink>(station.ambassador, clients_, clients_.connect("rti"));
    links_.add(*station.link);
    return station;
  }
  Station& join(const std::string& federation, const std::string& name) {
    Station& station = connect();
    station.ambassador.join(federation, name, "tester");
    settle();
    return station;
  }
  void settle() {
    for (int round = 0; round < 6; ++round) {
      links_.flush(now);
      clients_.poll({}, links_);
      host_.poll({});
      host_.advance_clock(now);
      host_.match();
      host_.flush();
    }
    clients_.poll({}, links_);
  }
  FederationDirectory directory;
  double now = 0.0;

 private:
  FederationHost host_;
  InProcessNetwork network_;
  InProcessEndpoint server_, clients_;
  FederateLinks links_;
  std::deque<Station> stations_;
};

TEST(FederationDirectory, ExecutionsAreMadeListedJoinedAndRemovedByName) {
  FreePort port;
  Station& asker = port.connect();
  asker.ambassador.create_federation_execution("north");
  asker.ambassador.create_federation_execution("south");
  asker.ambassador.join("south", "asker", "tester");
  port.settle();
  port.join("north", "one");
  port.join("north", "two");
  Station& lister = port.connect();
  lister.ambassador.list_federation_executions();
  lister.ambassador.destroy_federation_execution("north");
  port.settle();
  EXPECT_THAT(asker.heard.log, ElementsAre("created north", "created south", "joined"));
  EXPECT_THAT(lister.heard.log,
              ElementsAre("listed north:2 south:1", "destroyed northFederatesCurrentlyJoined"));
  asker.ambassador.resign();
  port.settle();
  lister.ambassador.destroy_federation_execution("south");
  lister.ambassador.list_federation_executions();
  port.settle();
  EXPECT_THAT(lister.heard.log, Contains("destroyed south"));
  EXPECT_EQ(lister.heard.log.back(), "listed north:2");
  EXPECT_EQ(port.join("south", "late").heard.refusal, Refusal::wrong_federation);
}

TEST(FederationDirectory, FederatesOfOneNameInTwoExecutionsHearNothingOfEachOther) {
  FreePort port;
  port.directory.create("north", harbour().hash());
  port.directory.create("south", harbour().hash());
  Station &north = port.join("north", "ship"), &south = port.join("south", "ship"),
          &watcher = port.join("south", "watcher");
  for (Station* each : {&north, &south}) {
    each->ambassador.publish_object_class_attributes(vessel, AttributeSet{position});
    each->ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position});
  }
  watcher.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position});
  north.ambassador.register_object_instance(vessel, "Aurora");
  port.settle();
  EXPECT_TRUE(south.heard.objects.empty() && watcher.heard.objects.empty());
  const ObjectHandle object = south.ambassador.register_object_instance(vessel, "Borealis");
  port.settle();
  EXPECT_TRUE(north.heard.objects.empty());
  EXPECT_EQ(watcher.heard.objects.at(object.value).name, "Borealis");
}

TEST(FederationDirectory, NamesInUseForeignModelsAndTooManyAreRefusedByTheirErrors) {
  FreePort port;
  EXPECT_EQ(port.directory.create("north", harbour().hash()), HlaError::none);
  EXPECT_EQ(port.directory.create("north", harbour().hash()),
            HlaError::federation_execution_already_exists);
  EXPECT_EQ(port.directory.create("south", harbour().hash() + 1), HlaError::could_not_open_fdd);
  EXPECT_EQ(port.directory.create("", harbour().hash()), HlaError::illegal_name);
  EXPECT_EQ(port.directory.destroy("south"), HlaError::federation_execution_does_not_exist);
  FederationDirectory small(
      DirectorySettings{.federation = {}, .services = {}, .execution_max = 1});
  small.offer(harbour());
  EXPECT_EQ(small.create("one", harbour().hash()), HlaError::none);
  EXPECT_EQ(small.create("two", harbour().hash()), HlaError::rti_internal_error);
}

TEST(FederationDirectory, AHostOfOneFederationListsItAndKeepsIt) {
  Rig rig(Carrier::in_process);
  Station& asker = rig.connect();
  asker.ambassador.create_federation_execution("rink");
  asker.ambassador.create_federation_execution("other");
  asker.ambassador.destroy_federation_execution("rink");
  asker.ambassador.list_federation_executions();
  asker.ambassador.join("rink", "asker", "tester");
  rig.settle();
  EXPECT_THAT(
      asker.heard.log,
      ElementsAre("created rinkFederationExecutionAlreadyExists", "created otherUnauthorized",
                  "destroyed rinkUnauthorized", "listed rink:0", "joined"));
}

/// Keeps what goes out, by connection.
struct Drain final : Outlet {
  std::map<ConnectionId, std::vector<std::byte>> sent;
  std::set<ConnectionId> dropped;
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts)
      sent[connection].insert(sent[connection].end(), part.begin(), part.end());
  }
  void drop(ConnectionId connection, std::string_view) override { dropped.insert(connection); }
};

TEST(FederationDirectory, AConversationMeansTheSameHoweverItIsCut) {
  Recorder heard;
  Ambassador ambassador(harbour(), heard);
  ambassador.create_federation_execution("north");
  ambassador.join("north", "cut", "tester");
  ambassador.publish_object_class_attributes(vessel, AttributeSet{position});
  const std::vector<std::byte> said(ambassador.outgoing().begin(), ambassador.outgoing().end());
  for (std::size_t step = 1; step <= said.size(); ++step) {
    FederationDirectory directory;
    directory.offer(harbour());
    directory.connect(7);
    for (std::size_t at = 0; at < said.size(); at += step)
      directory.receive(7, Bytes(said).subspan(at, std::min(step, said.size() - at)));
    ASSERT_EQ(directory.list(),
              (std::vector<FederationExecutionInformation>{{"north", "Harbour", 1}}))
        << "cut every " << step << " bytes";
  }
}

TEST(FederationDirectory, WhoBreaksARuleOrIsSilentIsDroppedAndNobodyElse) {
  const auto bytes = [](std::initializer_list<unsigned> values) {
    std::vector<std::byte> all;
    for (const unsigned value : values) all.push_back(static_cast<std::byte>(value));
    return all;
  };
  FederationDirectory directory;
  directory.offer(harbour());
  Drain drain;
  const std::vector<std::vector<std::byte>> crimes{
      bytes({0, 0, 0, 0}),    bytes({255, 255, 0, 0}),    bytes({1, 0, 0, 0, 99}),
      bytes({1, 0, 0, 0, 1}), bytes({2, 0, 0, 0, 20, 9}), framed(UpdatesMessage{1, 1}),
      bytes({0, 0}),          bytes({255, 127, 1}),       bytes({0, 128, 1, 0}),
      bytes({1, 0, 99}),      bytes({2, 0, 20, 9}),       bytes({1, 0, 0, 1})};
  directory.connect(0);
  for (ConnectionId id = 1; id <= crimes.size(); ++id) {
    directory.connect(id);
    directory.receive(id, crimes[id - 1]);
  }
  directory.flush(drain);
  EXPECT_EQ(drain.dropped.size(), crimes.size());
  EXPECT_THAT(drain.dropped, Not(Contains(0u)));
  directory.advance_clock(0.0);
  directory.advance_clock(3.0);
  directory.advance_clock(5.1);
  directory.flush(drain);
  EXPECT_THAT(drain.dropped, Contains(0u));
  EXPECT_EQ(directory.drops(), crimes.size() + 1);
}

TEST(FederationDirectory, BlamesNobodyForATimeInWhichItDidNotListen) {
  FederationDirectory directory;
  directory.offer(harbour());
  Drain drain;
  directory.connect(0);
  directory.advance_clock(0.0);
  directory.advance_clock(60.0);
  directory.flush(drain);
  EXPECT_THAT(drain.dropped, Not(Contains(0u)));
  directory.advance_clock(60.5);
  directory.flush(drain);
  EXPECT_THAT(drain.dropped, Contains(0u));
}

TEST(FederationDirectory, AnswersEarlierVersionsInTheFormThatTheyRead) {
  FederationDirectory directory;
  directory.offer(harbour());
  Drain drain;
  const auto ask = [&](ConnectionId id, const std::vector<std::byte>& frame) {
    directory.connect(id);
    directory.receive(id, frame);
    directory.flush(drain);
    return drain.sent[id];
  };
  const std::vector<std::byte> list = values_of(std::uint32_t{1}, std::uint8_t{22}),
                               end = values_of(std::uint32_t{2}, std::uint8_t{77}, std::uint8_t{1});
  EXPECT_EQ(ask(0, list), end) << "which is the list of none, in every version";
  const std::vector<std::byte> join =
      values_of(std::uint32_t{7}, std::uint8_t{1}, protocol_magic, std::uint16_t{11});
  const std::vector<std::byte> refused = ask(1, join);
  const std::string why = refused_version(11, protocol_version);
  ASSERT_EQ(refused.size(), 4 + 3 + why.size());
  EXPECT_TRUE(std::ranges::equal(
      Bytes(refused).first(6),
      values_of(static_cast<std::uint32_t>(3 + why.size()), std::uint8_t{65}, std::uint8_t{1})));
  EXPECT_EQ(text_of(Bytes(refused).subspan(7)), why);
}

TEST(FederationDirectory, AStrangersQuestionsAreAnsweredOnceAFlushAndItGoesIfItAsksTooMuch) {
  FederationDirectory directory;
  Drain drain;
  const auto list = framed(ListFederationExecutionsMessage{}),
             query = framed(QueryManagementMessage{});
  directory.connect(0);
  for (int i = 0; i < 20; ++i) directory.receive(0, list), directory.receive(0, query);
  directory.flush(drain);
  EXPECT_EQ(drain.sent[0].size(), framed(FederationExecutionMessage{1, {}, {}, 0}).size() +
                                      framed(ReportEndMessage{}).size());
  EXPECT_TRUE(drain.dropped.empty());
  for (int i = 0; i < 1000; ++i) directory.receive(0, list);
  directory.flush(drain);
  EXPECT_THAT(drain.dropped, ElementsAre(0u));
}

}  // namespace
}  // namespace rink::rti::testing
