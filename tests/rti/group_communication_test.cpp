// Who belongs to a group and whom it reaches, alone and as a replaceable part of a federation.
#include "rti/groups/member_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using Members = std::vector<std::uint32_t>;

Members heard(GroupCommunication& groups, std::uint32_t group, std::uint32_t sender) {
  const auto receivers = groups.receivers(group, sender);
  return {receivers.begin(), receivers.end()};
}

TEST(MemberLists, ReachEveryMemberButTheSenderInTheOrderOfJoining) {
  MemberLists groups;
  for (const std::uint32_t federate : {7u, 3u, 9u, 3u}) groups.join(2, federate);
  EXPECT_EQ(heard(groups, 2, 1), (Members{7, 3, 9}));
  EXPECT_EQ(heard(groups, 2, 3), (Members{7, 9}));
  EXPECT_TRUE(heard(groups, 1, 3).empty());
  EXPECT_TRUE(heard(groups, 100, 3).empty());
  groups.leave(2, 7);
  groups.leave(2, 7);
  groups.leave(100, 7);
  EXPECT_EQ(heard(groups, 2, 1), (Members{3, 9}));
}

TEST(MemberLists, AgreeWithSetsOverRandomComingsAndGoings) {
  constexpr unsigned seed = 4;
  std::mt19937 engine(seed);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  MemberLists groups;
  std::set<std::pair<std::uint32_t, std::uint32_t>> belongs;
  for (int step = 0; step < 20'000; ++step) {
    const std::uint32_t group = random() % 6;
    const std::uint32_t federate = random() % 12;
    const std::uint32_t what = random() % 10;
    if (what < 5) groups.join(group, federate), belongs.emplace(group, federate);
    else if (what < 9) groups.leave(group, federate), belongs.erase({group, federate});
    else
      groups.remove_federate(federate),
          std::erase_if(belongs, [&](const auto& each) { return each.second == federate; });
    const std::uint32_t sender = random() % 12;
    Members expected, is = heard(groups, group, sender);
    for (std::uint32_t each = 0; each < 12; ++each) {
      ASSERT_EQ(groups.is_member(group, each), belongs.contains({group, each}))
          << "seed " << seed << " step " << step;
      if (each != sender && belongs.contains({group, each})) expected.push_back(each);
    }
    std::ranges::sort(is);
    ASSERT_EQ(is, expected) << "seed " << seed << " step " << step;
  }
}

/// A user's own: a message reaches one member, each in turn, as work does that anybody may take on.
class OneInTurn final : public GroupCommunication {
 public:
  void join(std::uint32_t group, std::uint32_t federate) override { lists_.join(group, federate); }
  void leave(std::uint32_t group, std::uint32_t federate) override {
    lists_.leave(group, federate);
  }
  void remove_federate(std::uint32_t federate) override { lists_.remove_federate(federate); }
  bool is_member(std::uint32_t group, std::uint32_t federate) const override {
    return lists_.is_member(group, federate);
  }
  std::span<const std::uint32_t> receivers(std::uint32_t group, std::uint32_t sender) override {
    const auto all = lists_.receivers(group, sender);
    return all.empty() ? all : all.subspan(turn_++ % all.size(), 1);
  }

 private:
  MemberLists lists_;
  std::size_t turn_ = 0;
};

TEST(GroupCommunication, IsReplaceableByAUsersOwn) {
  FederationServices services;
  services.group_communication = [] { return std::make_unique<OneInTurn>(); };
  Rig rig(Carrier::in_process, {}, {}, services);
  Station& caller = rig.join("caller");
  std::vector<Station*> crew;
  for (const char* name : {"Anna", "Bert", "Carl"}) crew.push_back(&rig.join(name));
  caller.ambassador.publish_interaction_class(hail);
  for (Station* each : crew) each->ambassador.subscribe_interaction_class(hail);
  rig.settle();
  for (int i = 0; i < 30; ++i) caller.ambassador.send_interaction(hail, bytes_of("call"), {});
  rig.settle();
  for (Station* each : crew) EXPECT_EQ(each->heard.interactions.size(), 10u);
}

}  // namespace
}  // namespace rink::rti::testing
