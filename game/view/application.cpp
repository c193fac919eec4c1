// Keys to the match or to the menu, wishes to whoever can fulfil them, and a picture of it all.
#include "game/view/application.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "game/match/replay_match.h"

namespace rink::view {
namespace {

/// The own bat, the one whose interest is shown, or else the puck.
const Thing* followed_by(const MatchSight& sight, const InterestChoice& interest) {
  if (!sight.own_team && interest.view_fraction > 0.0) return chosen_bat(sight, interest);
  const auto wanted = sight.own_team ? physics::BodyKind::bat : physics::BodyKind::puck;
  const auto found = std::ranges::find_if(sight.things, [&](const Thing& thing) { return thing.kind == wanted && (!sight.own_team || thing.team == *sight.own_team); });
  return found != sight.things.end() ? &*found : nullptr;
}

/// Where a replay is, how fast, and what its keys do.
Text replay_line(const game::ReplayMatch& replay) {
  char words[160];
  std::snprintf(words, sizeof words, "%s %.1f of %.1f s, speed %g     Space, Left, Right, Up, Down, Home", replay.is_paused() ? "stopped at" : "at", replay.sight().time, replay.end(), replay.speed());
  return {.words = words, .y = 0.895f, .size = 0.03f, .has_plate = true};
}

}  // namespace

Application::Application(Surroundings surroundings, const Settings& settings) : surroundings_(std::move(surroundings)), settings_(settings) {
  start({.kind = MatchWish::Kind::bots, .address = {}});
}

void Application::start(const MatchWish& wish) {
  std::unique_ptr<MatchSource> match = surroundings_.make_match(wish);
  held_.clear();
  match_ = std::move(match);
  wish_ = wish;
  view_ = {};
  phase_.reset();
  follows_ = false;
}

void Application::play(const MatchWish& wish) {
  try {
    start(wish);
    menu_.open(Menu::Screen::none);
  } catch (const std::exception& error) {
    explain(error.what());
  }
}

void Application::explain(const std::string& trouble) {
  menu_.explain(trouble);
  if (surroundings_.tell) surroundings_.tell(trouble);
}

void Application::do_wish(const MenuWish& wish) {
  using Kind = MenuWish::Kind;
  if (wish.kind == Kind::play) play(wish.match);
  else if (wish.kind == Kind::resume) set_paused(false);
  else if (wish.kind == Kind::rematch) match_->rematch();
  else if (wish.kind == Kind::quit) wants_to_quit_ = true;
  else if (wish.kind == Kind::leave) {
    start({.kind = MatchWish::Kind::bots, .address = {}});
    menu_.open(Menu::Screen::main);
  }
  if (wish.kind == Kind::full_screen && surroundings_.set_full_screen) surroundings_.set_full_screen(settings_.is_full_screen);
  if ((wish.kind == Kind::full_screen || wish.kind == Kind::settings_changed) && surroundings_.save_settings) surroundings_.save_settings(settings_);
}

void Application::hear(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::close) wants_to_quit_ = true;
  else if (event.kind == Kind::key) hear_key(event.key, event.is_down);
  else if (event.kind == Kind::focus_lost) release_all();
  else if (menu_.screen() == Menu::Screen::none) hear_mouse(event);
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
  if (const auto meaning = bound(settings_, code); meaning && match_->hand_count() > 0) return press(code, *meaning);
  hear_command(code);
}

/// Keys that steer the window; those of the bats come first.
bool Application::hear_command(KeyCode code) {
  if (hear_replay(code)) return true;
  switch (code) {
    case GLFW_KEY_TAB: ++interest_.chosen; return true;
    case GLFW_KEY_ESCAPE:
    case GLFW_KEY_P: set_paused(true); return true;
    case GLFW_KEY_C:
      release_all();
      chosen_viewpoint_ = static_cast<Viewpoint>((static_cast<int>(view_.viewpoint) + 1) % 4);
      return true;
    case GLFW_KEY_M: settings_.is_muted = !settings_.is_muted; do_wish({MenuWish::Kind::settings_changed, {}}); return true;
    case GLFW_KEY_F: follows_ = !follows_; return true;
    case GLFW_KEY_F3: shows_figures_ = !shows_figures_; return true;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD: view_.zoom = std::min(40.0, view_.zoom * 1.25); return true;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT: view_.zoom = std::max(1.0, view_.zoom / 1.25); return true;
    default: return false;
  }
}

/// A recorded match: space stops it, left and right seek, up and down change its speed, home is its start.
bool Application::hear_replay(KeyCode code) {
  auto* replay = dynamic_cast<game::ReplayMatch*>(match_.get());
  if (replay == nullptr) return false;
  const double now = replay->sight().time;
  switch (code) {
    case GLFW_KEY_SPACE: replay->pause(!replay->is_paused()); return true;
    case GLFW_KEY_LEFT: replay->seek(now - 5.0); return true;
    case GLFW_KEY_RIGHT: replay->seek(now + 5.0); return true;
    case GLFW_KEY_UP: replay->set_speed(std::min(8.0, 2.0 * replay->speed())); return true;
    case GLFW_KEY_DOWN: replay->set_speed(std::max(1.0 / 16.0, 0.5 * replay->speed())); return true;
    case GLFW_KEY_HOME: replay->rematch(); return true;
    default: return false;
  }
}

