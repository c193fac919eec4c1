// The screens between matches: what to play, settings, pause, the end of a match. They say what the
// player wishes; somebody else does it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/view/interface.h"
#include "game/view/match_source.h"
#include "game/view/settings.h"

namespace rink::view {

/// What to play.
struct MatchWish {
  enum class Kind : std::uint8_t { two, bot, host, join, watch, replay, peer, bots };
  Kind kind = Kind::two;
  std::string strength = "club";  ///< of a bot: one of bot_strengths
  std::string address{};  ///< HOST:PORT of join and watch, PORT of host, the file of a replay,
                          ///< HOST:PORT of a peer that is there or nothing
};

inline constexpr std::array<const char*, 3> bot_strengths{"beginner", "club", "expert"};

/// What was chosen in a frame.
struct MenuWish {
  enum class Kind : std::uint8_t {
    nothing,
    play,
    resume,
    rematch,
    leave,
    quit,
    settings_changed,
    full_screen
  };
  Kind kind = Kind::nothing;
  MatchWish match;
};

class Menu {
 public:
  enum class Screen : std::uint8_t { none, main, bot, host, join, watch, settings, paused, over };

  Screen screen() const { return screen_; }
  /// Whether the screen has been drawn so often that its first button has the focus: a key before
  /// that would go nowhere.
  bool is_ready() const { return drawn_ >= 2; }
  void open(Screen screen);
  /// Back to the main menu with what went wrong.
  void explain(const std::string& error);
  /// Also shown there, until something is chosen.
  const std::string& error() const { return error_; }

  /// True if the key was taken: to be bound, or to go back. Down only.
  bool take_key(KeyCode code, Settings& settings, MenuWish& wish);

  /// Between Interface::begin and finish. Changes `settings` as the player wants.
  MenuWish draw(const Interface& interface, Settings& settings, const MatchSight& sight);

 private:
  struct Binding {
    std::size_t hand;
    std::size_t key;
  };
  bool button(const char* words);
  void begin_panel(const char* name, float width, float middle) const;
  void draw_main(MenuWish& wish);
  void draw_bot(MenuWish& wish);
  void draw_address(MenuWish& wish, MatchWish::Kind kind, const char* title, const char* hint,
                    const char* verb);
  void draw_settings(Settings& settings, MenuWish& wish);
  void draw_keys(Settings& settings);
  void draw_paused(MenuWish& wish);
  void draw_over(MenuWish& wish, const MatchSight& sight);
  void draw_title() const;
  void draw_error() const;

  Screen screen_ = Screen::main, back_ = Screen::main;
  std::string error_;
  std::string address_ = "127.0.0.1:4711", port_ = "4711";
  std::optional<Binding> binding_;
  bool is_fresh_ = true;  ///< the first widget of this screen is to have the focus
  unsigned drawn_ = 0;    ///< how often, since this screen was opened
  float unit_ = 1.0f;
  const Interface* interface_ = nullptr;
};

}  // namespace rink::view
