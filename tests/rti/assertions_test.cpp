// What the RTI's parts assert of each other: a wrong argument ends the program, with the condition
// that it broke.
#include <gtest/gtest.h>

#include "rti/admission/token_bucket.h"
#include "rti/buffering/sent_records.h"
#include "rti/buffering/update_runs.h"
#include "rti/ownership/ownership.h"
#include "rti/time/time_queue.h"
#include "rti/transport/modelled/virtual_network.h"
#include "rti/transport/shared_memory/shared_ring.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/frame.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

#ifndef NDEBUG

TEST(RtiDeathTest, NamesWhatIsWrongWithObjectsAndTheirOwners) {
  ObjectTable table(harbour());
  Ownership ownership(harbour(), table);
  const ObjectSlot slot = table.insert(ObjectHandle{7}, 0, 1, "");
  EXPECT_DEATH(table.insert(ObjectHandle{7}, 0, 1, ""), "was_registered");
  EXPECT_DEATH(table.erase(slot + 1), "slot < slot_count");
  EXPECT_DEATH(ownership.divest(1, slot, AttributeSet(1u)), "includes");
  EXPECT_DEATH(harbour().at(ObjectClassHandle{}), "object_classes_.size");
}

TEST(RtiDeathTest, NamesWhatIsWrongWithWhatIsWritten) {
  std::vector<std::byte> bytes;
  EXPECT_DEATH(FrameWriter(100).appended(), "is_open_");
  EXPECT_DEATH(BitReader(bytes, 1), "at <= 8");
  EXPECT_DEATH(Quantisation::of(0.0, 1.0, 0.1)->count(2.0), "contains");
  EXPECT_DEATH(UpdateRun().values(0), "index < records.size");
  EXPECT_DEATH(SentRecord().add(1), "has_group_");
  EXPECT_DEATH(SentRecordPool().release(0), "is_held");
}

TEST(RtiDeathTest, NamesWhatIsWrongWithTimesAndRings) {
  EXPECT_DEATH(TimeQueue().pop(), "is_empty");
  EXPECT_DEATH(TokenBucket(1.0, 5.0).take(1.0, 4.0), "now_s >= filled_s_");
  EXPECT_DEATH(ConstantDelay(-1), "delay_ns >= 0");
  SharedRingState state;
  std::byte byte{};
  EXPECT_DEATH(SharedRing(&state, &byte, 3), "has_single_bit");
}

#endif

}  // namespace
}  // namespace rink::rti::testing
