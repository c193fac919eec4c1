// Turns pointer and stick into places on the field, and says in a player's words what is missing.
#include "game/view/hand_control.h"

#include <algorithm>
#include <cassert>

namespace rink::view {

Vector2 beyond_dead_zone(const Vector2& deflection, double dead_zone) {
  assert(dead_zone >= 0.0 && dead_zone <= 0.9);
  const double size = deflection.norm();
  if (!(size > dead_zone)) return {0.0, 0.0};
  return deflection * (std::min(1.0, (size - dead_zone) / (1.0 - dead_zone)) / size);
}

void HandControl::hear(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::mouse_move) pointer_ = Vector2(event.x, event.y), on_table_.reset();
  else if (event.kind == Kind::pointer) on_table_ = Vector2(event.x, event.y);
  else if (event.kind == Kind::stick) stick_ = {event.x, event.y};
  else if (event.kind == Kind::gamepad) {
    has_gamepad_ = event.is_down;
    had_gamepad_ = had_gamepad_ || has_gamepad_;
    stick_ = {0.0, 0.0};
  }
}

std::optional<Vector2> HandControl::place(const Settings& settings, const Table& table) const {
  if (settings.control == Control::gamepad && has_gamepad_) {
    const Vector2 way = beyond_dead_zone(stick_, settings.dead_zone);
    return table.bat +
           stick_reach * settings.sensitivity * (way.x() * table.right + way.y() * table.up);
  }
  if (settings.control != Control::pointer || (!pointer_ && !on_table_)) return std::nullopt;
  const Vector2 size(table.field.length, table.field.width);
  // About the middle of the own half, so that all of it stays within reach.
  const Vector2 middle(table.bat.x() < 0.5 * size.x() ? 0.25 * size.x() : 0.75 * size.x(),
                       0.5 * size.y());
  const Vector2 under = on_table_.value_or(table.under);
  const Vector2 place = middle + settings.sensitivity * (under - middle);
  if (!place.allFinite()) return std::nullopt;  // above the horizon
  return place.cwiseMax(-size).cwiseMin(2.0 * size);
}

std::string HandControl::trouble(const Settings& settings,
                                 const std::string& why_keys_alone) const {
  if (settings.control == Control::keys) return "";
  if (!why_keys_alone.empty()) return why_keys_alone + ": the keys move your bat";
  if (settings.control == Control::pointer)
    return pointer_ || on_table_ ? "" : "Move the pointer over the table to move your bat";
  if (has_gamepad_) return "";
  return had_gamepad_ ? "The gamepad is gone: the keys go on"
                      : "No gamepad is there: the keys move your bat";
}

HandControl::Words HandControl::words(const Settings& settings, const std::string& why_keys_alone,
                                      double now_s) {
  const std::string now = trouble(settings, why_keys_alone);
  const bool is_new = now != said_;
  if (is_new) said_ = now, said_s_ = now_s;
  return {now_s - said_s_ < shown_s ? said_ : "", is_new && !said_.empty()};
}

}  // namespace rink::view
