// Routes keys to the match, the menu or the camera, and handles the mouse.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/control/bat_controller.h"
#include "game/match/replay_match.h"
#include "game/view/application.h"
#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

constexpr double click_reach = 8.0;  ///< pixels: tolerance of a click's motion and target
constexpr double moved_far =
    0.1;  ///< a hand is this far from its bat only if somebody moves it [m]

}  // namespace

EventQueue::Pace Application::pace() const {
  if (menu_.screen() == Menu::Screen::none) return EventQueue::Pace::play;
  return menu_.is_ready() ? EventQueue::Pace::menu : EventQueue::Pace::opening;
}

/// Handles the events of this drawing.
void Application::hear_events(Interface& interface) {
  using Kind = WindowEvent::Kind;
  events_.begin_frame();
  while (const std::optional<WindowEvent> event = events_.take(pace())) {
    interface.receive(*event);
    if (event->kind == Kind::close) wants_to_quit_ = true;
    else if (event->kind == Kind::key) hear_key(event->key, event->is_down);
    else if (event->kind == Kind::focus_lost) release_all();
    hand_.hear(*event);
    if (menu_.screen() == Menu::Screen::none) hear_mouse(*event);
  }
}

void Application::hear_key(KeyCode code, bool is_down) {
  if (!is_down) return release(code);
  MenuWish wish;
  if (menu_.take_key(code, settings_, wish)) return do_wish(wish);
  if (code == GLFW_KEY_F11) {
    settings_.is_full_screen = !settings_.is_full_screen;
    return do_wish({MenuWish::Kind::full_screen, {}});
  }
  if (menu_.screen() != Menu::Screen::none) return;
  if (const auto meaning = bound(settings_, code); meaning && match_->hand_count() > 0)
    return press(code, *meaning);
  hear_command(code);
}

void Application::set_split(bool is_wanted) {
  if (match_->hand_count() != 2) return;
  release_all();
  settings_.is_split = is_wanted;
  // Back from two views it is the one that was chosen before.
  if (is_wanted) cameras_.before_split = std::exchange(cameras_.chosen, std::nullopt);
  else cameras_.chosen = cameras_.before_split;
  do_wish({MenuWish::Kind::settings_changed, {}});
}

/// Handles keys of the window; those of the bats come first.
bool Application::hear_command(KeyCode code) {
  if (hear_replay(code)) return true;
  if (code == GLFW_KEY_SPACE && feel_.shows_goal(*match_, menu_)) {
    feel_.replay.skip();
    return true;
  }
  switch (code) {
    case GLFW_KEY_TAB:
      ++interest_.chosen;
      interest_.picked.reset();
      return true;
    case GLFW_KEY_I:
      interest_.is_shown = !interest_.is_shown;
      return true;
    case GLFW_KEY_F1:
      set_paused(true);
      menu_.open(Menu::Screen::help);
      use(Hint::help);
      return true;
    case GLFW_KEY_V:
      set_split(!is_split());
      return true;
    case GLFW_KEY_ESCAPE:
    case GLFW_KEY_P:
      set_paused(true);
      return true;
    case GLFW_KEY_C:
      release_all();
      use(Hint::camera);
      cameras_.chosen = is_split()
                            ? Viewpoint::side
                            : static_cast<Viewpoint>((static_cast<int>(view_.viewpoint) + 1) % 4);
      return true;
    case GLFW_KEY_M:
      settings_.is_muted = !settings_.is_muted;
      do_wish({MenuWish::Kind::settings_changed, {}});
      return true;
    case GLFW_KEY_F:
      follows_ = !follows_;
      return true;
    case GLFW_KEY_F3:
      figures_.are_shown = !figures_.are_shown;
      return true;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      view_.zoom = std::min(40.0, view_.zoom * 1.25);
      return true;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      view_.zoom = std::max(1.0, view_.zoom / 1.25);
      return true;
    default:
      return false;
  }
}

/// Handles keys of a recorded match: space pauses, left and right seek, up and down change its
/// speed, home is its start.
bool Application::hear_replay(KeyCode code) {
  auto* replay = dynamic_cast<game::ReplayMatch*>(match_.get());
  if (replay == nullptr) return false;
  const double now = replay->sight().time;
  switch (code) {
    case GLFW_KEY_SPACE:
      replay->pause(!replay->is_paused());
      return true;
    case GLFW_KEY_LEFT:
      replay->seek(now - 5.0);
      return true;
    case GLFW_KEY_RIGHT:
      replay->seek(now + 5.0);
      return true;
    case GLFW_KEY_UP:
      replay->set_speed(std::min(8.0, 2.0 * replay->speed()));
      return true;
    case GLFW_KEY_DOWN:
      replay->set_speed(std::max(1.0 / 16.0, 0.5 * replay->speed()));
      return true;
    case GLFW_KEY_HOME:
      replay->rematch();
      return true;
    default:
      return false;
  }
}

/// Handles the mouse in the view from above: the wheel zooms, dragging moves the view, a click
/// inspects a thing.
void Application::hear_mouse(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (auto* replay = dynamic_cast<game::ReplayMatch*>(match_.get())) {
    if (const auto instant = recorded_.bar.hear(event, size_, replay->end()))
      replay->seek(*instant);
    if (recorded_.bar.is_held()) return;
  }
  const bool is_pointer = settings_.control == Control::pointer && match_->hand_count() > 0;
  if (event.kind == Kind::scroll)
    view_.zoom = std::clamp(view_.zoom * std::pow(1.15, event.y), 1.0, 40.0);
  else if (event.kind == Kind::mouse_button && event.is_down)
    mouse_.is_dragging = true, mouse_.dragged = 0.0;
  else if (event.kind == Kind::mouse_button && std::exchange(mouse_.is_dragging, false) &&
           mouse_.dragged < click_reach)
    click();
  else if (event.kind == Kind::mouse_move) {
    if (mouse_.is_dragging && !is_pointer) drag(event.x - mouse_.x, event.y - mouse_.y);
    mouse_.x = event.x, mouse_.y = event.y;
  }
}

