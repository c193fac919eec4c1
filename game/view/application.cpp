// Keys to the match or to the menu, wishes to whoever can fulfil them, and a picture of it all.
#include "game/view/application.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "game/match/replay_match.h"
#include "game/view/overlays/zones_overlay.h"
#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

constexpr double click_reach = 8.0;  ///< pixels: so far the mouse may move in a click, and may miss

/// The own bat, what is asked of in a crowd, or else the puck.
const Thing* followed_by(const MatchSight& sight, const InterestChoice& interest) {
  if (!sight.own_team && sight.interest) return asked_thing(sight, interest);
  if (sight.own_thing) {
    const auto own = std::ranges::find(sight.things, *sight.own_thing, &Thing::id);
    if (own != sight.things.end()) return &*own;
  }
  const auto wanted = sight.own_team ? physics::BodyKind::bat : physics::BodyKind::puck;
  const auto found = std::ranges::find_if(sight.things, [&](const Thing& thing) {
    return thing.kind == wanted && (!sight.own_team || thing.team == *sight.own_team);
  });
  return found != sight.things.end() ? &*found : nullptr;
}

/// Where a replay is, how fast, and what its keys do.
Text replay_line(const game::ReplayMatch& replay) {
  char words[160];
  std::snprintf(
      words, sizeof words, "%s %.1f of %.1f s, speed %g     Space, Left, Right, Up, Down, Home",
      replay.is_paused() ? "stopped at" : "at", replay.sight().time, replay.end(), replay.speed());
  return {.words = words, .y = 0.895f, .size = 0.03f, .has_plate = true};
}

}  // namespace

Application::Application(Surroundings surroundings, const Settings& settings)
    : surroundings_(std::move(surroundings)), settings_(settings) {
  start({.kind = MatchWish::Kind::bots, .address = {}});
}

void Application::start(const MatchWish& wish) {
  std::unique_ptr<MatchSource> match = surroundings_.make_match(wish);
  held_.clear();
  match_ = std::move(match);
  wish_ = wish;
  view_ = {};
  phase_.reset();
  follows_ = is_told_ = false;
  interest_.is_shown = wish.kind != MatchWish::Kind::peer;  // who plays wants to see the game
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
  if (wish.kind == Kind::full_screen && surroundings_.set_full_screen)
    surroundings_.set_full_screen(settings_.is_full_screen);
  if ((wish.kind == Kind::full_screen || wish.kind == Kind::settings_changed) &&
      surroundings_.save_settings)
    surroundings_.save_settings(settings_);
}

EventQueue::Pace Application::pace() const {
  if (menu_.screen() == Menu::Screen::none) return EventQueue::Pace::play;
  return menu_.is_ready() ? EventQueue::Pace::menu : EventQueue::Pace::opening;
}

