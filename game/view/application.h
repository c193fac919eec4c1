// The application in a window: menus, matches, keys. Knows no window, no clock and no OpenGL
// context of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/view/feel/goal_replay.h"
#include "game/view/feel/impact_effects.h"
#include "game/view/first_minute.h"
#include "game/view/hand_control.h"
#include "game/view/interface.h"
#include "game/view/match_source.h"
#include "game/view/menu.h"
#include "game/view/overlays/interest_overlay.h"
#include "game/view/overlays/replay_view.h"
#include "game/view/picture_of.h"
#include "game/view/settings.h"
#include "game/view/window/event_queue.h"

namespace rink::view {

/// Services that the application needs from its process. Every function may be empty but
/// `make_match`.
struct Surroundings {
  std::function<std::unique_ptr<MatchSource>(const MatchWish&)>
      make_match{};  ///< throws std::exception with a text for the player
  std::function<void(bool)> set_full_screen{};
  std::function<void(const Settings&)> save_settings{};      ///< the player changed one
  std::function<void(const Settings&)> remember_settings{};  ///< they changed unasked
  std::function<std::vector<game::FoundMatch>()>
      find_matches{};  ///< on the local network; called while a player looks for one
  std::function<void(const std::vector<Noise>&, const Settings&)> sound{};
  std::function<void(const std::string&)> notify{};  ///< troubles, for the standard error
  bool wants_less_motion = false;                    ///< the desktop says so
};

class Application {
 public:
  Application(Surroundings surroundings, const Settings& settings);

  /// Starts a match instead of showing the menu; once it ends the menu is shown, with an error if
  /// there was one.
  void play(const MatchWish& wish);
  /// Shows an error in the menu, which offers to try `again`, and reports it.
  void explain(const std::string& error, const std::optional<MatchWish>& again = std::nullopt);
  void set_viewpoint(Viewpoint viewpoint) { cameras_.chosen = viewpoint; }

  void show_figures() { figures_.are_shown = true; }

  /// Takes effect at the next drawing or a later one, so that each press is visible in one drawing
  /// at least (event_queue.h).
  void receive(const WindowEvent& event) { events_.push(event); }
  /// Draws the instant `now_s` [s], which never falls; an Interface, and so a context of OpenGL,
  /// must exist. Without a renderer nothing is drawn.
  void draw(Interface& interface, Renderer* renderer, const WindowSize& size, const Canvas& canvas,
            double now_s);

  /// The window has this size, which fills no screen; kept with the settings.
  void remember_window(const WindowPoints& window) { settings_.window = window; }
  const Settings& settings() const { return settings_; }

  bool wants_to_quit() const { return wants_to_quit_; }
  /// True once a match that was started by play() is over or gone.
  bool is_in_menu() const { return wish_.kind == MatchWish::Kind::bots; }
  const MatchSight& sight() const { return match_->sight(); }

 private:
  struct HeldKey {
    KeyCode code;
    std::uint32_t hand;
    game::Key key;
  };

  struct Mouse {
    double x = 0.0, y = 0.0, dragged = 0.0;  ///< pixels
    bool is_dragging = false;
  };

  struct Figures {
    bool are_shown = false;
    double last_s = -1.0, frame_s = 1.0 / 60.0;  ///< the last frame, and how long one takes
  };

  struct Told {
    FirstMinute first;
    Series series;
  };

  struct Cameras {
    std::optional<Viewpoint> chosen, before_split;  ///< the latter when two views were asked for
  };

  struct Feel {
    ImpactEffects impacts;
    GoalReplay replay;
    double clock_s = 0.0;  ///< stands where the match stands, and goes at a replay's speed

    /// Takes up the match's sight, `elapsed_s` [s] after the last one.
    void look(const MatchSource& match, double elapsed_s);
    /// Not beside a menu, which hears the space bar too, nor beside who has won.
    bool shows_goal(const MatchSource& match, const Menu& menu) const {
      return replay.shown() != nullptr && match.hand_count() == 1 &&
             menu.screen() == Menu::Screen::none && match.sight().phase != Phase::over;
    }
  };

  // application.cpp
  void start(const MatchWish& wish);
  void do_wish(const MenuWish& wish);
  void set_paused(bool is_wanted);
  bool is_split() const;
  Viewpoint viewpoint_of(std::uint32_t hand) const;
  void draw_views(Interface& interface, Renderer* renderer, const Canvas& canvas, double now_s);
  void follow_phase();
  ViewChoice view(const MatchSight& sight, double now_s);
  bool has_motion() const;
  void use(Hint hint);
  void tell(double now_s, Picture& words);
  void add_record(const ViewChoice& choice, double aspect, Picture& words);
  void draw_goal_again(Renderer* renderer, const Canvas& canvas, Picture& words);

  // application_input.cpp
  EventQueue::Pace pace() const;
  void hear_events(Interface& interface);
  void hear_key(KeyCode code, bool is_down);
  bool hear_command(KeyCode code);
  bool hear_replay(KeyCode code);
  void hear_mouse(const WindowEvent& event);
  void press(KeyCode code, const Bound& bound);
  void release(KeyCode code);
  void release_all();
  void set_split(bool is_wanted);
  Sight seen() const;
  Vector2 under_pointer() const;
  void move_hand();
  void add_hand_words(Picture& picture, double now_s);
  void drag(double across, double down);
  void click();

  Surroundings surroundings_;
  Settings settings_;
  Menu menu_;
  EventQueue events_;
  MatchWish wish_;
  std::unique_ptr<MatchSource> match_;
  std::vector<HeldKey> held_;
  Cameras cameras_;
  ViewChoice view_;
  InterestChoice interest_;
  std::optional<Phase> phase_;  ///< of the last frame
  bool follows_ = false;
  struct Recorded {
    bool is_told = false;  ///< whether its result was reported
    ReplayBar bar;
  };
  Recorded recorded_;
  Mouse mouse_;
  HandControl hand_;
  WindowSize size_;
  Figures figures_;
  Feel feel_;
  Told told_;
  bool wants_to_quit_ = false;
};

}  // namespace rink::view
