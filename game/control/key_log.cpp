// Writes numbers as the shortest way back to their bits allows, and reads line by line so that an error can name its line.
#include "game/control/key_log.h"

#include <array>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace rink::game {
namespace {

constexpr const char* version_line = "rink-keys 1";
constexpr std::array<std::string_view, 4> input_names{"down", "up", "enter", "leave"};

bool has_key(InputKind kind) { return kind == InputKind::key_down || kind == InputKind::key_up; }

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <class Number, class... Base>
std::optional<Number> number_of(const std::string& text, Base... base) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base...);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

class Reader {
 public:
  Reader(std::istream& stream, std::string name) : stream_(stream), name_(std::move(name)) {}

  KeyLog read() {
    if (!next_line() || line_ != version_line) refuse(line_, std::string("the line \"") + version_line + "\"");
    while (next_line()) {
      const std::vector<std::string> words = words_of(line_);
      if (words.empty() || words.front().front() == '#') continue;
      if (!log_.events.empty() || !read_header(words)) read_event(words);
    }
    if (stream_.bad()) throw SceneError(name_ + ": cannot be read to its end");
    return std::move(log_);
  }

 private:
  bool next_line() {
    ++line_number_;
    if (std::getline(stream_, line_)) return true;
    line_.clear();
    return false;
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw SceneError(name_ + ":" + std::to_string(line_number_) + ": found \"" + found + "\", expected " + expected);
  }

  template <class Number, class... Base>
  Number require(const std::string& text, const char* expected, Base... base) const {
    const std::optional<Number> number = number_of<Number>(text, base...);
    if (!number) refuse(text, expected);
    return *number;
  }

  bool read_header(const std::vector<std::string>& words) {
    const std::string& key = words[0];
    if (key != "scene" && key != "seed" && key != "bats" && key != "fingerprint") return false;
    if (key == "scene") {
      const std::size_t start = line_.find_first_not_of(" \t", line_.find("scene") + 5);
      log_.scene = start == std::string::npos ? "" : line_.substr(start);
      return true;
    }
    if (words.size() != 2) refuse(line_, key + " and one number");
    if (key == "seed") log_.seed = require<std::uint64_t>(words[1], "a whole number");
    if (key == "bats") log_.bats = require<std::uint32_t>(words[1], "a whole number");
    if (key == "fingerprint") log_.fingerprint = require<std::uint64_t>(words[1], "up to 16 hexadecimal digits", 16);
    return true;
  }

  void read_event(const std::vector<std::string>& words) {
    if (words.size() < 3) refuse(line_, "time, player, and down, up, enter or leave");
    InputEvent event;
    event.time = require<double>(words[0], "scene, seed, bats, fingerprint, or a time in seconds");
    if (!std::isfinite(event.time) || event.time < 0.0) refuse(words[0], "a time of 0 s or more");
    if (!log_.events.empty() && event.time < log_.events.back().time) refuse(words[0], "a time not before that of the line above");
    event.player = require<std::uint32_t>(words[1], "a player's number, counted from 0");
    event.kind = input_kind(words[2]);
    if (words.size() != (has_key(event.kind) ? 4u : 3u)) refuse(line_, has_key(event.kind) ? "one key after " + words[2] : "nothing after " + words[2]);
    if (has_key(event.kind)) {
      const std::optional<Key> key = key_from_name(words[3]);
      if (!key) refuse(words[3], "left, right, up or down");
      event.key = *key;
    }
    log_.events.push_back(event);
  }

  InputKind input_kind(const std::string& word) const {
    for (std::size_t kind = 0; kind < input_names.size(); ++kind)
      if (input_names[kind] == word) return static_cast<InputKind>(kind);
    refuse(word, "down, up, enter or leave");
  }

  std::istream& stream_;
  std::string name_;
  std::string line_;
  std::uint64_t line_number_ = 0;
  KeyLog log_;
};

void write_event(std::ostream& stream, const InputEvent& event) {
  std::array<char, 40> time;
  std::snprintf(time.data(), time.size(), "%.17g", event.time);
  stream << time.data() << ' ' << event.player << ' ' << input_names[static_cast<std::size_t>(event.kind)];
  if (has_key(event.kind)) stream << ' ' << key_name(event.key);
  stream << '\n';
}

}  // namespace

KeyLog key_log_for(const Scene& scene) {
  return {.scene = scene.name, .seed = scene.seed, .bats = static_cast<std::uint32_t>(scene.bodies.bats.size()), .fingerprint = fingerprint(scene), .events = {}};
}

void write_key_log(std::ostream& stream, const KeyLog& log) {
  stream << version_line << '\n' << "scene " << log.scene << '\n' << "seed " << log.seed << '\n';
  if (log.bats) stream << "bats " << *log.bats << '\n';
  if (log.fingerprint) {
    std::array<char, 17> digits;
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64, *log.fingerprint);
    stream << "fingerprint " << digits.data() << '\n';
  }
  for (const InputEvent& event : log.events) write_event(stream, event);
}

void write_key_log(const std::filesystem::path& file, const KeyLog& log) {
  std::ofstream stream(file);
  write_key_log(stream, log);
  stream.close();
  if (!stream) throw SceneError(file.string() + ": cannot be written");
}

KeyLog read_key_log(std::istream& stream, const std::string& name) { return Reader(stream, name).read(); }

KeyLog read_key_log(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) throw SceneError(file.string() + ": cannot be read: expected a key log");
  return read_key_log(stream, file.string());
}

void require_fit(const KeyLog& log, const Scene& scene, const std::string& file) {
  const std::size_t bats = scene.bodies.bats.size();
  for (const InputEvent& event : log.events)
    if (event.player >= bats)
      throw SceneError(file + ": has keys of player " + std::to_string(event.player) + ", but the scene " + scene.name + " has " + std::to_string(bats) + " bats, counted from 0");
  if (log.fingerprint && *log.fingerprint != fingerprint(scene))
    throw SceneError(file + ": was recorded in another scene than this (scene " + log.scene + ", seed " + std::to_string(log.seed) +
                     (log.bats ? ", " + std::to_string(*log.bats) + " bats" : "") + "); expected the same scene, seed and number of bats");
}

}  // namespace rink::game
