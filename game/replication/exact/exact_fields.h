// Where the bits of the policy "exact" go, field by field.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "game/replication/exact/exact_messages.h"
#include "rti/ledger/conversation_fields.h"

namespace rink::game {

/// Follows who is known to one client, which gives the ranks in messages their meaning, and
/// computes nothing.
class ExactFields final : public rti::HostContent {
 public:
  bool list_fields(rti::Bytes content, const rti::FieldVisitor& visit) override;

 private:
  struct Body {
    std::uint32_t number = 0, exact_class = 0;
    Drive drive;
  };
  bool is_bat(const Body& body) const {
    return start_->classes[body.exact_class].kind == physics::BodyKind::bat;
  }
  void apply(const ExactTick& tick, const std::vector<Drive>& drives);

  std::optional<ExactStart> start_;
  double time_ = 0.0;
  std::uint64_t tag_ = 0;
  std::vector<Body> bodies_;  ///< by number
};

}  // namespace rink::game
