// rink play: the window, its clock, and the matches that the player starts.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <thread>
#include <utility>

#include "game/apps/command.h"
#include "game/apps/play_flags.h"
#include "game/apps/play_matches.h"
#include "game/net/discovery/match_search.h"
#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/version/version.h"
#include "game/view/application.h"
#include "game/view/feel/less_motion.h"
#include "game/view/film/picture_sequence.h"
#include "game/view/render/image_file.h"
#include "game/view/render/offscreen.h"
#include "game/view/script.h"
#include "game/view/sounds.h"
#include "game/view/window/window.h"

namespace {

using namespace rink;
using view::MatchWish;

constexpr double offscreen_frame_s = 1.0 / 60.0;

using game::now_s;

void notify(const std::string& problem) { game::complain(problem); }

/// The application with its resources of the process: settings on disk, sound, standard error.
class Process {
 public:
  explicit Process(const view::PlayOptions& options)
      : options_(options),
        settings_file_(options.settings_file.empty() ? view::settings_file()
                                                     : options.settings_file) {
    view::ReadSettings read = view::read_settings(settings_file_);
    settings_ = kept_ = read.settings;
    is_misread_ = !read.errors.empty();
    if (options.is_muted) settings_.is_muted = true;
    if (options.is_full_screen) settings_.is_full_screen = true;
    if (const auto control = view::control_from_name(options.control)) settings_.control = *control;
    for (const std::string& problem : read.errors)
      errors_ += (errors_.empty() ? "" : "\n") + problem;
    shown_ = settings_;
    if (!options.script.empty()) script_ = view::read_script(options.script);
    if (!options.screenshot.empty()) {
      script_.push_back({.time = options.at_s, .events = {}, .picture = options.screenshot});
      script_.push_back({.time = options.at_s, .events = {}, .picture = {}, .is_end = true});
    }
  }

  /// As large as it was when it was closed last.
  void run_in_window();
  /// The same with another size.
  void run_in_window(const view::WindowSize& size);
  void run_offscreen(const view::WindowSize& size);

 private:
  /// The renderer must be destroyed before its context.
  class Opened {
   public:
    Opened(Process& process, view::Window* window) : process_(process) {
      try {
        process.open(window);
      } catch (...) {
        process.close();
        throw;
      }
    }
    ~Opened() { process_.close(); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

   private:
    Process& process_;
  };

  void open(view::Window* window);
  void close();
  void picture(const std::string& file, GLuint framebuffer, const view::WindowSize& size) const {
    view::write_png(file, view::read_pixels(framebuffer, size.width, size.height));
  }
  void draw(const view::WindowSize& size, GLuint framebuffer, double now, bool is_seen);
  void listen(view::Window& window);
  void await_frame(view::Window& window, double begin_s);
  void save(const view::Settings& settings);
  void remember(const view::Settings& settings);

