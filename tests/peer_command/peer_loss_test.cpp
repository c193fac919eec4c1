// Processes of rink-peer that are killed, stopped and interrupted: the others end in the hash of
// one engine.
#include "tests/peer_command/peer_processes.h"

namespace rink::game {
namespace {

class PeerLoss : public PeerCommand {
 protected:
  bool says(const Process& peer, const std::string& words, std::chrono::seconds limit) {
    return until([&] { return peer.stderr_tail().find(words) != std::string::npos; }, limit);
  }
};

TEST_F(PeerLoss, OfOneThatIsKilledIsMadeGoodWithinASecondAndTheHashIsThatOfOneEngine) {
  for (const char* transport : {"tcp", "shm"}) {
    Process& first = found(3, "2", {"--transport", transport, "--pace", "realtime"});
    Process& second = join(first, {"--transport", transport});
    Process& third = join(second, {"--transport", transport});
    ASSERT_TRUE(are_playing({&first, &second, &third}));
    until([] { return false; }, 1s);
    ASSERT_EQ(kill(second.id(), SIGKILL), 0);
    for (const Process* peer : {&first, &third})
      EXPECT_TRUE(says(*peer, "2 peers go on from", 1s)) << peer->stderr_tail();
    // Whoever hears of it from another one does not say where it was.
    EXPECT_THAT(first.stderr_tail() + third.stderr_tail(),
                HasSubstr("peer 1 (" + place_of(second) + ") is gone"));
    for (const Process* peer : {&first, &third}) {
      ASSERT_TRUE(ends(*peer));
      EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
      EXPECT_EQ(hash_of(*peer), truth(2.0)) << transport;
    }
  }
}

TEST_F(PeerLoss, OfOneOfTwoLeavesTheOtherAlone) {
  Process& first = found(2, "2", {"--pace", "realtime"});
  Process& second = join(first);
  ASSERT_TRUE(are_playing({&first, &second}));
  until([] { return false; }, 1s);
  ASSERT_EQ(kill(first.id(), SIGKILL), 0);
  EXPECT_TRUE(says(second, "this peer continues alone", 1s)) << second.stderr_tail();
  ASSERT_TRUE(ends(second));
  EXPECT_EQ(hash_of(second), truth(2.0));
  EXPECT_EQ(second.ending()->exit_status, static_cast<int>(ExitStatus::may_have_split))
      << "it cannot know that the first one is dead";
  EXPECT_THAT(second.stderr_tail(), HasSubstr("the other may have done so too"));
}

TEST_F(PeerLoss, OfOneThatFallsSilentBeforeAllAreThereKeepsNobodyWaiting) {
  const Words patience{"--patience", "0.5"};
  Process& first = found(3, "2", patience);
  Process& second = join(first, patience);
  ASSERT_TRUE(until([&] { return second.line_after("peer ").has_value(); }));
  ASSERT_EQ(kill(second.id(), SIGSTOP), 0);
  ASSERT_TRUE(ends(first, 5s));
  EXPECT_EQ(first.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(first.stderr_tail(), HasSubstr("peer 1 (" + place_of(second) + ") was silent"));
  ASSERT_EQ(kill(second.id(), SIGCONT), 0);
  ASSERT_TRUE(ends(second, 5s));
  EXPECT_NE(second.ending()->exit_status, 0);
}

TEST_F(PeerLoss, OfOneThatIsKilledBeforeAllAreThereKeepsNobodyWaiting) {
  Process& first = found(3, "2");
  Process& second = join(first);
  ASSERT_TRUE(until([&] { return second.line_after("peer ").has_value(); }));
  ASSERT_EQ(kill(second.id(), SIGKILL), 0);
  ASSERT_TRUE(ends(first, 5s));
  EXPECT_EQ(first.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(first.stderr_tail(), HasSubstr("is gone"));
}

TEST_F(PeerLoss, ThatIsNoneWhileTwoWaitLongerThanTheirPatienceForAThird) {
  const Words patience{"--patience", "0.5"};
  Process& first = found(3, "0.2", patience);
  Process& second = join(first, patience);
  until([] { return false; }, 2s);
  Process& third = join(first, patience);
  for (const Process* peer : {&first, &second, &third}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
    EXPECT_EQ(hash_of(*peer), truth(0.2));
  }
}

TEST_F(PeerLoss, OfTheSecondOfTwoLeavesTheFirstWithTheSession) {
  Process& first = found(2, "2", {"--pace", "realtime"});
  Process& second = join(first);
  ASSERT_TRUE(are_playing({&first, &second}));
  ASSERT_EQ(kill(second.id(), SIGKILL), 0);
  ASSERT_TRUE(ends(first));
  EXPECT_EQ(hash_of(first), truth(2.0));
  EXPECT_EQ(first.ending()->exit_status, 0) << first.stderr_tail();
}

TEST_F(PeerLoss, OfEachOtherLetsAtMostOneOfTwoEndWithStatusZero) {
  Process& first = found(2, "3", {"--pace", "realtime", "--patience", "0.5"});
  Process& second = join(first, {"--patience", "0.5"});
  ASSERT_TRUE(are_playing({&first, &second}));
  ASSERT_EQ(kill(second.id(), SIGSTOP), 0);
  EXPECT_TRUE(says(first, "this peer continues alone", 3s)) << first.stderr_tail();
  ASSERT_EQ(kill(second.id(), SIGCONT), 0);
  for (const Process* peer : {&first, &second}) ASSERT_TRUE(ends(*peer));
  EXPECT_EQ(first.ending()->exit_status, 0) << first.stderr_tail();
  EXPECT_NE(second.ending()->exit_status, 0) << second.stderr_tail();
}

TEST_F(PeerLoss, IsNotWhatTwoSecondsOfSilenceAre) {
  Process& slow = found(3, "3", {"--pace", "realtime"});
  Process& stopped = join(slow);
  Process& other = join(stopped);
  ASSERT_TRUE(are_playing({&slow, &stopped, &other}));
  ASSERT_EQ(kill(stopped.id(), SIGSTOP), 0);
  until([] { return false; }, 2s);
  ASSERT_EQ(kill(stopped.id(), SIGCONT), 0);
  for (const Process* peer : {&slow, &stopped, &other}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), truth(3.0));
    EXPECT_EQ(peer->stderr_tail(), "");
  }
}

TEST_F(PeerLoss, OfOneThatIsSilentForTooLongIsFinalAndItHaltsWhenItComesBack) {
  const Words patience{"--patience", "0.5"};
  Process& first = found(3, "4", {"--pace", "realtime", "--patience", "0.5"});
  Process& second = join(first, patience);
  Process& third = join(first, patience);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  ASSERT_EQ(kill(second.id(), SIGSTOP), 0);
  for (const Process* peer : {&first, &third})
    EXPECT_TRUE(says(*peer, "2 peers go on from", 3s)) << peer->stderr_tail();
  ASSERT_EQ(kill(second.id(), SIGCONT), 0);
  ASSERT_TRUE(ends(second, 3s));
  EXPECT_EQ(second.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(second.stderr_tail(), testing::AnyOf(HasSubstr("1 of 3 peers are left: it halts"),
                                                   HasSubstr("has given this one up: it halts")));
  for (const Process* peer : {&first, &third}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), truth(4.0));
  }
}

TEST_F(PeerLoss, IsNotWhenOneIsInterruptedForItHandsOverWhatItOwns) {
  Process& first = found(3, "2", {"--pace", "realtime"});
  Process& second = join(first);
  Process& third = join(first);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  until([] { return false; }, 1s);
  ASSERT_EQ(kill(first.id(), SIGINT), 0);
  ASSERT_TRUE(ends(first, 2s));
  EXPECT_EQ(first.ending()->exit_status, 130);
  EXPECT_THAT(first.stderr_tail(), HasSubstr("all that this peer had is with others"));
  for (const Process* peer : {&second, &third}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), truth(2.0));
    EXPECT_EQ(peer->line_after("  \"recoveries\": "), "0,");
    EXPECT_EQ(peer->stderr_tail(), "rink-peer: peer 0 has left in good order");
  }
}

