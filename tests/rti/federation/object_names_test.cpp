// Names of objects by themselves: reserved by one, used once, free again when nobody has them.
#include "rti/federation/services/object_names.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/rti/federation/service_ground.h"

namespace rink::rti {
namespace {

struct NameBook : ::testing::Test {
  Status ask(std::uint32_t slot, NameRequest request, std::initializer_list<const char*> wanted) {
    std::vector<std::byte> text;
    for (std::string_view name : wanted) Writer(text).text(name, text_max);
    InstanceNamesMessage message;
    message.word = static_cast<std::uint8_t>(request);
    message.names = text;
    return hand_in(message, [&](Reader& reader) { return names.handle(slot, reader); });
  }
  /// The last answer, if there was one.
  std::optional<NameAnswer> answer_to(std::uint32_t slot) {
    std::optional<NameAnswer> answer;
    for_each_said_to<InstanceNamesAnswerMessage>(federates[slot], [&](const auto& message) {
      answer = static_cast<NameAnswer>(message.word);
    });
    return answer;
  }
  std::optional<NameAnswer> reserve(std::uint32_t slot, const char* name) {
    EXPECT_EQ(ask(slot, NameRequest::reserve, {name}), Status());
    return answer_to(slot);
  }

  FederateTable federates;
  ObjectNames names{federates, 4};
  const std::uint32_t ann = federates.admit(1, "ann", ""), bob = federates.admit(2, "bob", "");
};

TEST_F(NameBook, KeepsANameForWhoReservedItFirst) {
  EXPECT_EQ(reserve(ann, "Titanic"), NameAnswer::granted);
  EXPECT_EQ(reserve(bob, "Titanic"), NameAnswer::refused);
  EXPECT_FALSE(names.take(bob, "Titanic"));
  EXPECT_EQ(answer_to(bob), NameAnswer::registration_refused);
  EXPECT_TRUE(names.take(ann, "Titanic"));
  EXPECT_FALSE(names.take(ann, "Titanic")) << "it is in use";
}

TEST_F(NameBook, GivesANameOfNobodyToWhoRegistersWithIt) {
  EXPECT_TRUE(names.take(ann, "Nautilus"));
  EXPECT_EQ(reserve(bob, "Nautilus"), NameAnswer::refused);
  names.give_back("Nautilus");
  EXPECT_EQ(reserve(bob, "Nautilus"), NameAnswer::granted);
}

TEST_F(NameBook, GrantsASetWholeOrNotAtAll) {
  reserve(bob, "b");
  ask(ann, NameRequest::reserve_set, {"a", "b", "c"});
  EXPECT_EQ(answer_to(ann), NameAnswer::set_refused);
  ask(ann, NameRequest::reserve_set, {"a", "a"});
  EXPECT_EQ(answer_to(ann), NameAnswer::set_refused) << "one name cannot be reserved twice";
  ask(ann, NameRequest::reserve_set, {"a", "c"});
  EXPECT_EQ(answer_to(ann), NameAnswer::set_granted);
}

TEST_F(NameBook, LeavesTheStandardsOwnNamesAlone) {
  EXPECT_EQ(reserve(ann, "HLAwhatever"), NameAnswer::refused);
  EXPECT_FALSE(names.take(ann, "HLAwhatever"));
}

TEST_F(NameBook, KeepsNoMoreNamesThanItsLimit) {
  ask(ann, NameRequest::reserve_set, {"a", "b", "c"});
  ask(bob, NameRequest::reserve_set, {"d", "e"});
  EXPECT_EQ(answer_to(bob), NameAnswer::set_refused);
  EXPECT_EQ(reserve(bob, "d"), NameAnswer::granted);
  EXPECT_EQ(reserve(bob, "e"), NameAnswer::refused);
}

TEST_F(NameBook, LetsGoOfANameOnlyForWhoHasReservedIt) {
  reserve(ann, "a");
  EXPECT_EQ(ask(bob, NameRequest::release, {"a"}), Violation::unknown_name);
  EXPECT_EQ(ask(ann, NameRequest::release, {"a"}), Status());
  EXPECT_EQ(ask(ann, NameRequest::release, {"a"}), Violation::unknown_name);
  EXPECT_EQ(reserve(bob, "a"), NameAnswer::granted);
  names.take(bob, "a");
  EXPECT_EQ(ask(bob, NameRequest::release, {"a"}), Violation::unknown_name) << "it is in use";
}

TEST_F(NameBook, FreesWhatOneWhoLeftHadReservedAndNotWhatIsInUse) {
  reserve(ann, "a"), reserve(ann, "b");
  names.take(ann, "b");
  names.left(ann);
  EXPECT_EQ(reserve(bob, "a"), NameAnswer::granted);
  EXPECT_EQ(reserve(bob, "b"), NameAnswer::refused);
}

}  // namespace
}  // namespace rink::rti
