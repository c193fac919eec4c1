// Which frame sees what a person did.
#include "game/view/window/event_queue.h"

#include <gtest/gtest.h>

#include <string>

namespace rink::view {
namespace {

using Kind = WindowEvent::Kind;
using Pace = EventQueue::Pace;

/// "a+" is key a going down, "a-" going up; "*+" and "*-" the mouse's button, "~" a move, "c" a
/// letter of a text.
void do_all(EventQueue& queue, const std::string& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const char letter = words[i];
    if (letter == '~') queue.push({.kind = Kind::mouse_move});
    else if (letter == 'c') queue.push({.kind = Kind::text, .character = 'c'});
    else
      queue.push({.kind = letter == '*' ? Kind::mouse_button : Kind::key,
                  .key = letter == '*' ? 0 : letter,
                  .is_down = words[++i] == '+'});
  }
}

/// What each frame sees, until nothing waits.
std::vector<std::string> frames_of(EventQueue& queue, Pace pace) {
  std::vector<std::string> frames;
  for (std::string seen = "some"; !seen.empty(); frames.push_back(seen)) {
    seen.clear();
    queue.begin_frame();
    while (const auto event = queue.take(pace)) {
      if (event->kind == Kind::mouse_move) seen += '~';
      else if (event->kind == Kind::text) seen += 'c';
      else
        seen += std::string(
                    1, event->kind == Kind::mouse_button ? '*' : static_cast<char>(event->key)) +
                (event->is_down ? '+' : '-');
    }
  }
  frames.pop_back();
  return frames;
}

std::vector<std::string> frames_of(const std::string& done, Pace pace) {
  EventQueue queue;
  do_all(queue, done);
  return frames_of(queue, pace);
}

using Frames = std::vector<std::string>;

TEST(EventQueue, ShowsATapWithinAFrameForOneFrame) {
  for (const Pace pace : {Pace::play, Pace::menu}) {
    EXPECT_EQ(frames_of("a+a-", pace), (Frames{"a+", "a-"}));
    EXPECT_EQ(frames_of("a+a-a+a-", pace), (Frames{"a+", "a-", "a+", "a-"}));
    EXPECT_EQ(frames_of("*+*-", pace), (Frames{"*+", "*-"}));
  }
}

TEST(EventQueue, DelaysNoKeyOfAChordInPlay) {
  EXPECT_EQ(frames_of("a+b+d-", Pace::play), (Frames{"a+b+d-"}));
  EXPECT_EQ(frames_of("a+b+a-b-", Pace::play), (Frames{"a+b+", "a-b-"}));
}

TEST(EventQueue, ShowsAMenuOnePressAfterTheOther) {
  EXPECT_EQ(frames_of("a+b+", Pace::menu), (Frames{"a+", "b+"}));
  EXPECT_EQ(frames_of("a+a-b+b-", Pace::menu), (Frames{"a+", "a-b+", "b-"}));
  EXPECT_EQ(frames_of("a+c~", Pace::menu), (Frames{"a+c~"})) << "letters and movements do not wait";
}

TEST(EventQueue, ClicksAMenuWhereTheMouseWas) {
  EXPECT_EQ(frames_of("~*+~*-", Pace::menu), (Frames{"~*+", "~*-"}));
}

TEST(EventQueue, HoldsPressesBackUntilAMenuIsReady) {
  EventQueue queue;
  do_all(queue, "a-~b+c");
  EXPECT_EQ(frames_of(queue, Pace::opening), (Frames{"a-~"}));
  EXPECT_EQ(frames_of(queue, Pace::menu), (Frames{"b+c"}));
}

}  // namespace
}  // namespace rink::view
