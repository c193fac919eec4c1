// What tests against golden images share: a match that stands still, and the comparison.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "game/view/application.h"
#include "game/view/render/image_file.h"
#include "tests/places.h"
#include "tests/view/offscreen_test.h"
#include "tests/view/sights.h"
#include "tests/view/tiles.h"

namespace rink::view {

/// A match of which the test says how it looks.
class StillMatch final : public MatchSource {
 public:
  explicit StillMatch(const MatchSight& sight) : sight_(sight) {}
  void advance(double) override {}
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return sight_.own_team ? 1 : 2; }
  void press(std::uint32_t, game::Key, bool) override {}
  void pause(bool is_wanted) override { sight_.phase = is_wanted ? Phase::paused : Phase::playing; }
  void rematch() override { sight_.wants_rematch = true; }

 private:
  MatchSight sight_;
};

/// All tests share what takes long to make, compiled shaders too.
class GoldenImages : public OffscreenTest {
 protected:
  static void SetUpTestSuite() {
    OffscreenTest::SetUpTestSuite();
    if (!can_draw()) return;
    interface_ = std::make_unique<Interface>();
    renderer_ = std::make_unique<Renderer>();
  }
  static void TearDownTestSuite() {
    renderer_.reset();
    interface_.reset();
    OffscreenTest::TearDownTestSuite();
  }
  void SetUp() override {
    OffscreenTest::SetUp();
    if (IsSkipped()) return;
    resize({480, 270, 1.0});
    open(match_sight());
  }

  void resize(const WindowSize& size) {
    size_ = size;
    target_ = Target(size.width, size.height, 0);
  }
  void open(const MatchSight& sight, const Settings& settings = shared_camera()) {
    application_ = std::make_unique<Application>(
        Surroundings{.make_match =
                         [sight](const MatchWish&) { return std::make_unique<StillMatch>(sight); }},
        settings);
  }
  void play(const MatchSight& sight, const Settings& settings = shared_camera()) {
    open(sight, settings);
    application_->play({.kind = MatchWish::Kind::two, .address = {}});
  }
  /// Of a player who needs no hints.
  static Settings known() {
    Settings settings;
    settings.hints_seen.fill(true);
    return settings;
  }
  static Settings shared_camera() {
    Settings settings = known();
    settings.is_split = false;
    return settings;
  }

  void frame(bool is_seen = true) {
    application_->draw(*interface_, is_seen ? renderer_.get() : nullptr, size_,
                       {target_.framebuffer(), 0, 0, size_.width, size_.height},
                       still_ ? now_ : now_ += 1.0 / 60.0);
  }
  void tap(const char* key) {
    for (const bool is_down : {true, false}) {
      receive({.kind = WindowEvent::Kind::key,
               .key = key_code_from_name(key).value(),
               .is_down = is_down});
      for (int i = 0; i < 3; ++i) frame(false);
    }
  }
  void receive(const WindowEvent& event) { application_->receive(event); }
  /// Down and up before anything is drawn, as a person's tap is where a frame takes long.
  void tap_within_a_frame(const char* key) {
    for (const bool is_down : {true, false})
      receive({.kind = WindowEvent::Kind::key,
               .key = key_code_from_name(key).value(),
               .is_down = is_down});
  }

  /// Other drivers round and sample otherwise: an edge here and there may differ, not a place or a
  /// colour.
  void expect_golden(const std::string& name) {
    frame(false), frame(false);
    do
      frame();  // the first after a cut may be drawn as of a camera that moves, and what stands
                // still becomes smooth by and by
    while (!renderer_->is_settled());
    frame();
    const Image seen = read_pixels(target_.framebuffer(), size_.width, size_.height);
    const std::string golden = test::source_folder() + "/tests/view/golden/" + name + ".png";
    if (std::getenv("RINK_RENEW_GOLDEN") != nullptr) return write_png(golden, seen);
    const Image wanted = std::filesystem::exists(golden) ? read_png(golden) : Image{};
    const Difference apart = difference(seen, wanted);
    const Tile worst = worst_tile(seen, wanted);
    if (apart.mean < 1.5 && apart.part_above_32 < 0.01 && worst.is_alike()) return;
    const std::string folder = test::binary_folder() + "/golden-images-that-differ/";
    std::filesystem::create_directories(folder);
    write_png(folder + name + ".actual.png", seen);
    write_png(folder + name + ".difference.png", difference_image(seen, wanted));
    ADD_FAILURE() << name << ": mean difference " << apart.mean
                  << " (below 1.5), part of the pixels off by more than 32 is "
                  << apart.part_above_32 << " (below 0.01), in the worst tile " << worst
                  << "\nis      " << folder << name << ".actual.png\nmust be " << golden
                  << "\napart   " << folder << name << ".difference.png";
  }

  static inline std::unique_ptr<Interface> interface_;
  static inline std::unique_ptr<Renderer> renderer_;
  WindowSize size_;
  Target target_;
  std::unique_ptr<Application> application_;
  double now_ = 10.0;
  bool still_ = false;  ///< all frames are of one instant
};

}  // namespace rink::view
