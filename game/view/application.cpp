// Starts and ends matches, carries out menu choices, and draws the window.
#include "game/view/application.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <utility>

#include "game/match/replay_match.h"
#include "game/view/overlays/zones_overlay.h"
#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

/// The thing that the camera follows: the own bat, the inspected thing in a crowd, or else the
/// puck.
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

/// A line with a replay's time, speed and keys.
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
  menu_.find_matches = surroundings_.find_matches;
  start({.kind = MatchWish::Kind::bots, .address = {}});
}

void Application::start(const MatchWish& wish) {
  assert(surroundings_.make_match && "who cannot make a match has nothing to show");
  std::unique_ptr<MatchSource> match = surroundings_.make_match(wish);
  assert(match != nullptr);
  held_.clear();
  feel_ = {};
  told_ = {};
  match_ = std::move(match);
  wish_ = wish;
  view_ = {};
  phase_.reset();
  follows_ = false;
  recorded_ = {};
  interest_.is_shown = wish.kind != MatchWish::Kind::peer;  // a player wants to see the game
}

void Application::play(const MatchWish& wish) {
  try {
    start(wish);
    menu_.open(Menu::Screen::none);
    if (wish.kind == MatchWish::Kind::join || wish.kind == MatchWish::Kind::watch) {
      remember_address(settings_, wish.address);
      do_wish({MenuWish::Kind::settings_noted, {}});
    }
  } catch (const std::exception& error) {
    explain(error.what(), wish);
  }
}

void Application::explain(const std::string& error, const std::optional<MatchWish>& again) {
  menu_.explain(error, again);
  if (surroundings_.notify) surroundings_.notify(error);
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
  if (wish.kind == Kind::settings_noted && surroundings_.remember_settings)
    surroundings_.remember_settings(settings_);
}

/// Two players at one keyboard see the table each from their own end, unless they chose a camera
/// for both.
bool Application::is_split() const {
  return settings_.is_split && !cameras_.chosen && match_->hand_count() == 2 &&
         wish_.kind != MatchWish::Kind::bots;
}

/// The viewpoint of the player `hand` of this keyboard.
Viewpoint Application::viewpoint_of(std::uint32_t hand) const {
  assert(hand < 2);
  if (!is_split()) return view_.viewpoint;
  return hand == 0 ? Viewpoint::left_end : Viewpoint::right_end;
}

void Application::set_paused(bool is_wanted) {
  release_all();
  if (is_wanted) use(Hint::pause);
  recorded_.bar.let_go();
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
    const MatchWish again = wish_;
    start({.kind = MatchWish::Kind::bots, .address = {}});
    return explain("The match cannot go on: " + why, again);
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
           (menu_.screen() == Menu::Screen::paused || menu_.screen() == Menu::Screen::help))
    menu_.open(Menu::Screen::none);  // a player resumed the match
  phase_ = sight.phase;
}

/// Whoever used a key once needs no hint of it.
void Application::use(Hint hint) {
  if (FirstMinute::use(hint, settings_)) do_wish({MenuWish::Kind::settings_noted, {}});
}

/// What a player of a match is told, over the picture.
void Application::tell(double now_s, Picture& words) {
  const MatchSight& sight = match_->sight();
  if (match_->hand_count() > 0) {
    if (told_.first.look(sight, now_s, settings_)) do_wish({MenuWish::Kind::settings_noted, {}});
    told_.first.add_to(sight, settings_, match_->hand_count() == 1, words);
  }
  if (settings_.is_best_of_three && match_->hand_count() > 0)
    told_.series.add_to(sight, palette_of(settings_.palette), words);
}

/// Whether effects that move are wanted.
bool Application::has_motion() const {
  return settings_.has_effects && !settings_.has_less_motion && !surroundings_.wants_less_motion;
}

void Application::Feel::look(const MatchSource& match, double elapsed_s) {
  const auto* recorded = dynamic_cast<const game::ReplayMatch*>(&match);
  const bool stands =
      match.sight().phase != Phase::playing || (recorded != nullptr && recorded->is_paused());
  if (!stands) clock_s += (recorded != nullptr ? recorded->speed() : 1.0) * elapsed_s;
  impacts.look(match.sight(), clock_s);
  if (recorded == nullptr) replay.look(match.sight(), clock_s);
}

ViewChoice Application::view(const MatchSight& sight, double now_s) {
  if (cameras_.chosen) view_.viewpoint = *cameras_.chosen;
  else if (sight.own_team)
    view_.viewpoint =
        *sight.own_team == game::Team::left ? Viewpoint::left_end : Viewpoint::right_end;
  else if (sight.things.size() > 60) view_.viewpoint = Viewpoint::above;
  else  // the table is twice as long as wide
    view_.viewpoint = size_.height > size_.width ? Viewpoint::left_end : Viewpoint::side;
  if (follows_) {
    if (const Thing* followed = followed_by(sight, interest_))
      view_.centre =
          followed->position.cwiseQuotient(Vector2(sight.field.length, sight.field.width));
  } else if (view_.zoom <= 1.0) {
    view_.centre = {0.5, 0.5};
  }
  assert(figures_.frame_s > 0.0);
  if (figures_.last_s >= 0.0 && now_s > figures_.last_s)
    figures_.frame_s += 0.05 * (now_s - figures_.last_s - figures_.frame_s);
  view_.palette = settings_.palette;
  view_.has_effects = has_motion();
  view_.shows_link = figures_.are_shown;
  view_.frames_per_s = 1.0 / figures_.frame_s;
  ViewChoice choice = view_;
  if (wish_.kind == MatchWish::Kind::bots && size_.height <= size_.width)
    choice.viewpoint = Viewpoint::side;
  return choice;
}