/// Seen from above: the wheel zooms, dragging moves what is seen.
void Application::hear_mouse(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::scroll) view_.zoom = std::clamp(view_.zoom * std::pow(1.15, event.y), 1.0, 40.0);
  else if (event.kind == Kind::mouse_button) is_dragging_ = event.is_down;
  else if (event.kind == Kind::mouse_move) {
    if (is_dragging_) {
      const Sight seen(camera_of(match_->sight().field, view_, static_cast<double>(size_.width) / size_.height), static_cast<float>(size_.width) / static_cast<float>(size_.height));
      const physics::Field& field = match_->sight().field;
      view_.centre.x() -= 2.0 * (event.x - mouse_x_) / size_.width * static_cast<double>(seen.right().x()) / field.length;
      view_.centre.y() += 2.0 * (event.y - mouse_y_) / size_.height * static_cast<double>(seen.up().y()) / field.width;
      view_.centre = view_.centre.cwiseMax(0.0).cwiseMin(1.0);
      follows_ = false;
    }
    mouse_x_ = event.x, mouse_y_ = event.y;
  }
}

/// One who plays alone may use either set of keys; each key means what it looks like from where the player sees the table.
void Application::press(KeyCode code, const Bound& meaning) {
  const std::uint32_t hand = match_->hand_count() == 1 ? 0 : meaning.hand;
  const game::Key key = seen_from(view_.viewpoint, meaning.key);
  const bool was_down = std::ranges::any_of(held_, [&](const HeldKey& held) { return held.hand == hand && held.key == key; });
  held_.push_back({code, hand, key});
  if (!was_down) match_->press(hand, key, true);
}

void Application::release(KeyCode code) {
  const auto found = std::ranges::find(held_, code, &HeldKey::code);
  if (found == held_.end()) return;
  const HeldKey held = *found;
  held_.erase(found);
  const bool is_still_down = std::ranges::any_of(held_, [&](const HeldKey& other) { return other.hand == held.hand && other.key == held.key; });
  if (!is_still_down) match_->press(held.hand, held.key, false);
}

void Application::release_all() {
  while (!held_.empty()) release(held_.back().code);
}

void Application::set_paused(bool is_wanted) {
  release_all();
  match_->pause(is_wanted);
  menu_.open(is_wanted ? Menu::Screen::paused : Menu::Screen::none);
}

/// Opens and closes the screens that the match itself calls for.
void Application::follow_phase() {
  const MatchSight& sight = match_->sight();
  if (wish_.kind == MatchWish::Kind::bots) {
    if (sight.phase == Phase::over) match_->rematch();
    return;
  }
  if (sight.phase == Phase::lost) {
    const std::string why = sight.notice;
    start({.kind = MatchWish::Kind::bots, .address = {}});
    return explain("The match cannot go on: " + why);
  }
  if (sight.phase == Phase::over && menu_.screen() == Menu::Screen::none && match_->hand_count() > 0) menu_.open(Menu::Screen::over);
  else if (sight.phase != Phase::over && menu_.screen() == Menu::Screen::over) menu_.open(Menu::Screen::none);
  else if (sight.phase == Phase::paused && phase_ != Phase::paused && match_->hand_count() > 0 && menu_.screen() == Menu::Screen::none) menu_.open(Menu::Screen::paused);
  else if (phase_ == Phase::paused && sight.phase != Phase::paused && menu_.screen() == Menu::Screen::paused) menu_.open(Menu::Screen::none);  // somebody went on
  phase_ = sight.phase;
}

ViewChoice Application::view(const MatchSight& sight, double now_s) {
  if (chosen_viewpoint_) view_.viewpoint = *chosen_viewpoint_;
  else if (sight.own_team) view_.viewpoint = *sight.own_team == game::Team::left ? Viewpoint::left_end : Viewpoint::right_end;
  else view_.viewpoint = sight.things.size() > 60 ? Viewpoint::above : Viewpoint::side;
  if (follows_) {
    if (const Thing* followed = followed_by(sight, interest_)) view_.centre = followed->position.cwiseQuotient(Vector2(sight.field.length, sight.field.width));
  } else if (view_.zoom <= 1.0) {
    view_.centre = {0.5, 0.5};
  }
  if (last_s_ >= 0.0 && now_s > last_s_) frame_s_ += 0.05 * (now_s - last_s_ - frame_s_);
  view_.shows_link = shows_figures_;
  view_.frames_per_s = 1.0 / frame_s_;
  ViewChoice choice = view_;
  if (wish_.kind == MatchWish::Kind::bots) choice.viewpoint = Viewpoint::side;
  return choice;
}

void Application::draw(Interface& interface, Renderer* renderer, const WindowSize& size, const Canvas& canvas, double now_s) {
  size_ = size;
  match_->advance(now_s);
  follow_phase();
  const MatchSight& sight = match_->sight();
  const bool is_behind_menu = wish_.kind == MatchWish::Kind::bots;
  if (surroundings_.sound && !is_behind_menu) surroundings_.sound(sight.noises, settings_);
  Picture picture = picture_of(sight, interest_overlay(sight, interest_), view(sight, now_s), static_cast<double>(size.width) / size.height);
  if (const auto* replay = dynamic_cast<const game::ReplayMatch*>(match_.get())) picture.texts.push_back(replay_line(*replay));
  if (is_behind_menu) {
    picture.texts.clear();
    picture.board.is_there = false;
    picture.dimming = 0.45f;
  } else if (menu_.screen() == Menu::Screen::settings) {
    picture.texts.clear();
    picture.dimming = 0.6f;
  }
  if (renderer != nullptr) renderer->draw(picture, canvas);
  interface.begin(size, last_s_ < 0.0 ? 0.0 : now_s - last_s_);
  last_s_ = now_s;
  interface.draw(picture);
  const MenuWish wish = menu_.draw(interface, settings_, sight);
  interface.finish(canvas);
  do_wish(wish);
}

}  // namespace rink::view