TEST_F(PeerLoss, IsNotWhenOneOfTwoIsInterruptedForTheOtherGoesOn) {
  Process& first = found(2, "2", {"--pace", "realtime"});
  Process& second = join(first);
  ASSERT_TRUE(are_playing({&first, &second}));
  ASSERT_EQ(kill(second.id(), SIGINT), 0);
  ASSERT_TRUE(ends(second));
  EXPECT_EQ(second.ending()->exit_status, 130);
  EXPECT_THAT(second.stderr_tail(), HasSubstr("all that this peer had is with others"));
  ASSERT_TRUE(ends(first));
  EXPECT_EQ(hash_of(first), truth(2.0));
}

TEST_F(PeerLoss, IsNotWhenOneIsInterruptedInWindowsOfMoreThanASecond) {
  Process& first = found(3, "9", {"--pace", "realtime", "--window", "1.5"});
  Process& second = join(first);
  Process& third = join(first);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  until([] { return false; }, 2s);
  ASSERT_EQ(kill(second.id(), SIGINT), 0);
  ASSERT_TRUE(ends(second, 8s));
  EXPECT_THAT(second.stderr_tail(), HasSubstr("all that this peer had is with others"));
  for (const Process* peer : {&first, &third}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), truth(9.0));
    EXPECT_EQ(peer->line_after("  \"recoveries\": "), "0,");
  }
}

TEST_F(PeerLoss, HaltsWithoutLeavingAnEmptyRecord) {
  const std::string file = (folder_ / "halted.keys").string();
  Process& first = found(3, "1000", {"--pace", "realtime", "--record", file});
  Process& second = join(first);
  Process& third = join(first);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  for (const Process* peer : {&second, &third}) ASSERT_EQ(kill(peer->id(), SIGKILL), 0);
  ASSERT_TRUE(ends(first));
  EXPECT_EQ(first.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(PeerCommand, UnmirroredNoticesWithinTwoSecondsThatAPeerWasKilledAndNamesIt) {
  Process& first = found(3, "10000", {"--unmirrored"});
  Process& second = join(first);
  Process& third = join(second);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  const std::string killed = "peer 1 (" + place_of(second) + ") is gone";
  ASSERT_EQ(kill(second.id(), SIGKILL), 0);
  for (const Process* peer : {&first, &third}) {
    ASSERT_TRUE(ends(*peer, 2s));
    EXPECT_EQ(peer->ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
    EXPECT_THAT(peer->stderr_tail(), HasSubstr(killed));
  }
}

TEST_F(PeerCommand, UnmirroredAndInterruptedEndsAllButOnlyOneSaysThatItWasInterrupted) {
  Process& first = found(2, "10000", {"--unmirrored"});
  Process& second = join(first);
  ASSERT_TRUE(are_playing({&first, &second}));
  second.stop(2000ms);
  ASSERT_TRUE(ends(first, 2s));
  ASSERT_TRUE(second.ending());
  EXPECT_EQ(second.ending()->exit_status, 130);
  EXPECT_EQ(first.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(first.stderr_tail(), HasSubstr("was interrupted, so all end"));
}

}  // namespace
}  // namespace rink::game