/// Draws the whole window, or the views of two players beside each other.
void Application::draw_views(Interface& interface, Renderer* renderer, const Canvas& canvas,
                             double now_s) {
  const MatchSight& sight = match_->sight();
  const ViewChoice choice = view(sight, now_s);
  const bool is_behind_menu = wish_.kind == MatchWish::Kind::bots,
             has_settings =
                 menu_.screen() == Menu::Screen::settings || menu_.screen() == Menu::Screen::help;
  Overlay overlay =
      sight.zones ? zones_overlay(sight, interest_.is_shown) : interest_overlay(sight, interest_);
  if (const auto* replay = dynamic_cast<const game::ReplayMatch*>(match_.get()))
    add_inputs(*replay, palette_of(settings_.palette), overlay);
  const auto picture_from = [&](Viewpoint viewpoint, const Canvas& part) {
    ViewChoice there = choice;
    there.viewpoint = viewpoint;
    Picture picture =
        picture_of(sight, overlay, there, static_cast<double>(part.width) / part.height);
    if (is_behind_menu) picture.board.is_there = false;
    else if (has_motion()) feel_.impacts.add_to(picture);
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
  if (!is_behind_menu) {
    tell(now_s, words);
    draw_goal_again(renderer, canvas, words);
  }
  add_hand_words(words, now_s);
  add_record(choice, static_cast<double>(canvas.width) / canvas.height, words);
  if (is_behind_menu || has_settings) {
    words.texts.clear();
    words.panels.clear();
    words.dimming = is_behind_menu ? 0.45f : 0.6f;
  }
  interface.draw(words);
}

/// Of a recorded match: time, bar and speeds, and once whether it is the game that was recorded.
void Application::add_record(const ViewChoice& choice, double aspect, Picture& words) {
  const auto* replay = dynamic_cast<const game::ReplayMatch*>(match_.get());
  if (replay == nullptr) return;
  recorded_.bar.look(*replay);
  for (Text& text : words.texts)
    if (text.words == replay->sight().notice) text.y = 0.84f;  // above the bar
  recorded_.bar.add_to(*replay, palette_of(settings_.palette), words);
  add_speeds(replay->sight(), choice, aspect, words);
  words.texts.push_back(replay_line(*replay));
  const std::string& notice = replay->sight().notice;
  if (!notice.empty() && !std::exchange(recorded_.is_told, true) && surroundings_.notify)
    surroundings_.notify(wish_.address + ": " + notice);
}

/// A goal of a player's own match, in the upper left corner: the match goes on beside it.
void Application::draw_goal_again(Renderer* renderer, const Canvas& canvas, Picture& words) {
  if (!feel_.shows_goal(*match_, menu_)) return;
  const MatchSight* sight = feel_.replay.shown();
  constexpr float left = 0.02f, top = 0.09f, part = 0.3f;
  const int width = static_cast<int>(part * static_cast<float>(canvas.width)),
            height = std::min(width * 9 / 16, canvas.height / 3),
            x = static_cast<int>(left * static_cast<float>(canvas.width)),
            y = canvas.height - static_cast<int>(top * static_cast<float>(canvas.height)) - height;
  Picture picture =
      picture_of(*sight, {}, {.palette = settings_.palette}, static_cast<double>(width) / height);
  picture.board.is_there = false;
  if (renderer != nullptr)
    renderer->draw(picture, {canvas.framebuffer, canvas.x + x, canvas.y + y, width, height});
  const auto of_width = [&](int pixels) {
    return static_cast<float>(pixels) / static_cast<float>(canvas.width);
  };
  const auto of_height = [&](int pixels) {
    return static_cast<float>(pixels) / static_cast<float>(canvas.height);
  };
  words.panels.push_back({.x = of_width(x),
                          .y = top,
                          .width = of_width(width),
                          .height = of_height(height),
                          .outline = {0.93f, 0.95f, 0.99f, 0.8f}});
  const bool can_skip = !bound(settings_, GLFW_KEY_SPACE);
  words.texts.push_back({.words = can_skip ? "the goal again   Space: skip" : "the goal again",
                         .x = of_width(x + width / 2),
                         .y = top + of_height(height) + 0.025f,
                         .size = 0.026f,
                         .has_plate = true});
}

void Application::draw(Interface& interface, Renderer* renderer, const WindowSize& size,
                       const Canvas& canvas, double now_s) {
  assert((figures_.last_s < 0.0 || now_s >= figures_.last_s) && "real time never falls");
  size_ = size;
  hear_events(interface);
  if (const Thing* asked = interest_.is_shown ? asked_thing(match_->sight(), interest_) : nullptr)
    match_->inspect(asked->id);
  move_hand();
  match_->advance(now_s);
  follow_phase();
  if (match_->hand_count() > 0) told_.series.look(match_->sight());
  if (has_motion() && wish_.kind != MatchWish::Kind::bots)
    feel_.look(*match_, figures_.last_s < 0.0 ? 0.0 : now_s - figures_.last_s);
  else feel_ = {};
  if (surroundings_.sound)  // behind the menu too, where music goes on and its volume changes
    surroundings_.sound(
        wish_.kind == MatchWish::Kind::bots ? std::vector<Noise>{} : match_->sight().noises,
        settings_);
  interface.begin(size, figures_.last_s < 0.0 ? 0.0 : now_s - figures_.last_s);
  draw_views(interface, renderer, canvas, now_s);
  figures_.last_s = now_s;
  const MenuWish wish = menu_.draw(interface, settings_, match_->sight());
  interface.finish(canvas, renderer != nullptr);
  do_wish(wish);
}

}  // namespace rink::view
