// How long messages in time-stamp order are kept.
#include <gtest/gtest.h>

#include "rti/federation/time/timed_messages.h"

namespace rink::rti {
namespace {

/// Of sender 0, with a body of `size` bytes.
StampedMessage message_of(std::uint64_t number, double time, std::size_t size = 8) {
  StampedMessage message;
  message.sender = {1};
  message.number = number;
  message.stamp.time = time;
  message.body.resize(size);
  return message;
}

std::uint32_t add(TimedMessages& messages, StampedMessage message) {
  return messages.add(0, message);
}

TEST(TimedMessages, StayWhileTheirSenderCanTakeThemBack) {
  FederationSettings settings;
  settings.timed_max = 1;
  TimedMessages messages(settings);
  messages.joined(0);
  const std::uint32_t index = add(messages, message_of(0, 1.0));
  messages.distributed(index);
  messages.finish(index);
  EXPECT_TRUE(messages.is_full());
  messages.forget_final(0, 1.0);
  EXPECT_TRUE(messages.is_full()) << "a time stamp of 1 s can still be used";
  messages.forget_final(0, 1.5);
  EXPECT_FALSE(messages.is_full());
}

TEST(TimedMessages, StayUntilTheLastReceiverHasThem) {
  FederationSettings settings;
  settings.timed_max = 1;
  TimedMessages messages(settings);
  messages.joined(0);
  const std::uint32_t index = add(messages, message_of(0, 1.0));
  messages.add_receiver(index, {2}, {});
  messages.add_receiver(index, {3}, {});
  messages.distributed(index);
  messages.enqueued(index, 0);
  messages.enqueued(index, 1);
  messages.left(0);
  EXPECT_FALSE(messages.dequeued(index, 1));
  messages.finish(index);
  EXPECT_TRUE(messages.is_full());
  EXPECT_TRUE(messages.dequeued(index, 0));
  messages.finish(index);
  EXPECT_FALSE(messages.is_full());
}

TEST(TimedMessages, AreTakenBackOnceAndNotTooLate) {
  const FederationSettings settings;
  TimedMessages messages(settings);
  messages.joined(0);
  const std::uint32_t early = add(messages, message_of(0, 1.0));
  const std::uint32_t late = add(messages, message_of(1, 3.0));
  EXPECT_EQ(messages.retract(0, 0, 2.0), std::nullopt);
  EXPECT_EQ(messages.retract(0, 1, 2.0), late);
  EXPECT_EQ(messages.retract(0, 1, 2.0), std::nullopt);
  EXPECT_EQ(messages.retract(0, 7, 0.0), std::nullopt);
  EXPECT_TRUE(messages[late].is_retracted);
  EXPECT_FALSE(messages[early].is_retracted);
}

TEST(TimedMessages, AreCountedUpwardsByTheirSender) {
  const FederationSettings settings;
  TimedMessages messages(settings);
  messages.joined(0);
  add(messages, message_of(5, 1.0));
  EXPECT_FALSE(messages.may_be_next(0, 5));
  EXPECT_TRUE(messages.may_be_next(0, 6));
  messages.left(0);
  EXPECT_TRUE(messages.may_be_next(0, 0)) << "whoever has the slot next begins anew";
}

TEST(TimedMessages, AreTooManyOfOneSenderByNumberOrByBytes) {
  FederationSettings settings;
  settings.timed_per_federate_max = 2;
  settings.timed_bytes_per_federate_max = 100;
  TimedMessages messages(settings);
  messages.joined(0);
  add(messages, message_of(0, 1.0, 60));
  EXPECT_FALSE(messages.is_greedy(0));
  add(messages, message_of(1, 2.0, 60));
  EXPECT_TRUE(messages.is_greedy(0)) << "120 bytes";
  messages.forget_final(0, 1.5);
  EXPECT_FALSE(messages.is_greedy(0));
  add(messages, message_of(2, 3.0, 0));
  add(messages, message_of(3, 3.0, 0));
  EXPECT_TRUE(messages.is_greedy(0)) << "three of them";
}

}  // namespace
}  // namespace rink::rti
