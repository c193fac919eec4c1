// Runs the readers' own function over each message; its stream notes where each field begins.
#include "game/replication/exact/exact_fields.h"

#include <algorithm>
#include <functional>

namespace rink::game {
namespace {

/// Gives the bits between two marks to the field of the first.
class MarkedBits : public rti::BitReader {
 public:
  MarkedBits(rti::Bytes bytes, const rti::FieldVisitor& visit)
      : rti::BitReader(bytes), visit_(visit) {}
  void begin_field(const char* field) {
    if (at() > from_) visit_(field_, at() - from_);
    field_ = field, from_ = at();
  }

 private:
  const rti::FieldVisitor& visit_;
  const char* field_ = "";
  std::size_t from_ = 0;
};

}  // namespace

bool ExactFields::list_fields(rti::Bytes content, const rti::FieldVisitor& visit) {
  const bool is_start = !content.empty() && (std::to_integer<int>(content[0]) & 1) != 0;
  if (is_start) bodies_.clear();
  std::vector<std::uint32_t> classes;
  std::vector<Drive> drives;
  classes.reserve(bodies_.size()), drives.reserve(bodies_.size());
  for (const Body& body : bodies_) {
    classes.push_back(body.exact_class);
    if (is_bat(body)) drives.push_back(body.drive);
  }
  const ExactContext context{.time = time_,
                             .tag = tag_,
                             .start = start_ ? &*start_ : nullptr,
                             .bats = static_cast<std::uint32_t>(drives.size()),
                             .class_of = classes};
  MarkedBits bits(content, visit);
  ExactTick tick;
  if (!exact::exchange(bits, tick, context, drives)) return start_.reset(), false;
  bits.begin_field("fill");
  if (!bits.finish() || bits.left() != 0) return start_.reset(), false;
  bits.begin_field("");
  if (tick.start) start_ = std::move(tick.start);
  apply(tick, drives);
  return true;
}

/// `drives`: of the known bats before the tick, with its keys.
void ExactFields::apply(const ExactTick& tick, const std::vector<Drive>& drives) {
  time_ = tick.time, tag_ = tick.tag;
  auto drive = drives.begin();
  for (Body& body : bodies_)
    if (is_bat(body)) body.drive = *drive++;
  for (const ExactTold& each : tick.told) bodies_[each.rank].drive = each.state.drive;
  for (auto exit = tick.exits.rbegin(); exit != tick.exits.rend(); ++exit)
    if (!exit->lingers) bodies_.erase(bodies_.begin() + exit->rank);
  for (const ExactEntry& entry : tick.entries)
    bodies_.insert(std::ranges::lower_bound(bodies_, entry.number, {}, &Body::number),
                   {entry.number, entry.exact_class, entry.state.drive});
}

}  // namespace rink::game
