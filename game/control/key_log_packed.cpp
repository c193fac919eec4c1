// Writes and reads packed logs: a first line as in the text form, a checksum, the number of bytes
// that follow, and these.
#include "game/control/key_log_packed.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>

#include "game/model/system_reason.h"
#include "game/model/time_grid.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/varint.h"

namespace rink::game {
namespace {

constexpr std::uint64_t packed_size_max = 1u << 28;  // bytes: a crowd's keys of some days
constexpr double millisecond = 1e-3;
constexpr std::int64_t ulps_max = 127;  // arithmetic on whole milliseconds errs by at most so much

/// The encoding of an event's time.
enum class TimeForm : std::uint8_t { on_grid, near_millisecond, in_full };
/// The optional numbers, by their bits in the log's first byte.
enum class Part : std::uint8_t { bats, bat_count, puck_count, fingerprint, until, hash };

/// A push is written as an `enter` with this key, in logs with pushes.
constexpr Key push_mark = Key::right;

constexpr unsigned player_bits = 2, player_elsewhere = (1u << player_bits) - 1;

/// The bits of a time, which is not below 0: neighbours in them are neighbours in time.
std::int64_t bits_of(double time) { return std::bit_cast<std::int64_t>(time); }

/// A time as a number of steps.
std::uint64_t steps_of(double time, double step) {
  assert(time >= 0.0 && step > 0.0);
  return static_cast<std::uint64_t>(std::floor(time / step));
}

class PackedWriter {
 public:
  explicit PackedWriter(std::string& bytes) : bytes_(bytes) {}

  void byte(unsigned value) {
    assert(value <= 0xff);
    bytes_ += static_cast<char>(static_cast<unsigned char>(value));
  }
  void varint(std::uint64_t value) {
    std::array<std::byte, varint_size_max> raw;
    bytes_.append(reinterpret_cast<const char*>(raw.data()),
                  static_cast<std::size_t>(put_varint(raw.data(), value) - raw.data()));
  }
  template <class Number>
  void whole(Number number) {
    std::array<char, sizeof number> raw;
    std::memcpy(raw.data(), &number, sizeof number);
    bytes_.append(raw.data(), raw.size());
  }
  void text(const std::string& text) {
    varint(text.size());
    bytes_ += text;
  }

