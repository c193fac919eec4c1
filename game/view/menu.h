// The screens between matches: what to play, settings, pause, the end of a match. They report the
// player's choice; the application carries it out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "game/net/discovery/match_search.h"
#include "game/view/interface.h"
#include "game/view/match_source.h"
#include "game/view/settings.h"

namespace rink::view {

/// The match to play.
struct MatchWish {
  enum class Kind : std::uint8_t { two, bot, host, join, watch, replay, peer, bots };
  Kind kind = Kind::two;
  std::string strength = "club";  ///< of a bot: one of bot_strengths
  std::string address{};  ///< HOST:PORT of join and watch, PORT of host, the file of a replay,
                          ///< HOST:PORT of a running peer or empty
};

inline constexpr std::array<const char*, 3> bot_strengths{"beginner", "club", "expert"};

/// The choice in a frame.
struct MenuWish {
  enum class Kind : std::uint8_t {
    nothing,
    play,
    resume,
    rematch,
    leave,
    quit,
    settings_changed,
    settings_noted,  ///< unasked
    full_screen
  };
  Kind kind = Kind::nothing;
  MatchWish match;
};

class Menu {
 public:
  enum class Screen : std::uint8_t {
    none,
    main,
    bot,
    host,
    join,
    watch,
    settings,
    paused,
    over,
    help
  };

  /// The matches of the local network, asked for while a player looks for one; may be empty.
  std::function<std::vector<game::FoundMatch>()> find_matches{};

  Screen screen() const { return screen_; }
  /// True if the screen has been drawn often enough for its first button to have the focus: earlier
  /// keys would be lost.
  bool is_ready() const { return drawn_ >= 2; }
  void open(Screen screen);
  /// Returns to the main menu with an error, and offers to try `again` what failed, if anything.
  void explain(const std::string& error, const std::optional<MatchWish>& again = std::nullopt);
  /// The error there, shown until something is chosen.
  const std::string& error() const { return error_; }

  /// True if the key was used: for a binding, or to go back. Only for keys that go down.
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
  void draw_address(MenuWish& wish, MatchWish::Kind kind, const Settings& settings);
  void draw_places(MenuWish& wish, MatchWish::Kind kind, const Settings& settings);
  void draw_settings(Settings& settings, MenuWish& wish);
  void draw_keys(Settings& settings);
  void draw_control(Settings& settings) const;
  void draw_paused(MenuWish& wish);
  void draw_over(MenuWish& wish, const MatchSight& sight);
  void draw_help(const Settings& settings);
  void draw_title(const Palette& palette) const;
  void draw_error() const;

  Screen screen_ = Screen::main, back_ = Screen::main, help_back_ = Screen::main;
  std::string error_;
  std::optional<MatchWish> again_;  ///< while the error is shown
  std::string address_ = "127.0.0.1:4711", port_ = "4711";
  std::optional<Binding> binding_;
  bool is_fresh_ = true;  ///< the first widget of this screen is to have the focus
  unsigned drawn_ = 0;    ///< how often, since this screen was opened
  float unit_ = 1.0f;
  const Interface* interface_ = nullptr;
};

}  // namespace rink::view