/// What this drawing is to see of what was done.
void Application::hear_events(Interface& interface) {
  using Kind = WindowEvent::Kind;
  events_.begin_frame();
  while (const std::optional<WindowEvent> event = events_.take(pace())) {
    interface.hear(*event);
    if (event->kind == Kind::close) wants_to_quit_ = true;
    else if (event->kind == Kind::key) hear_key(event->key, event->is_down);
    else if (event->kind == Kind::focus_lost) release_all();
    else if (menu_.screen() == Menu::Screen::none) hear_mouse(*event);
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

/// Two who share the keyboard see the table each from the own end, unless they chose a camera for
/// both.
bool Application::is_split() const {
  return settings_.is_split && !chosen_viewpoint_ && match_->hand_count() == 2 &&
         wish_.kind != MatchWish::Kind::bots;
}

void Application::set_split(bool is_wanted) {
  if (match_->hand_count() != 2) return;
  release_all();
  settings_.is_split = is_wanted;
  chosen_viewpoint_.reset();
  do_wish({MenuWish::Kind::settings_changed, {}});
}

/// Where the player `hand` of this keyboard sees the table from.
Viewpoint Application::viewpoint_of(std::uint32_t hand) const {
  if (!is_split()) return view_.viewpoint;
  return hand == 0 ? Viewpoint::left_end : Viewpoint::right_end;
}

/// Keys that steer the window; those of the bats come first.
bool Application::hear_command(KeyCode code) {
  if (hear_replay(code)) return true;
  switch (code) {
    case GLFW_KEY_TAB:
      ++interest_.chosen;
      interest_.picked.reset();
      return true;
    case GLFW_KEY_I:
      interest_.is_shown = !interest_.is_shown;
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
      chosen_viewpoint_ = is_split()
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
      shows_figures_ = !shows_figures_;
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

/// A recorded match: space stops it, left and right seek, up and down change its speed, home is its
/// start.
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

/// Seen from above: the wheel zooms, dragging moves what is seen, a click asks of what is there.
void Application::hear_mouse(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::scroll)
    view_.zoom = std::clamp(view_.zoom * std::pow(1.15, event.y), 1.0, 40.0);
  else if (event.kind == Kind::mouse_button && event.is_down)
    mouse_.is_dragging = true, mouse_.dragged = 0.0;
  else if (event.kind == Kind::mouse_button && std::exchange(mouse_.is_dragging, false) &&
           mouse_.dragged < click_reach)
    click();
  else if (event.kind == Kind::mouse_move) {
    if (mouse_.is_dragging) drag(event.x - mouse_.x, event.y - mouse_.y);
    mouse_.x = event.x, mouse_.y = event.y;
  }
}

/// The camera of the last frame.
Sight Application::seen() const {
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

/// One who plays alone may use either set of keys; each key means what it looks like from where the
/// player sees the table.
void Application::press(KeyCode code, const Bound& meaning) {
  const std::uint32_t hand = match_->hand_count() == 1 ? 0 : meaning.hand;
  const game::Key key = seen_from(viewpoint_of(hand), meaning.key);
  const bool was_down = std::ranges::any_of(
      held_, [&](const HeldKey& held) { return held.hand == hand && held.key == key; });
  held_.push_back({code, hand, key});
  if (!was_down) match_->press(hand, key, true);
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
  if (sight.phase == Phase::over && menu_.screen() == Menu::Screen::none &&
      match_->hand_count() > 0)
    menu_.open(Menu::Screen::over);
  else if (sight.phase != Phase::over && menu_.screen() == Menu::Screen::over)
    menu_.open(Menu::Screen::none);
  else if (sight.phase == Phase::paused && phase_ != Phase::paused && match_->hand_count() > 0 &&
           menu_.screen() == Menu::Screen::none)
    menu_.open(Menu::Screen::paused);
  else if (phase_ == Phase::paused && sight.phase != Phase::paused &&
           menu_.screen() == Menu::Screen::paused)
    menu_.open(Menu::Screen::none);  // somebody went on
  phase_ = sight.phase;
}

ViewChoice Application::view(const MatchSight& sight, double now_s) {
  if (chosen_viewpoint_) view_.viewpoint = *chosen_viewpoint_;
  else if (sight.own_team)
    view_.viewpoint =
        *sight.own_team == game::Team::left ? Viewpoint::left_end : Viewpoint::right_end;
  else view_.viewpoint = sight.things.size() > 60 ? Viewpoint::above : Viewpoint::side;
  if (follows_) {
    if (const Thing* followed = followed_by(sight, interest_))
      view_.centre =
          followed->position.cwiseQuotient(Vector2(sight.field.length, sight.field.width));
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

/// The whole window, or beside each other what each of two players sees.
void Application::draw_views(Interface& interface, Renderer* renderer, const Canvas& canvas,
                             double now_s) {
  const MatchSight& sight = match_->sight();
  const ViewChoice choice = view(sight, now_s);
  const bool is_behind_menu = wish_.kind == MatchWish::Kind::bots,
             has_settings = menu_.screen() == Menu::Screen::settings;
  const auto picture_from = [&](Viewpoint viewpoint, const Canvas& part) {
    ViewChoice there = choice;
    there.viewpoint = viewpoint;
    Picture picture = picture_of(
        sight,
        sight.zones ? zones_overlay(sight, interest_.is_shown) : interest_overlay(sight, interest_),
        there, static_cast<double>(part.width) / part.height);
    if (is_behind_menu) picture.board.is_there = false;
    if (renderer != nullptr) renderer->draw(picture, part);
    return picture;
  };
  const bool has_two = is_split();
  Picture words;
  if (has_two) {
    const int left = canvas.width / 2;
    picture_from(Viewpoint::right_end, {canvas.framebuffer, canvas.x + left, canvas.y,
                                        canvas.width - left, canvas.height});
    words = picture_from(Viewpoint::left_end,
                         {canvas.framebuffer, canvas.x, canvas.y, left, canvas.height});
  } else {
    words = picture_from(choice.viewpoint, canvas);
  }
  words.is_split = has_two;
  if (const auto* replay = dynamic_cast<const game::ReplayMatch*>(match_.get())) {
    words.texts.push_back(replay_line(*replay));
    if (!sight.notice.empty() && !std::exchange(is_told_, true) && surroundings_.tell)
      surroundings_.tell(wish_.address + ": " + sight.notice);
  }
  if (is_behind_menu || has_settings) {
    words.texts.clear();
    words.dimming = is_behind_menu ? 0.45f : 0.6f;
  }
  interface.draw(words);
}

void Application::draw(Interface& interface, Renderer* renderer, const WindowSize& size,
                       const Canvas& canvas, double now_s) {
  size_ = size;
  hear_events(interface);
  if (const Thing* asked = interest_.is_shown ? asked_thing(match_->sight(), interest_) : nullptr)
    match_->inspect(asked->id);
  match_->advance(now_s);
  follow_phase();
  if (surroundings_.sound && wish_.kind != MatchWish::Kind::bots)
    surroundings_.sound(match_->sight().noises, settings_);
  interface.begin(size, last_s_ < 0.0 ? 0.0 : now_s - last_s_);
  draw_views(interface, renderer, canvas, now_s);
  last_s_ = now_s;
  const MenuWish wish = menu_.draw(interface, settings_, match_->sight());
  interface.finish(canvas, renderer != nullptr);
  do_wish(wish);
}

}  // namespace rink::view