  view::PlayOptions options_;
  std::string settings_file_, errors_;
  bool is_misread_ = false;  ///< the settings' file has unknown content
  view::Settings settings_;  ///< those of the file under the flags
  view::Settings kept_;      ///< those of the file
  view::Settings shown_;     ///< those that were saved last, under the flags
  std::vector<view::ScriptStep> script_;
  std::size_t next_step_ = 0;
  view::FramePace pace_{options_.frame_limit};
  std::unique_ptr<game::MatchSearch> search_;  ///< once somebody looked for a match
  std::unique_ptr<view::Sounds> sounds_;
  std::unique_ptr<view::Interface> interface_;
  std::unique_ptr<view::Renderer> renderer_;
  std::unique_ptr<view::Application> application_;
};

void Process::open(view::Window* window) {
  interface_ = std::make_unique<view::Interface>();
  view::Surroundings surroundings;
  surroundings.make_match = [this](const MatchWish& wish) {
    return view::make_match(wish, options_);
  };
  surroundings.notify = notify;
  if (options_.is_discovered)
    surroundings.find_matches = [this] {
      if (!search_)
        search_ = std::make_unique<game::MatchSearch>(game::discovery_group(), [] {
          std::random_device random;
          return std::uint64_t{random()} << 32 | random();
        });
      search_->search(now_s());
      return search_->found();
    };
  surroundings.wants_less_motion = view::wants_less_motion(view::desktop_settings_folder());
  if (window != nullptr) {
    sounds_ = std::make_unique<view::Sounds>();
    surroundings.set_full_screen = [window](bool is_wanted) { window->set_full_screen(is_wanted); };
    surroundings.sound = [this](const std::vector<view::Noise>& noises,
                                const view::Settings& settings) {
      sounds_->play(noises, {.volume = settings.is_muted ? 0.0 : settings.volume,
                             .has_horn = settings.has_effects,
                             .has_music = settings.has_music && settings.has_effects});
    };
  }
  surroundings.save_settings = [this](const view::Settings& settings) { save(settings); };
  surroundings.remember_settings = [this](const view::Settings& settings) { remember(settings); };
  application_ = std::make_unique<view::Application>(std::move(surroundings), settings_);
  if (const auto viewpoint = view::viewpoint_of(options_)) application_->set_viewpoint(*viewpoint);
  if (options_.shows_figures) application_->show_figures();
  if (!errors_.empty()) application_->explain(errors_);
  if (const auto wish = view::wish_of(options_)) application_->play(*wish);
}

/// What flags said is kept only if the player changes it: they are for one run.
void Process::save(const view::Settings& settings) {
  kept_ = view::with_changes(kept_, shown_, settings);
  shown_ = settings;
  if (std::exchange(is_misread_, false))
    if (const auto place = view::set_settings_aside(settings_file_)) notify(*place);
  if (const auto problem = view::write_settings(kept_, settings_file_)) notify(*problem);
}

/// Not in a run by a script, nor over a file with content that is not understood: both wait until
/// the player changes a setting.
void Process::remember(const view::Settings& settings) {
  if (script_.empty() && !is_misread_) save(settings);
}

void Process::draw(const view::WindowSize& size, GLuint framebuffer, double now, bool is_seen) {
  if (is_seen && !renderer_)
    renderer_ = std::make_unique<view::Renderer>();  // half a second in software, for which a
                                                     // script that takes no picture does not wait
  application_->draw(*interface_, is_seen ? renderer_.get() : nullptr, size,
                     {framebuffer, 0, 0, size.width, size.height}, now);
}

void Process::run_in_window() {
  run_in_window({settings_.window.width, settings_.window.height, 1.0});
}

void Process::listen(view::Window& window) {
  for (const view::WindowEvent& event : window.events()) {
    application_->receive(event);
    pace_.touched(now_s());
  }
}

/// A menu that rests listens all the same, and draws as soon as it is touched.
void Process::await_frame(view::Window& window, double begin_s) {
  const bool is_in_menu = application_->is_in_menu(), rests = pace_.rests(is_in_menu, begin_s),
             is_scripted = next_step_ < script_.size();
  const double due_s = pace_.due_s(is_in_menu && !is_scripted, begin_s);
  for (double left_s = due_s - now_s(); left_s > 0.0; left_s = due_s - now_s()) {
    const double nap_s = rests ? std::min(left_s, view::FramePace::listening_period_s) : left_s;
    std::this_thread::sleep_for(std::chrono::duration<double>(nap_s));
    if (!rests) continue;
    listen(window);
    if (!pace_.rests(is_in_menu, begin_s) || game::is_interrupted) return;
  }
}

/// At one instant keys come first, then the frame, then its picture.
void Process::run_in_window(const view::WindowSize& size) {
  view::Window window("Rink", size.width, size.height, settings_.is_full_screen);
  const Opened opened(*this, &window);
  const double start_s = now_s();
  pace_.touched(start_s);
  bool is_ended = false;
  while (!application_->wants_to_quit() && !is_ended && !game::is_interrupted) {
    const double begin_s = now_s();
    listen(window);
    const auto due = view::due_steps(script_, next_step_, begin_s - start_s);
    for (const view::ScriptStep& step : due)
      for (const view::WindowEvent& event : step.events) application_->receive(event);
    // A window that is too small to be seen still runs: a match over a network must not fall
    // silent.
    const view::WindowSize now_size = window.size();
    const bool is_seen = now_size.width > 0 && now_size.height > 0;
    if (is_seen && !window.is_full_screen()) application_->remember_window(window.points());
    draw(is_seen ? now_size : size, 0, begin_s, is_seen);
    if (is_seen) {
      for (const view::ScriptStep& step : due)
        if (!step.picture.empty()) picture(step.picture, 0, now_size);
    }
    for (const view::ScriptStep& step : due) is_ended = is_ended || step.is_end;
    window.show();
    await_frame(window, begin_s);
  }
  if (options_.given.count("--size") == 0 && application_->settings().window != settings_.window)
    remember(application_->settings());
}

/// Time is counted in frames, so the same script gives the same pictures; frames of which no
/// picture is taken are not drawn. A match over a network runs in real time.
void Process::run_offscreen(const view::WindowSize& size) {
  const view::OffscreenContext context;
  const Opened opened(*this, nullptr);
  const view::Target target(size.width, size.height, 0);
  const double start_s = now_s();
  const bool is_shared = !options_.host.empty() || !options_.join.empty() ||
                         !options_.watch.empty() || !options_.peer.empty() ||
                         !options_.peer_listen.empty();
  bool is_ended = false;
  for (std::uint64_t frame = 0; !application_->wants_to_quit() && !is_ended &&
                                !game::is_interrupted && next_step_ < script_.size();
       ++frame) {
    const double now = static_cast<double>(frame) * offscreen_frame_s;
    if (is_shared && start_s + now > now_s())
      std::this_thread::sleep_for(std::chrono::duration<double>(start_s + now - now_s()));
    const auto due = view::due_steps(script_, next_step_, now);
    bool is_seen = false;
    for (const view::ScriptStep& step : due) {
      for (const view::WindowEvent& event : step.events) application_->receive(event);
      is_seen = is_seen || !step.picture.empty();
      is_ended = is_ended || step.is_end;
    }
    draw(size, target.framebuffer(), now, is_seen);
    if (is_seen) do
        draw(size, target.framebuffer(), now,
             true);  // the first may be drawn as of a camera that moves
      while (!renderer_->is_settled());
    for (const view::ScriptStep& step : due)
      if (!step.picture.empty()) picture(step.picture, target.framebuffer(), size);
  }
}

void Process::close() {
  application_.reset();
  renderer_.reset();
  interface_.reset();
  sounds_.reset();
}

/// As the settings and --camera would show the replay.
game::ExitStatus film(const view::PlayOptions& options, const view::WindowSize& size) {
  const view::Settings settings =
      view::read_settings(options.settings_file.empty() ? view::settings_file()
                                                        : options.settings_file)
          .settings;
  const auto camera = view::viewpoint_of(options);
  const view::OffscreenContext context;
  const std::size_t count = view::write_pictures(
      {.record = options.replay,
       .folder = options.pictures,
       .frames_per_s = options.picture_rate,
       .size = size,
       .view = {.viewpoint = camera.value_or(view::Viewpoint::side),
                .palette = settings.palette,
                .has_effects = settings.has_effects && !settings.has_less_motion}});
  std::printf("%zu pictures, %g for each second of the match, in %s\n", count, options.picture_rate,
              options.pictures.c_str());
  return game::is_interrupted ? game::ExitStatus::interrupted : game::ExitStatus::ok;
}

game::ExitStatus play(const view::PlayOptions& options) {
  const auto size = view::size_of(options.size);
  if (!size)
    throw game::FlagError("--size",
                          options.size + " is not a size like 1280x720, from 320x240 to 8192x8192");
  if (options.is_offscreen && options.script.empty() && options.screenshot.empty())
    throw game::FlagError("--offscreen",
                          "nobody could see it or press a key; give a --script or a --screenshot");
  if (!options.pictures.empty()) return film(options, *size);
  Process process(options);
  if (options.is_offscreen) process.run_offscreen(*size);
  else if (options.given.count("--size") != 0) process.run_in_window(*size);
  else process.run_in_window();
  return game::is_interrupted ? game::ExitStatus::interrupted : game::ExitStatus::ok;
}

int status_of(const std::exception& error) {
  using game::ExitStatus;
  if (dynamic_cast<const view::NoDisplay*>(&error) != nullptr ||
      dynamic_cast<const view::GraphicsError*>(&error) != nullptr)
    return static_cast<int>(ExitStatus::no_display);
  return static_cast<int>(dynamic_cast<const view::ScriptError*>(&error) != nullptr
                              ? ExitStatus::bad_input
                              : ExitStatus::failed);
}

}  // namespace

int main(int count, char** words) {
  game::speak_as("rink play");
  game::Flags flags("Play air hockey in a window. Without arguments it opens a menu.", "rink play");
  flags.version(game::version_line("rink-play"));
  view::PlayOptions options;
  view::add_options(flags, options);
  flags.footer(
      "Example: rink play --bot club\n"
      "Keys: W A S D and the arrows move the bats (or --control pointer, gamepad), Esc pauses, C "
      "changes the camera, V splits the "
      "screen for two, + and - zoom and F follows from above, M mutes,\n"
      "F1 shows all keys, F3 figures, F11 fills the screen.\n"
      "Exit status: 0 done, 1 failed, 2 bad flag or file, 18 no display, 130 interrupted. A match "
      "that ends with an error is reported in the menu and on standard error.");
  return game::run_command(flags, count, words,
                           {.run =
                                [&] {
                                  options.given = flags.given();
                                  return static_cast<int>(play(options));
                                },
                            .status_of = status_of});
}
