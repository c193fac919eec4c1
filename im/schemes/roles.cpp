// The schemes `always`, `team` and `owner`: an entity matters to a subscriber by what it is,
// wherever both are.
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

using Place = Region (*)(const Role&);

Region at(double x) { return {x, 0.0, x, 0.0}; }

/// Puts all with the same number at one place on a line, so that overlap shows which match, and
/// only a change of role is a move.
class RoleFilter final : public OverlapFilter {
 public:
  RoleFilter(Place of_entity, Place of_subscriber)
      : OverlapFilter(Region{-2.0, 0.0, 64.0, 1.0}),
        of_entity_(of_entity),
        of_subscriber_(of_subscriber) {}

  void set_update_region(Entity entity, const Region&) override {
    if (!entities_.contains(entity)) set_entity_role(entity, {}, true);
  }
  void set_subscription_region(Subscriber subscriber, const Region&) override {
    if (!subscribers_.contains(subscriber)) set_subscriber_role(subscriber, {}, true);
  }
  void set_entity_role(Entity entity, const Role& role) override {
    set_entity_role(entity, role, entities_.contains(entity));
  }
  void set_subscriber_role(Subscriber subscriber, const Role& role) override {
    set_subscriber_role(subscriber, role, subscribers_.contains(subscriber));
  }
  Traits traits() const override { return {.uses_roles = true}; }

 private:
  void set_entity_role(Entity entity, const Role& role, bool is_there) {
    if (is_there) OverlapFilter::set_update_region(entity, of_entity_(role));
  }
  void set_subscriber_role(Subscriber subscriber, const Role& role, bool is_there) {
    if (is_there) OverlapFilter::set_subscription_region(subscriber, of_subscriber_(role));
  }

  Place of_entity_, of_subscriber_;
};

/// Ids without a number match none: such entities are left of all numbers, and such subscribers
/// still farther left.
template <std::uint32_t Role::*number>
std::unique_ptr<Filter> make_by() {
  return std::make_unique<RoleFilter>(
      [](const Role& role) { return role.*number == Role::none ? at(-1.0) : at(role.*number); },
      [](const Role& role) { return role.*number == Role::none ? at(-2.0) : at(role.*number); });
}

}  // namespace

std::unique_ptr<Filter> make_always_filter(const FilterSettings& settings);
std::unique_ptr<Filter> make_owner_filter(const FilterSettings& settings);
std::unique_ptr<Filter> make_team_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_always_filter(const FilterSettings&) {
  return std::make_unique<RoleFilter>(
      [](const Role& role) { return at(role.is_always_relevant ? 0.0 : 1.0); },
      [](const Role&) { return at(0.0); });
}
std::unique_ptr<Filter> make_owner_filter(const FilterSettings&) { return make_by<&Role::owner>(); }
std::unique_ptr<Filter> make_team_filter(const FilterSettings&) { return make_by<&Role::team>(); }

}  // namespace rink::im
