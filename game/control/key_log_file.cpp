// Writes numbers as the shortest way back to their bits allows, and reads line by line so that an
// error can name its line.
#include "game/control/key_log_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <streambuf>

#include "game/control/key_log_packed.h"
#include "game/model/system_reason.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "im/basics/printable.h"

namespace rink::game {
namespace {

constexpr const char* version_line = "rink-keys 1";
constexpr const char* push_version_line = "rink-keys 3";  ///< of logs with pushes
constexpr std::size_t version_line_max = 256, line_max = 1u << 16, size_max = 1u << 30;  // bytes
constexpr std::array<std::string_view, 5> input_names{"down", "up", "enter", "leave", "push"};

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
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number, base...);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A checksum over lines with their ends.
class LineChecksum {
 public:
  void add(const std::string& line) {
    hash_.add(line);
    hash_.add('\n');
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv64 hash_;
};

std::string first_line_expected() {
  return std::string("the line \"") + version_line + "\" or \"" + packed_version_line +
         "\", or with pushes \"" + push_version_line + "\" or \"" + packed_push_version_line +
         "\", with which key logs of this version begin";
}

class Reader {
 public:
  Reader(std::istream& stream, std::string name) : stream_(stream), name_(std::move(name)) {}

  KeyLog read() {
    next_line();
    if (line_ == packed_version_line || line_ == packed_push_version_line)
      return read_packed_key_log(stream_, name_, line_ == packed_push_version_line);
    may_push_ = line_ == push_version_line;
    if (line_ != version_line && !may_push_) refuse(line_, first_line_expected());
    while (next_line()) {
      const std::vector<std::string> words = words_of(line_);
      if (words.empty() || words.front().front() == '#') continue;
      if (log_.is_sealed) refuse(line_, "nothing after the line \"end\"");
      if (words.front() == "end") read_end(words);
      else if (!log_.events.empty() || !read_header(words)) read_event(words);
    }
    return std::move(log_);
  }

 private:
  bool next_line() {
    ++line_number_;
    above_ = checksum_.value();
    line_.clear();
    const bool is_there = take_line();
    if (is_there) checksum_.add(line_);
    return is_there;
  }
  /// As std::getline, but no longer than a line may be: a device gives bytes without end.
  bool take_line() {
    using Traits = std::istream::traits_type;
    std::streambuf& bytes = *stream_.rdbuf();
    const std::size_t longest = line_number_ == 1 ? version_line_max : line_max;
    for (auto next = next_byte(bytes); !Traits::eq_int_type(next, Traits::eof());
         next = next_byte(bytes)) {
      if (++size_ > size_max)
        refuse(line_, "the end of the log within " + std::to_string(size_max) + " bytes");
      if (next == '\n') return true;
      line_ += Traits::to_char_type(next);
      if (line_.size() > longest)
        refuse(line_, line_number_ == 1
                          ? first_line_expected()
                          : "a line of at most " + std::to_string(line_max) + " bytes");
    }
    return !line_.empty();
  }
  std::istream::traits_type::int_type next_byte(std::streambuf& bytes) const {
    try {
      return bytes.sbumpc();
    } catch (const std::ios_base::failure&) {
      throw SceneError(name_ + ": cannot be read to its end");
    }
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw SceneError(name_ + ":" + std::to_string(line_number_) + ": found \"" + printable(found) +
                     "\", expected " + expected);
  }

  template <class Number, class... Base>
  Number require(const std::string& text, const char* expected, Base... base) const {
    const std::optional<Number> number = number_of<Number>(text, base...);
    if (!number) refuse(text, expected);
    return *number;
  }

  bool read_header(const std::vector<std::string>& words) {
    const std::string& key = words[0];
    if (key == "|") {
      log_.scene_text += line_.substr(std::min(line_.size(), line_.find('|') + 2)) + '\n';
      return true;
    }
    constexpr std::array<std::string_view, 8> known{
        "scene", "seed", "bats", "bat_count", "puck_count", "fingerprint", "until", "hash"};
    if (std::ranges::find(known, key) == known.end()) return false;
    if (key == "scene") {
      const std::size_t start = line_.find_first_not_of(" \t", line_.find("scene") + 5);
      log_.scene = start == std::string::npos ? "" : line_.substr(start);
      return true;
    }
    if (words.size() != 2) refuse(line_, key + " and one number");
    if (key == "seed") log_.seed = require<std::uint64_t>(words[1], "a whole number");
    if (key == "bats") log_.bats = require<std::uint32_t>(words[1], "a whole number");
    if (key == "bat_count") log_.bat_count = require<std::uint32_t>(words[1], "a whole number");
    if (key == "puck_count") log_.puck_count = require<std::uint32_t>(words[1], "a whole number");
    if (key == "hash")
      log_.hash = require<std::uint64_t>(words[1], "up to 16 hexadecimal digits", 16);
    if (key == "until") log_.until = time_of(words[1]);
    if (key == "fingerprint")
      log_.fingerprint = require<std::uint64_t>(words[1], "up to 16 hexadecimal digits", 16);
    return true;
  }

  double time_of(const std::string& word) const {
    const double time = require<double>(
        word, "scene, seed, bats, fingerprint, until, hash, end, or a time in seconds");
    if (!(time >= 0.0 && time <= key_time_max)) refuse(word, "a time from 0 to 1e9 s");
    return time;
  }

