// What a federate keeps of its objects, their owners and its declarations, each book by itself.
#include <gtest/gtest.h>

#include <vector>

#include "rti/federate/books/declared_classes.h"
#include "rti/federate/books/object_book.h"
#include "rti/federate/books/ownership_book.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

TEST(ObjectBook, NumbersOwnObjectsWithinTheBlockAndThenWithinTheNext) {
  ObjectBook book;
  book.begin(3);
  EXPECT_FALSE(book.add_block(3)) << "the block at hand";
  EXPECT_TRUE(book.add_block(9));
  EXPECT_FALSE(book.add_block(10)) << "one waits already";
  const ObjectHandle first = book.add(vessel);
  EXPECT_EQ(first.value, 3 * object_block);
  for (std::uint32_t i = 1; i < object_block; ++i) book.add(ferry);
  ASSERT_TRUE(book.has_handle());
  const ObjectHandle further = book.add(ferry);
  EXPECT_EQ(further.value, 9 * object_block);
  EXPECT_TRUE(book.is_ours(further));
  EXPECT_FALSE(book.is_ours(first));
  EXPECT_TRUE(book.was_registered_here(first));
  ASSERT_NE(book.find(first), nullptr);
  EXPECT_EQ(book.find(first)->object_class, vessel.value);
  EXPECT_FALSE(book.discover(first, vessel)) << "nobody else registers by our handles";
}

TEST(ObjectBook, KeepsEntriesInPlaceWhileTheyAreMarkedAndHidden) {
  // The map of others' objects is as full as it may be at each count of these: one more insertion
  // moves all entries.
  for (const std::uint32_t count : {6u, 12u, 24u, 48u}) {
    ObjectBook book;
    book.begin(0);
    for (std::uint32_t i = 0; i < count; ++i)
      ASSERT_TRUE(book.discover({object_block + i}, vessel));
    const ObjectHandle one{object_block + 1}, other{object_block + 2};
    const KnownObject* known = book.find(one);
    book.set_own(one, true);
    EXPECT_EQ(book.find(one), known);
    const KnownObject hidden = book.hide(other);
    EXPECT_EQ(book.find(one), known);
    EXPECT_EQ(book.find(other), nullptr);
    EXPECT_TRUE(book.is_gone(other));
    book.restore(other, hidden);
    EXPECT_NE(book.find(other), nullptr);
  }
}

TEST(ObjectBook, RemembersWhatItLeftUntilTheRtiHasHeardSo) {
  ObjectBook book;
  book.begin(0);
  const ObjectHandle theirs{object_block};
  ASSERT_TRUE(book.discover(theirs, vessel));
  book.leave(theirs);
  EXPECT_EQ(book.find(theirs), nullptr);
  EXPECT_TRUE(book.is_gone(theirs));
  book.sweep();
  EXPECT_TRUE(book.is_gone(theirs)) << "the RTI has not heard so yet";
  book.settle_gone(theirs);
  EXPECT_TRUE(book.is_gone(theirs)) << "until its frame is over";
  book.sweep();
  EXPECT_FALSE(book.is_gone(theirs));
  EXPECT_TRUE(book.discover(theirs, vessel)) << "anew";
}

TEST(DeclaredClasses, TurnOnceForEachChangeOfWhatOthersHear) {
  DeclaredClasses classes(harbour());
  EXPECT_TRUE(classes.subscribed(vessel).includes(motion)) << "all, until the RTI has told";
  classes.publish(vessel, AttributeSet{position});
  EXPECT_FALSE(classes.turn(vessel, true)) << "nobody subscribes actively yet";
  classes.set_others(vessel, {motion, motion});
  EXPECT_EQ(classes.turn(vessel, true), true);
  EXPECT_FALSE(classes.turn(vessel, true)) << "it was told";
  classes.set_others(vessel, {{}, {}});
  EXPECT_FALSE(classes.subscribed(vessel).contains(position));
  EXPECT_TRUE(classes.subscribed(vessel).contains(speed)) << "it is not published";
  EXPECT_EQ(classes.turn(vessel, true), false);
  classes.set_others(vessel, {motion, motion});
  EXPECT_FALSE(classes.turn(vessel, false)) << "the switch is off";
}

struct Books {
  Books() {
    phase.begin_joining();
    phase.joined({7});
    objects.begin(0);
  }
  FederateAmbassador deaf;
  JoinPhase phase;
  FrameOutbox frames{phase};
  AmbassadorCounters counters;
  ObjectBook objects;
  RegionBook regions{harbour()};
  OwnershipBook ownership{{harbour(), deaf, phase, frames, counters}, objects, regions};
};

TEST(OwnershipBook, HoldsOnlyWhatIsOwnedInPartOrNegotiatedAbout) {
  Books books;
  const ObjectHandle object = books.objects.add(vessel);
  OwnershipBook& ownership = books.ownership;
  EXPECT_EQ(ownership.owned_of(object), whole_vessel);
  ownership.change(object, [](Holding& holding) { holding.lose(AttributeSet{speed}); });
  EXPECT_EQ(ownership.owned_of(object), whole_vessel.without(AttributeSet{speed}));
  EXPECT_NE(ownership.find(object), nullptr);
  EXPECT_FALSE(books.objects.find(object)->is_own);
  ownership.change(object, [](Holding& holding) { holding.gain(AttributeSet{speed}); });
  EXPECT_EQ(ownership.owned_of(object), whole_vessel);
  EXPECT_EQ(ownership.find(object), nullptr);
  EXPECT_TRUE(books.objects.find(object)->is_own);
  ownership.withdraw(vessel, motion, true);
  EXPECT_TRUE(ownership.owned_of(object).is_empty());
  EXPECT_EQ(ownership.find(object), nullptr) << "nothing owned, and nothing under way";
}

TEST(OwnershipBook, RefusesToResignFromWhatWouldBeLeft) {
  Books books;
  const ObjectHandle object = books.objects.add(vessel);
  EXPECT_THROW(books.ownership.require_resignable(ResignAction::no_action), RtiException);
  EXPECT_NO_THROW(books.ownership.require_resignable(ResignAction::delete_objects));
  books.ownership.change(object, [](Holding& holding) { holding.lose(whole_vessel); });
  EXPECT_NO_THROW(books.ownership.require_resignable(ResignAction::no_action));
  books.ownership.acquire(object,
                          [](Holding& holding) { holding.acquiring = AttributeSet{position}; });
  EXPECT_THROW(books.ownership.require_resignable(ResignAction::no_action), RtiException);
  EXPECT_NO_THROW(
      books.ownership.require_resignable(ResignAction::cancel_pending_ownership_acquisitions));
}

}  // namespace
}  // namespace rink::rti::testing