 private:
  std::string& bytes_;
};

std::uint8_t parts_of(const KeyLog& log) {
  std::uint8_t parts = 0;
  const auto add = [&](Part part, bool is_there) {
    parts = static_cast<std::uint8_t>(parts | (is_there ? 1u << static_cast<unsigned>(part) : 0u));
  };
  add(Part::bats, log.bats.has_value());
  add(Part::bat_count, log.bat_count.has_value());
  add(Part::puck_count, log.puck_count.has_value());
  add(Part::fingerprint, log.fingerprint.has_value());
  add(Part::until, log.until.has_value());
  add(Part::hash, log.hash.has_value());
  return parts;
}

void write_event(PackedWriter& out, const InputEvent& event, double before) {
  assert(std::isfinite(event.time) && event.time >= before && "times are told by what they add");
  const bool is_on_grid = next_on(key_grid, event.time) == event.time;
  const auto milliseconds = static_cast<std::uint64_t>(std::round(event.time / millisecond)),
             milliseconds_before = steps_of(before, millisecond);
  const std::int64_t ulps =
      bits_of(event.time) - bits_of(static_cast<double>(milliseconds) * millisecond);
  const bool is_near = milliseconds >= milliseconds_before && std::abs(ulps) <= ulps_max;
  const TimeForm form = is_on_grid ? TimeForm::on_grid
                        : is_near  ? TimeForm::near_millisecond
                                   : TimeForm::in_full;
  const bool is_push = event.kind == InputKind::push;
  const InputKind kind = is_push ? InputKind::enter : event.kind;
  const Key key = is_push ? push_mark : event.key;
  assert(static_cast<unsigned>(kind) < 4 && static_cast<unsigned>(key) < 4);
  const unsigned player = std::min<unsigned>(event.player, player_elsewhere);
  out.byte(static_cast<unsigned>(kind) | static_cast<unsigned>(key) << 2 |
           static_cast<unsigned>(form) << 4 | player << 6);
  if (player == player_elsewhere) out.varint(event.player);
  if (is_push) out.whole(event.push.x), out.whole(event.push.y);
  if (form == TimeForm::in_full) out.whole(event.time);
  if (form == TimeForm::on_grid)
    out.varint(steps_of(event.time, key_grid) - steps_of(before, key_grid));
  if (form != TimeForm::near_millisecond) return;
  out.varint(milliseconds - milliseconds_before);
  out.byte(static_cast<unsigned char>(ulps));
}

std::string packed(const KeyLog& log) {
  std::string bytes;
  PackedWriter out(bytes);
  out.byte(parts_of(log));
  out.text(log.scene);
  out.varint(log.seed);
  for (const auto& count : {log.bats, log.bat_count, log.puck_count})
    if (count) out.varint(*count);
  if (log.fingerprint) out.whole(*log.fingerprint);
  if (log.until) out.whole(*log.until);
  if (log.hash) out.whole(*log.hash);
  out.text(log.scene_text);
  out.varint(log.events.size());
  double before = 0.0;
  for (const InputEvent& event : log.events) {
    write_event(out, event, before);
    before = event.time;
  }
  return bytes;
}

class PackedReader {
 public:
  PackedReader(std::string_view bytes, const std::string& name, bool may_push)
      : bytes_(bytes), name_(name), may_push_(may_push) {}

  KeyLog read() {
    KeyLog log;
    const unsigned parts = byte();
    const auto has = [parts](Part part) {
      return (parts >> static_cast<unsigned>(part) & 1u) != 0;
    };
    log.scene = text();
    log.seed = varint();
    if (has(Part::bats)) log.bats = small();
    if (has(Part::bat_count)) log.bat_count = small();
    if (has(Part::puck_count)) log.puck_count = small();
    if (has(Part::fingerprint)) log.fingerprint = whole<std::uint64_t>();
    if (has(Part::until)) log.until = checked(whole<double>());
    if (has(Part::hash)) log.hash = whole<std::uint64_t>();
    log.scene_text = text();
    const std::uint64_t count = varint();
    for (std::uint64_t number = 0; number < count; ++number)
      log.events.push_back(event(log.events.empty() ? 0.0 : log.events.back().time));
    if (!bytes_.empty()) refuse("has bytes after its last key");
    log.is_sealed = true;
    return log;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw SceneError(name_ + ": " + what + "; expected a record as this version of Rink writes it");
  }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) refuse("ends in the middle of a value");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  unsigned byte() { return static_cast<unsigned char>(take(1).front()); }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    const std::size_t size = get_varint(std::as_bytes(std::span(bytes_)), value);
    if (size > 0) return take(size), value;
    if (bytes_.size() < varint_size_max) refuse("ends in the middle of a value");
    refuse("has a number that is too long");
  }
  std::uint32_t small() {
    const std::uint64_t value = varint();
    if (value > 0xffffffffu) refuse("has a number that is too large");
    return static_cast<std::uint32_t>(value);
  }
  template <class Number>
  Number whole() {
    Number number;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  std::string text() { return std::string(take(varint())); }

  double checked(double time) const {
    if (!(time >= 0.0 && time <= key_time_max)) refuse("has a time that is not from 0 to 1e9 s");
    return time;
  }

  InputEvent event(double before) {
    const unsigned first = byte();
    InputEvent event{.time = 0.0,
                     .player = first >> 6,
                     .kind = static_cast<InputKind>(first & 3u),
                     .key = static_cast<Key>(first >> 2 & 3u)};
    if (event.player == player_elsewhere) event.player = small();
    if (may_push_ && event.kind == InputKind::enter && event.key == push_mark) {
      event.kind = InputKind::push, event.key = Key::left;
      event.push = {whole<std::int8_t>(), whole<std::int8_t>()};
      if (!is_sound(event.push)) refuse("has a push of more than the thrust");
    }
    event.time = checked(time(static_cast<TimeForm>(first >> 4 & 3u), before));
    if (event.time < before) refuse("has a key before the one that stands above it");
    return event;
  }

  double time(TimeForm form, double before) {
    if (form == TimeForm::in_full) return whole<double>();
    if (form == TimeForm::on_grid)
      return static_cast<double>(steps_of(before, key_grid) + varint()) * key_grid;
    if (form != TimeForm::near_millisecond) refuse("has a time in no known form");
    const double near =
        checked(static_cast<double>(steps_of(before, millisecond) + varint()) * millisecond);
    const auto ulps = static_cast<std::int8_t>(byte());
    return near == 0.0 && ulps < 0 ? -1.0 : std::bit_cast<double>(bits_of(near) + ulps);
  }

  std::string_view bytes_;
  const std::string& name_;
  bool may_push_;
};

/// At most `size` bytes, as many as there are; a piece at a time, since the size may be forged.
std::string read_up_to(std::istream& stream, std::uint64_t size) {
  constexpr std::uint64_t piece = 1u << 16;
  std::string bytes;
  while (bytes.size() < size && stream) {
    const std::size_t had = bytes.size();
    bytes.resize(static_cast<std::size_t>(std::min(size, had + piece)));
    stream.read(bytes.data() + had, static_cast<std::streamsize>(bytes.size() - had));
    bytes.resize(had + static_cast<std::size_t>(stream.gcount()));
  }
  assert(bytes.size() <= size);
  return bytes;
}

}  // namespace

