// The ownership state machine against one that goes attribute by attribute, over random requests of
// federates that come and go.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "rti/ownership/ownership.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using Kind = OwnershipEvent::Kind;
using Told =
    std::multiset<std::tuple<Kind, std::uint32_t, std::uint32_t>>;  ///< kind, federate, attribute

/// The rules of clause 7 for one attribute, written down without sets or records.
struct ReferenceAttribute {
  struct Claim {
    std::uint32_t federate;
    bool is_if_available;
  };
  std::uint32_t owner = no_federate;
  bool is_offered = false;
  std::vector<Claim> claims;

  bool is_claimed_by(std::uint32_t federate, bool is_if_available) const {
    return std::any_of(claims.begin(), claims.end(), [&](const Claim& each) {
      return each.federate == federate && each.is_if_available == is_if_available;
    });
  }
  void remove(std::uint32_t federate) {
    std::erase_if(claims, [&](const Claim& each) { return each.federate == federate; });
  }
  template <class Tell>
  void hand_to(std::uint32_t federate, Tell tell) {
    owner = federate;
    is_offered = false;
    remove(federate);
    tell(Kind::acquired, federate);
    end(true, tell);
    if (!claims.empty()) tell(Kind::release_requested, federate);
  }
  template <class Tell>
  void end(bool only_if_available, Tell tell) {
    for (const Claim& each : claims)
      if (each.is_if_available || !only_if_available) tell(Kind::unavailable, each.federate);
    std::erase_if(claims,
                  [&](const Claim& each) { return each.is_if_available || !only_if_available; });
  }
  template <class Tell>
  void divest(Tell tell) {
    if (!claims.empty()) return hand_to(claims.front().federate, tell);
    owner = no_federate;
    is_offered = false;
    tell(Kind::offered, no_federate);
  }
  template <class Tell>
  void offer(Tell tell) {
    is_offered = true;
    if (claims.empty()) tell(Kind::offered, no_federate);
    else tell(Kind::confirmation_requested, owner);
  }
  template <class Tell>
  void withdraw(Tell tell) {
    is_offered = false;
    end(true, tell);
    if (!claims.empty()) tell(Kind::release_requested, owner);
  }
  template <class Tell>
  void acquire(std::uint32_t federate, Tell tell) {
    if (owner == federate || is_claimed_by(federate, false)) return;
    if (owner == no_federate) return hand_to(federate, tell);
    const bool was_claimed = !claims.empty();
    remove(federate);
    claims.push_back({federate, false});
    if (!is_offered) tell(Kind::release_requested, owner);
    else if (!was_claimed) tell(Kind::confirmation_requested, owner);
  }
  template <class Tell>
  void acquire_if_available(std::uint32_t federate, Tell tell) {
    if (owner == federate || is_claimed_by(federate, false) || is_claimed_by(federate, true))
      return;
    if (owner == no_federate) return hand_to(federate, tell);
    if (!is_offered) return tell(Kind::unavailable, federate);
    if (claims.empty()) tell(Kind::confirmation_requested, owner);
    claims.push_back({federate, true});
  }
  template <class Tell>
  void cancel(std::uint32_t federate, Tell tell) {
    if (!is_claimed_by(federate, false)) return;
    std::erase_if(claims, [&](const Claim& each) {
      return each.federate == federate && !each.is_if_available;
    });
    tell(Kind::cancelled, federate);
  }
};

/// Three ferries, seven federates, and both models of who owns what.
struct Ledgers {
  static constexpr std::uint32_t federates = 7, objects = 3;
  ObjectTable table{harbour()};
  Ownership ownership{harbour(), table};
  std::array<std::array<ReferenceAttribute, attribute_max>, objects> reference;
  std::array<ObjectSlot, objects> slots{};
  Told expected, told;

