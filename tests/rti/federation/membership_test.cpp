// Who may join and why not, and who is told of those who come and go: from a table of federates
// and settings alone.
#include "rti/federation/membership.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "tests/rti/federation/service_ground.h"

namespace rink::rti {
namespace {

struct Club : ::testing::Test {
  JoinMessage wish(std::string_view name) const {
    JoinMessage message;
    message.fom_hash = plain_fom().hash();
    message.federation = settings.federation;
    message.name = name;
    message.type = "tester";
    return message;
  }
  std::optional<Refusal> refusal_of(const JoinMessage& message) const {
    const auto objection = membership.objection(message);
    return objection ? std::optional(objection->refusal) : std::nullopt;
  }
  std::uint32_t admit(std::string_view name) {
    const std::uint32_t slot = federates.admit(++connection_count, name, "tester");
    membership.joined(slot);
    return slot;
  }
  using Heard = std::vector<std::pair<std::uint32_t, std::string>>;
  /// Handles and names of those of whom it was told that they came.
  Heard arrivals_told(std::uint32_t slot) {
    Heard heard;
    for_each_said_to<FederateJoinedMessage>(federates[slot], [&](const auto& message) {
      heard.emplace_back(message.federate, std::string(message.name));
    });
    return heard;
  }

  FederationSettings settings;
  FederateTable federates;
  ObjectTable objects{plain_fom()};
  FederationCounters counters;
  double now = 0.0;
  SavePhase save_phase = SavePhase::idle;
  Membership membership{{plain_fom(), settings, federates, objects, counters, now, save_phase}};
  ConnectionId connection_count = 0;
};

TEST_F(Club, AdmitsWhoSpeaksItsLanguageAndHasANameOfHisOwn) {
  EXPECT_EQ(refusal_of(wish("ann")), std::nullopt);
  EXPECT_EQ(refusal_of(wish("")), Refusal::bad_name);
  JoinMessage elsewhere = wish("ann");
  elsewhere.federation = "another";
  EXPECT_EQ(refusal_of(elsewhere), Refusal::wrong_federation);
  const std::uint32_t ann = admit("ann");
  EXPECT_EQ(refusal_of(wish("ann")), Refusal::name_taken);
  federates.retire(ann), federates.release(ann);
  EXPECT_EQ(refusal_of(wish("ann")), std::nullopt);
}

/// Of two things that are wrong, the one is named without which the other means nothing; and both
/// sides' versions and models are told.
TEST_F(Club, SaysWhichVersionOrModelItExpects) {
  JoinMessage message = wish("");
  message.fom_hash += 1;
  EXPECT_EQ(refusal_of(message), Refusal::wrong_fom);
  message.version = protocol_version + 1;
  EXPECT_EQ(refusal_of(message), Refusal::wrong_version);
  const std::string why = membership.objection(message)->why;
  EXPECT_NE(why.find(std::to_string(protocol_version)), std::string::npos) << why;
  EXPECT_NE(why.find(std::to_string(protocol_version + 1)), std::string::npos) << why;
  message.version = protocol_version - 1;
  EXPECT_EQ(refusal_of(message), Refusal::wrong_version) << "the one before residuals";
}

TEST_F(Club, AdmitsNobodyBeyondItsListAndItsLimit) {
  settings.members = {"ann", "bob"};
  settings.federate_max = 1;
  EXPECT_EQ(refusal_of(wish("eve")), Refusal::not_listed);
  EXPECT_EQ(refusal_of(wish("bob")), std::nullopt);
  admit("ann");
  EXPECT_EQ(refusal_of(wish("bob")), Refusal::federation_full);
}

TEST_F(Club, AdmitsNobodyWhileItIsSavedOrRestored) {
  save_phase = SavePhase::saving;
  EXPECT_EQ(refusal_of(wish("ann")), Refusal::save_in_progress);
  save_phase = SavePhase::restoring;
  EXPECT_EQ(refusal_of(wish("ann")), Refusal::restore_in_progress);
  save_phase = SavePhase::idle;
  EXPECT_EQ(refusal_of(wish("ann")), std::nullopt);
}

TEST_F(Club, TellsWhoJoinedHisHandleAndHisBlock) {
  admit("ann");
  now = 7.0;
  const std::uint32_t bob = admit("bob");
  for_each_said_to<JoinedMessage>(federates[bob], [&](const JoinedMessage& message) {
    EXPECT_EQ(message.federate, federates[bob].handle.value);
    EXPECT_EQ(message.object_block, federates[bob].block);
  });
  EXPECT_EQ(federates[bob].last_sent, 7.0) << "else he would soon be silent for too long";
  EXPECT_EQ(counters.joins, 2u);
}

TEST_F(Club, TellsWatchersOfAllWhoAreThereAndOfWhoComes) {
  const std::uint32_t ann = admit("ann"), bob = admit("bob");
  federates[ann].outbox.clear(), federates[bob].outbox.clear();
  membership.handle_watch(bob);
  EXPECT_EQ(arrivals_told(bob), (Heard{{0, "ann"}, {1, "bob"}}));
  membership.handle_watch(bob);
  EXPECT_EQ(arrivals_told(bob), Heard{}) << "he was told already";
  const std::uint32_t eve = admit("eve");
  EXPECT_EQ(arrivals_told(bob), (Heard{{federates[eve].handle.value, "eve"}}));
  EXPECT_EQ(arrivals_told(ann), Heard{}) << "she does not watch";
}

TEST_F(Club, TellsWatchersWhoWentAndWhyAfterWhatHeSaidLast) {
  const std::uint32_t ann = admit("ann"), bob = admit("bob"), eve = admit("eve");
  membership.handle_watch(bob);
  for (const std::uint32_t slot : {ann, bob, eve}) federates[slot].outbox.clear();
  federates.retire(ann);
  membership.left(ann, ResignReason::lost);
  EXPECT_TRUE(federates[bob].outbox.head().empty());
  int told = 0;
  for_each_said_to<FederateResignedMessage>(federates[bob], [&](const auto& message) {
    ++told;
    EXPECT_EQ(message.federate, federates[ann].handle.value);
    EXPECT_EQ(message.name, "ann");
    EXPECT_EQ(message.reason, static_cast<std::uint8_t>(ResignReason::lost));
  });
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(federates[eve].outbox.tail().empty());
  EXPECT_EQ(counters.resigns, 1u);
}

}  // namespace
}  // namespace rink::rti