void write_packed_key_log(std::ostream& stream, const KeyLog& log) {
  const std::string bytes = packed(log);
  std::string head =
      std::string(has_pushes(log) ? packed_push_version_line : packed_version_line) + '\n';
  PackedWriter out(head);
  out.whole(hash_of(bytes));
  out.whole(static_cast<std::uint64_t>(bytes.size()));
  stream << head << bytes;
}

void write_packed_key_log(const std::filesystem::path& file, const KeyLog& log) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  const bool is_open = stream.is_open();
  write_packed_key_log(stream, log);
  stream.close();
  if (stream) return;
  const std::string reason = system_reason(errno);
  std::error_code error;
  if (is_open && std::filesystem::is_regular_file(file, error))
    std::filesystem::remove(file, error);
  throw SceneError(file.string() + ": cannot be written: " + reason);
}

KeyLog read_packed_key_log(std::istream& stream, const std::string& name, bool may_push) {
  const std::string head = read_up_to(stream, 16);
  std::array<std::uint64_t, 2> numbers{};  // checksum, size
  if (head.size() < sizeof numbers) throw SceneError(name + ": is cut off after its first line");
  std::memcpy(numbers.data(), head.data(), sizeof numbers);
  if (numbers[1] > packed_size_max)
    throw SceneError(name + ": was altered: its stated length is " + std::to_string(numbers[1]) +
                     " bytes, allowed are " + std::to_string(packed_size_max));
  const std::string bytes = read_up_to(stream, numbers[1] + 1);
  if (bytes.size() < numbers[1])
    throw SceneError(name + ": is cut off: " + std::to_string(bytes.size()) + " of " +
                     std::to_string(numbers[1]) + " bytes are there");
  if (bytes.size() > numbers[1])
    throw SceneError(name + ": was altered: it continues after its end");
  if (hash_of(bytes) != numbers[0])
    throw SceneError(name + ": was altered: its checksum is another");
  return PackedReader(bytes, name, may_push).read();
}

}  // namespace rink::game