  Ledgers() {
    for (std::uint32_t i = 0; i < objects; ++i) {
      slots[i] = table.insert({i}, i, static_cast<std::uint16_t>(ferry.value), "");
      for (std::uint32_t k = 0; k < attribute_max; ++k)
        if (ownership.all(slots[i]).contains({k})) reference[i][k].owner = i;
    }
  }
  void take(Ownership::Events events) {
    for (const OwnershipEvent& each : events)
      for (std::uint32_t k = 0; k < attribute_max; ++k)
        if (each.attributes.contains({k})) told.insert({each.kind, each.federate, k});
  }
  template <class Act>
  void expect(std::uint32_t object, AttributeSet set, Act act) {
    for (std::uint32_t k = 0; k < attribute_max; ++k)
      if (set.contains({k}))
        act(reference[object][k], [&](Kind kind, std::uint32_t federate) {
          expected.insert({kind, federate, k});
        });
  }
  void leave(std::uint32_t federate) {
    ownership.forget_claims(federate);
    for (auto& object : reference)
      for (ReferenceAttribute& each : object) each.remove(federate);
    for (std::uint32_t i = 0; i < objects; ++i) {
      const AttributeSet owned = ownership.owned_by(federate, slots[i]);
      if (owned.is_empty()) continue;
      take(ownership.divest(federate, slots[i], owned));
      expect(i, owned, [](ReferenceAttribute& each, auto tell) { each.divest(tell); });
    }
  }
  void step(std::uint32_t operation, std::uint32_t federate, std::uint32_t object,
            AttributeSet wish) {
    const ObjectSlot slot = slots[object];
    const AttributeSet set = wish & ownership.all(slot),
                       own = set & ownership.owned_by(federate, slot);
    switch (operation) {
      case 0:
        take(ownership.acquire(federate, slot, set));
        return expect(object, set, [&](auto& each, auto tell) { each.acquire(federate, tell); });
      case 1:
        take(ownership.acquire_if_available(federate, slot, set));
        return expect(object, set,
                      [&](auto& each, auto tell) { each.acquire_if_available(federate, tell); });
      case 2:
        take(ownership.cancel(federate, slot, set));
        return expect(object, set, [&](auto& each, auto tell) { each.cancel(federate, tell); });
      case 3:
        return leave(federate);
      default:
        break;
    }
    if (own.is_empty()) return;
    switch (operation) {
      case 4:
        take(ownership.divest(federate, slot, own));
        return expect(object, own, [](auto& each, auto tell) { each.divest(tell); });
      case 5: {
        const AttributeSet fresh = own.without(ownership.offered(slot));
        if (fresh.is_empty()) return;
        take(ownership.offer(federate, slot, fresh, {}));
        return expect(object, fresh, [](auto& each, auto tell) { each.offer(tell); });
      }
      case 6: {
        const AttributeSet offered = own & ownership.offered(slot);
        if (offered.is_empty()) return;
        take(ownership.withdraw_offer(federate, slot, offered));
        return expect(object, offered, [](auto& each, auto tell) { each.withdraw(tell); });
      }
      case 7:
        take(ownership.deny_release(federate, slot, own));
        return expect(object, own, [](auto& each, auto tell) { each.end(false, tell); });
      default:
        take(ownership.give(federate, slot, own));
        return expect(object, own, [](auto& each, auto tell) {
          if (!each.claims.empty()) each.hand_to(each.claims.front().federate, tell);
        });
    }
  }
  /// Both agree on every attribute, and the fast field on the object says the same.
  void compare() const {
    for (std::uint32_t i = 0; i < objects; ++i) {
      AttributeSet all = ownership.unowned(slots[i]);
      for (std::uint32_t f = 0; f < federates; ++f) {
        const AttributeSet owned = ownership.owned_by(f, slots[i]);
        ASSERT_TRUE((all & owned).is_empty()) << "an attribute has one owner or none";
        all = all | owned;
        ASSERT_EQ(table[slots[i]].owner == f, owned == ownership.all(slots[i]));
      }
      ASSERT_EQ(all, ownership.all(slots[i]));
      for (std::uint32_t k = 0; k < attribute_max; ++k) {
        if (!all.contains({k})) continue;
        const ReferenceAttribute& each = reference[i][k];
        ASSERT_EQ(ownership.owner_of(slots[i], {k}), each.owner);
        ASSERT_EQ(ownership.offered(slots[i]).contains({k}), each.is_offered);
        ASSERT_EQ(ownership.confirming(slots[i]).contains({k}),
                  each.is_offered && !each.claims.empty());
        ASSERT_TRUE(each.owner != no_federate || each.claims.empty())
            << "nobody waits for what is free";
        for (std::uint32_t f = 0; f < federates; ++f)
          ASSERT_EQ(ownership.sought_by(f, slots[i]).contains({k}),
                    each.is_claimed_by(f, false) || each.is_claimed_by(f, true));
      }
    }
  }
};

TEST(Ownership, AgreesWithOneThatGoesAttributeByAttributeOverRandomRequests) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Ledgers ledgers;
    for (int i = 0; i < 400; ++i) {
      auto operation = static_cast<std::uint32_t>(random() % 9);
      if (operation == 3 && random() % 8 != 0) operation = 0;  // few leave, more acquire
      const auto federate = static_cast<std::uint32_t>(random() % Ledgers::federates);
      const auto object = static_cast<std::uint32_t>(random() % Ledgers::objects);
      const auto low = static_cast<std::uint32_t>(random());
      ledgers.step(operation, federate, object, AttributeSet(low));
      ASSERT_EQ(ledgers.told, ledgers.expected) << "step " << i << ", operation " << operation;
      ASSERT_NO_FATAL_FAILURE(ledgers.compare()) << "step " << i << ", operation " << operation;
      ledgers.ownership.check();
      ledgers.table.check();
      ledgers.told.clear();
      ledgers.expected.clear();
    }
  }
}

TEST(Ownership, KeepsNothingOfObjectsThatBelongToOneFederateAndAreNotNegotiatedAbout) {
  Ledgers ledgers;
  EXPECT_EQ(ledgers.ownership.record_count(), 0u);
  const ObjectSlot slot = ledgers.slots[0];
  const AttributeSet all = ledgers.ownership.all(slot);
  ledgers.ownership.offer(0, slot, all, {});
  ledgers.ownership.acquire(5, slot, all);
  EXPECT_EQ(ledgers.ownership.record_count(), 1u);
  ledgers.ownership.give(0, slot, all);
  EXPECT_EQ(ledgers.table[slot].owner, 5u);
  EXPECT_EQ(ledgers.ownership.record_count(), 0u)
      << "a body that was handed over whole costs what it cost before";
}

}  // namespace
}  // namespace rink::rti::testing
