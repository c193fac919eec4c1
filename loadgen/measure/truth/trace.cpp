// A line for the bodies, one for each look, one for each contact.
#include "loadgen/measure/truth/trace.h"

#include <nlohmann/json.hpp>

namespace rink::loadgen {
namespace {

using Json = nlohmann::ordered_json;
constexpr int trace_version = 1;

std::string name_of(physics::BodyKind kind) {
  return kind == physics::BodyKind::bat ? "bat" : kind == physics::BodyKind::puck ? "puck" : "post";
}

const char* name_of(RelevanceArea::Shape shape) {
  switch (shape) {
    case RelevanceArea::Shape::square:
      return "square";
    case RelevanceArea::Shape::disc:
      return "disc";
    case RelevanceArea::Shape::contact:
      return "contact";
    case RelevanceArea::Shape::filter:
      break;
  }
  return "filter";
}

}  // namespace

void TruthTrace::begin(const RelevanceArea& area, const Replay& replay) {
  Json bodies = Json::array(), bats = Json::array(), always = Json::array();
  for (const game::Entity& entity : replay.game().entities())
    bodies.push_back({entity.id.index, entity.half_extent.x(), entity.half_extent.y(),
                      name_of(entity.kind), static_cast<int>(entity.team)});
  for (std::uint32_t player = 0; player < replay.player_count(); ++player) {
    const auto bat = replay.bat_of(player);
    bats.push_back(bat ? Json(*bat) : Json(nullptr));
  }
  for (const physics::BodyKind kind :
       {physics::BodyKind::puck, physics::BodyKind::bat, physics::BodyKind::post})
    if (area.always && area.always->has(kind)) always.push_back(name_of(kind));
  writer_.line({{"rink-truth", trace_version},
                {"begin_s", replay.begin_s()},
                {"shape", name_of(area.shape)},
                {"reach", area.reach},
                {"team", area.has_team},
                {"always", always},
                {"bats", bats},
                {"bodies", bodies}});
}

void TruthTrace::look(double instant_s, const Replay& replay) {
  Json at = Json::array(), replaced = Json::array();
  for (const game::Entity& entity : replay.game().entities()) {
    const std::uint32_t body = entity.id.index;
    if (!replay.is_there(body)) continue;
    for (const Json& each :
         {Json(body), Json(replay.centre(body).x()), Json(replay.centre(body).y())})
      at.push_back(each);
    if (const auto since_s = replay.replaced_s(body)) replaced.push_back({body, *since_s});
  }
  writer_.line({{"t", instant_s}, {"at", at}, {"replaced", replaced}});
}

void TruthTrace::contact(double instant_s, std::uint32_t body, std::uint32_t other) {
  writer_.line({{"contact", {instant_s, body, other}}});
}

}  // namespace rink::loadgen
