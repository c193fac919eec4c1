// Publishers hear what others subscribe to, once for each change and never of themselves.
#include "rti/federation/services/declarations.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "tests/rti/federation/service_ground.h"

namespace rink::rti {
namespace {

struct DeclaredGround : ServiceGround {
  Interactions interactions{ground.basis(), *ground.groups, *ground.distribution,
                            objects.publications};
  OwnershipService owners{ground.basis(),
                          {ground.ownership, *ground.distribution, objects.publications,
                           objects.known, objects.newest, objects.objects}};
  Declarations declarations{
      ground.basis(),
      {*ground.distribution, ground.ownership, objects.publications, interactions, owners}};

  std::uint32_t join(std::string_view name) {
    const std::uint32_t slot = admit(name);
    interactions.joined(slot), owners.joined(slot), declarations.joined(slot);
    return slot;
  }
  Status publish(std::uint32_t slot, std::uint16_t object_class, AttributeSet attributes) {
    return hand_in(PublishObjectClassMessage{object_class, attributes.bits},
                   [&](Reader& reader) { return declarations.handle_publish_class(slot, reader); });
  }
  Status subscribe(std::uint32_t slot, std::uint16_t object_class, AttributeSet attributes,
                   bool is_passive = false) {
    const Status status = hand_in(
        SubscribeObjectClassMessage{object_class, attributes.bits, RegionHandle::none, is_passive},
        [&](Reader& reader) { return declarations.handle_subscribe_class(slot, reader); });
    declarations.subscriptions_changed(slot);
    return status;
  }
  Status publish_interaction(std::uint32_t slot, std::uint16_t number) {
    return hand_in(PublishInteractionClassMessage{number, 1}, [&](Reader& reader) {
      return declarations.handle_publish_interaction(slot, reader);
    });
  }
  void subscribe_interaction(std::uint32_t slot, std::uint16_t number, Listening how) {
    hand_in(SubscribeInteractionClassMessage{number, static_cast<std::uint8_t>(how)},
            [&](Reader& reader) { return interactions.handle_subscribe(slot, reader); });
    declarations.subscriptions_changed(slot);
  }
  /// What the publisher was told last, if anything, since it was asked last.
  std::optional<Subscription> told(std::uint32_t slot) {
    std::optional<Subscription> last;
    for_each_said_to<ClassRelevanceMessage>(federate(slot), [&](const auto& message) {
      last = Subscription{AttributeSet(message.subscribed), AttributeSet(message.active)};
    });
    return last;
  }
};

TEST(ServiceOfDeclarations, TellsAPublisherWhatOthersHearAndWhichOfItActively) {
  DeclaredGround all;
  const std::uint32_t ann = all.join("ann"), bob = all.join("bob"), eve = all.join("eve");
  EXPECT_EQ(all.publish(ann, body_class, all.both), Status());
  EXPECT_EQ(all.told(ann), Subscription{}) << "it has to know that nobody listens";
  all.subscribe(bob, body_class, all.position);
  EXPECT_EQ(all.told(ann), (Subscription{all.position, all.position}));
  all.subscribe(eve, body_class, all.both, true);
  EXPECT_EQ(all.told(ann), (Subscription{all.both, all.position}));
  all.subscribe(bob, body_class, {});
  EXPECT_EQ(all.told(ann), (Subscription{all.both, {}}));
  EXPECT_EQ(all.told(bob), std::nullopt) << "who publishes nothing is told nothing";
}

TEST(ServiceOfDeclarations, SaysNothingOfWhatChangesNothingForThePublisher) {
  DeclaredGround all;
  const std::uint32_t ann = all.join("ann"), bob = all.join("bob"), eve = all.join("eve");
  all.publish(ann, body_class, all.both);
  all.subscribe(bob, body_class, all.both);
  all.told(ann);
  all.subscribe(ann, body_class, all.both);
  EXPECT_EQ(all.told(ann), std::nullopt) << "it does not hear itself";
  all.subscribe(eve, body_class, all.position);
  EXPECT_EQ(all.told(ann), std::nullopt) << "somebody else did hear it already";
  all.subscribe(eve, body_class, {});
  EXPECT_EQ(all.told(ann), std::nullopt);
}

TEST(ServiceOfDeclarations, HearsOfASubclassThroughItsSuperclass) {
  DeclaredGround all;
  const std::uint32_t ann = all.join("ann"), bob = all.join("bob");
  all.publish(ann, puck_class, all.both);
  all.told(ann);
  all.subscribe(bob, body_class, all.position);
  EXPECT_EQ(all.told(ann), (Subscription{all.position, all.position}));
  EXPECT_TRUE(all.declarations.is_subscribed({puck_class}));
  EXPECT_FALSE(all.declarations.is_subscribed({0}));
}

TEST(ServiceOfDeclarations, TellsOfInteractionsLikewise) {
  DeclaredGround all;
  const std::uint32_t ann = all.join("ann"), bob = all.join("bob");
  EXPECT_EQ(all.publish_interaction(ann, 1), Status());
  EXPECT_EQ(all.told(ann), Subscription{});
  all.subscribe_interaction(bob, 0, Listening::passive);
  EXPECT_EQ(all.told(ann), (Subscription{AttributeSet(1u), {}}));
  all.subscribe_interaction(bob, 1, Listening::active);
  EXPECT_EQ(all.told(ann), (Subscription{AttributeSet(1u), AttributeSet(1u)}));
  all.subscribe_interaction(bob, 1, Listening::none);
  EXPECT_EQ(all.told(ann), (Subscription{AttributeSet(1u), {}}));
}

TEST(ServiceOfDeclarations, TakesNoClassAttributeOrRegionThatThereIsNot) {
  DeclaredGround all;
  const std::uint32_t ann = all.join("ann");
  const auto beyond = [](const auto& classes) {
    return static_cast<std::uint16_t>(classes.size());
  };
  const std::uint16_t no_class = beyond(plain_fom().object_classes());
  EXPECT_EQ(all.publish(ann, no_class, all.both), Violation::unknown_name);
  EXPECT_EQ(all.publish(ann, body_class, AttributeSet(1u << 7)), Violation::unknown_name);
  EXPECT_EQ(all.subscribe(ann, no_class, all.both), Violation::unknown_name);
  EXPECT_EQ(all.subscribe(ann, body_class, AttributeSet(1u << 7)), Violation::unknown_name);
  EXPECT_EQ(all.publish_interaction(ann, beyond(plain_fom().interaction_classes())),
            Violation::unknown_name);
  const Status in_no_region =
      hand_in(SubscribeObjectClassMessage{body_class, all.both.bits, 3, 0},
              [&](Reader& reader) { return all.declarations.handle_subscribe_class(ann, reader); });
  EXPECT_EQ(in_no_region, Violation::unknown_name);
  Reader nothing{Bytes()};
  EXPECT_EQ(all.declarations.handle_publish_class(ann, nothing), Violation::malformed);
}

/// Whatever is declared in whatever order: what each publisher was told last is the union of what
/// all others subscribe to, which a loop over them gives.
TEST(ServiceOfDeclarations, AgreesWithALoopOverAllWhateverIsDeclared) {
  constexpr std::uint64_t seed = 5;
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  DeclaredGround all;
  constexpr std::uint32_t count = 5;
  for (const char* name : {"a", "b", "c", "d", "e"}) all.join(name);
  std::vector<AttributeSet> published(count), heard(count), active(count);
  std::vector<Subscription> known(count);
  for (int step = 0; step < 2000; ++step) {
    const auto slot = static_cast<std::uint32_t>(random() % count);
    const AttributeSet attributes(static_cast<std::uint32_t>(random() % 4));
    if (random() % 3 == 0) {
      all.publish(slot, body_class, published[slot] = attributes);
    } else {
      const bool is_passive = random() % 2 == 0;
      all.subscribe(slot, body_class, attributes, is_passive);
      heard[slot] = attributes, active[slot] = is_passive ? AttributeSet() : attributes;
    }
    for (std::uint32_t publisher = 0; publisher < count; ++publisher) {
      if (const auto news = all.told(publisher)) known[publisher] = *news;
      if (published[publisher].is_empty()) continue;
      Subscription expected;
      for (std::uint32_t other = 0; other < count; ++other)
        if (other != publisher)
          expected = {expected.subscribed | heard[other], expected.active | active[other]};
      ASSERT_EQ(known[publisher], expected) << "step " << step << ", publisher " << publisher;
    }
  }
}

}  // namespace
}  // namespace rink::rti