/// The camera of the last frame.
Sight Application::seen() const {
  assert(view_.zoom >= 1.0 && "no more than the whole field");
  const double aspect = static_cast<double>(size_.width) / size_.height;
  return {camera_of(match_->sight().field, view_, aspect), static_cast<float>(aspect)};
}

/// `across`, `down`: pixels.
void Application::drag(double across, double down) {
  mouse_.dragged += std::abs(across) + std::abs(down);
  if (mouse_.dragged < click_reach) return;
  const Sight sight = seen();
  const physics::Field& field = match_->sight().field;
  view_.centre.x() -=
      2.0 * across / size_.width * static_cast<double>(sight.right().x()) / field.length;
  view_.centre.y() += 2.0 * down / size_.height * static_cast<double>(sight.up().y()) / field.width;
  view_.centre = view_.centre.cwiseMax(0.0).cwiseMin(1.0);
  follows_ = false;
}

void Application::click() {
  if (!match_->sight().interest || view_.viewpoint != Viewpoint::above) return;
  const Sight sight = seen();
  const Eigen::Vector2f at(static_cast<float>(2.0 * mouse_.x / size_.width - 1.0),
                           static_cast<float>(1.0 - 2.0 * mouse_.y / size_.height));
  const double pixel = 2.0 * static_cast<double>(sight.up().y()) / size_.height;
  if (const auto thing =
          thing_at(match_->sight(), sight.on_table(at).cast<double>(), click_reach * pixel))
    interest_.picked = thing;
}

/// The place on the table under the pointer [m], as the player of hand 0 sees it.
Vector2 Application::under_pointer() const {
  const Vector2 pointer = hand_.pointer().value_or(Vector2(0.0, 0.0));
  const int width = is_split() ? size_.width / 2 : size_.width;
  ViewChoice choice = view_;
  choice.viewpoint = viewpoint_of(0);
  const double aspect = static_cast<double>(width) / size_.height;
  const Sight sight(camera_of(match_->sight().field, choice, aspect), static_cast<float>(aspect));
  const Eigen::Vector2f at(static_cast<float>(2.0 * pointer.x() / width - 1.0),
                           static_cast<float>(1.0 - 2.0 * pointer.y() / size_.height));
  return sight.on_table(at).cast<double>();
}

/// Pulls the bat of the only player, or of the left of two, towards the hand; not in menus, and not
/// while keys are held.
void Application::move_hand() {
  if (match_->hand_count() == 0) return;
  const MatchSight& sight = match_->sight();
  const game::Team team = sight.own_team.value_or(game::Team::left);
  const auto bat = std::ranges::find_if(sight.things, [team](const Thing& thing) {
    return thing.kind == physics::BodyKind::bat && thing.team == team;
  });
  const bool has_keys =
      std::ranges::any_of(held_, [](const HeldKey& held) { return held.hand == 0; });
  if (menu_.screen() != Menu::Screen::none || has_keys || bat == sight.things.end())
    return match_->reach(0, std::nullopt);
  const auto way = [this](game::Key key) {
    game::KeysHeld keys;
    keys.set(seen_from(viewpoint_of(0), key), true);
    return game::direction(keys);
  };
  const std::optional<Vector2> place = hand_.place(settings_, {.field = sight.field,
                                                               .bat = bat->position,
                                                               .under = under_pointer(),
                                                               .right = way(game::Key::right),
                                                               .up = way(game::Key::up)});
  if (place && sight.phase == Phase::playing && (*place - bat->position).norm() > moved_far)
    use(Hint::move);
  match_->reach(0, place);
}

/// While a match is played by a person.
void Application::add_hand_words(Picture& picture, double now_s) {
  if (match_->hand_count() == 0 || match_->sight().phase != Phase::playing) return;
  const HandControl::Words words = hand_.words(settings_, match_->why_keys_alone(), now_s);
  if (!words.text.empty())
    picture.texts.push_back({.words = words.text, .y = 0.895f, .size = 0.03f, .has_plate = true});
  if (words.is_new && surroundings_.notify) surroundings_.notify(words.text);
}

/// A single player may use either set of keys; directions are those of the player's view.
void Application::press(KeyCode code, const Bound& meaning) {
  const std::uint32_t hand = match_->hand_count() == 1 ? 0 : meaning.hand;
  assert(hand < match_->hand_count());
  const game::Key key = seen_from(viewpoint_of(hand), meaning.key);
  const bool was_down = std::ranges::any_of(
      held_, [&](const HeldKey& held) { return held.hand == hand && held.key == key; });
  held_.push_back({code, hand, key});
  if (!was_down) match_->press(hand, key, true);
  if (match_->sight().phase == Phase::playing) use(Hint::move);
}

void Application::release(KeyCode code) {
  const auto found = std::ranges::find(held_, code, &HeldKey::code);
  if (found == held_.end()) return;
  const HeldKey held = *found;
  held_.erase(found);
  const bool is_still_down = std::ranges::any_of(held_, [&](const HeldKey& other) {
    return other.hand == held.hand && other.key == held.key;
  });
  if (!is_still_down) match_->press(held.hand, held.key, false);
}

void Application::release_all() {
  while (!held_.empty()) {
    [[maybe_unused]] const std::size_t before = held_.size();
    release(held_.back().code);
    assert(held_.size() + 1 == before && "every turn lets go of one key");
  }
}

}  // namespace rink::view