  void read_end(const std::vector<std::string>& words) {
    if (words.size() != 3) refuse(line_, "end, the number of events and a checksum");
    if (require<std::uint64_t>(words[1], "the number of events") != log_.events.size())
      refuse(line_, "end " + std::to_string(log_.events.size()) +
                        ", for so many events stand above: lines are missing or were added");
    if (require<std::uint64_t>(words[2], "a checksum of up to 16 hexadecimal digits", 16) != above_)
      refuse(words[2],
             hexadecimal(above_) + ", the checksum of the lines above: one of them was altered");
    log_.is_sealed = true;
  }

  void read_event(const std::vector<std::string>& words) {
    if (words.size() < 3) refuse(line_, "time, player, and " + kinds_expected());
    InputEvent event;
    event.time = time_of(words[0]);
    if (!log_.events.empty() && event.time < log_.events.back().time)
      refuse(words[0], "a time not before that of the line above");
    event.player = require<std::uint32_t>(words[1], "a player's number, counted from 0");
    event.kind = input_kind(words[2]);
    if (event.kind == InputKind::push) {
      if (words.size() != 5) refuse(line_, "two numbers of steps after push");
      event.push = {steps(words[3]), steps(words[4])};
    } else if (words.size() != (has_key(event.kind) ? 4u : 3u))
      refuse(line_,
             has_key(event.kind) ? "one key after " + words[2] : "nothing after " + words[2]);
    if (has_key(event.kind)) {
      const std::optional<Key> key = key_from_name(words[3]);
      if (!key) refuse(words[3], "left, right, up or down");
      event.key = *key;
    }
    log_.events.push_back(event);
  }

  InputKind input_kind(const std::string& word) const {
    for (std::size_t kind = 0; kind < input_names.size(); ++kind)
      if (input_names[kind] == word &&
          (may_push_ || static_cast<InputKind>(kind) != InputKind::push))
        return static_cast<InputKind>(kind);
    refuse(word, kinds_expected());
  }
  std::string kinds_expected() const {
    return may_push_ ? "down, up, enter, leave or push" : "down, up, enter or leave";
  }
  std::int8_t steps(const std::string& word) const {
    const int number = require<int>(word, "a whole number of steps, -127 to 127");
    if (number < -Push::whole || number > Push::whole) refuse(word, "steps from -127 to 127");
    return static_cast<std::int8_t>(number);
  }

  std::istream& stream_;
  std::string name_;
  std::string line_;
  std::uint64_t line_number_ = 0, size_ = 0;
  bool may_push_ = false;
  LineChecksum checksum_;
  std::uint64_t above_ = 0;  ///< the checksum of all lines above this one
  KeyLog log_;
};

std::string exact(double number) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.17g", number);
  return text.data();
}

class Writer {
 public:
  explicit Writer(std::ostream& stream) : stream_(stream) {}

  void write(const KeyLog& log) {
    line(has_pushes(log) ? push_version_line : version_line);
    line("scene " + log.scene);
    line("seed " + std::to_string(log.seed));
    if (log.bats) line("bats " + std::to_string(*log.bats));
    if (log.bat_count) line("bat_count " + std::to_string(*log.bat_count));
    if (log.puck_count) line("puck_count " + std::to_string(*log.puck_count));
    if (log.fingerprint) line("fingerprint " + hexadecimal(*log.fingerprint));
    if (log.until) line("until " + exact(*log.until));
    if (log.hash) line("hash " + hexadecimal(*log.hash));
    std::istringstream scene(log.scene_text);
    for (std::string text; std::getline(scene, text);) line(text.empty() ? "|" : "| " + text);
    for (const InputEvent& event : log.events) write(event);
    stream_ << "end " << log.events.size() << ' ' << hexadecimal(checksum_.value()) << '\n';
  }

 private:
  void write(const InputEvent& event) {
    assert(static_cast<std::size_t>(event.kind) < input_names.size());
    std::string text = exact(event.time) + ' ' + std::to_string(event.player) + ' ' +
                       std::string(input_names[static_cast<std::size_t>(event.kind)]);
    if (has_key(event.kind)) text += ' ' + std::string(key_name(event.key));
    if (event.kind == InputKind::push)
      text += ' ' + std::to_string(event.push.x) + ' ' + std::to_string(event.push.y);
    line(text);
  }
  void line(const std::string& text) {
    stream_ << text << '\n';
    checksum_.add(text);
  }

  std::ostream& stream_;
  LineChecksum checksum_;
};

}  // namespace

void write_key_log(std::ostream& stream, const KeyLog& log) { Writer(stream).write(log); }

void write_key_log(const std::filesystem::path& file, const KeyLog& log) {
  errno = 0;
  std::ofstream stream(file);
  write_key_log(stream, log);
  stream.close();
  if (!stream) throw SceneError(file.string() + ": cannot be written: " + system_reason(errno));
}

KeyLog read_key_log(std::istream& stream, const std::string& name) {
  return Reader(stream, name).read();
}

KeyLog read_key_log(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw SceneError(file.string() + ": cannot be read: expected a key log");
  return read_key_log(stream, file.string());
}

}  // namespace rink::game
