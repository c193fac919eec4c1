// Writes and reads lines; the last one shows whether all others are complete and unaltered.
#include "game/net/trace_lines.h"

#include <cerrno>
#include <iterator>
#include <nlohmann/json.hpp>

#include "game/model/system_reason.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {
namespace {

std::string last_line(std::uint64_t lines, std::uint64_t hash) {
  return nlohmann::ordered_json{{"lines", lines}, {"fnv1a", hexadecimal(hash)}}.dump() + "\n";
}

}  // namespace

TraceWriter::TraceWriter(std::string file)
    : file_(std::move(file)), error_((errno = 0)), stream_(file_) {
  note_error();
}

/// At the first failure, for other calls set errno between two lines.
void TraceWriter::note_error() {
  if (!stream_ && error_ == 0) error_ = errno;
}

void TraceWriter::line(const nlohmann::ordered_json& value) {
  line_of_text(value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void TraceWriter::line_of_text(std::string text) {
  text += '\n';
  hash_.add(text);
  ++lines_;
  errno = 0;
  stream_ << text;
  note_error();
}

void TraceWriter::finish() {
  const std::string last = last_line(lines_, hash_.value());
  errno = 0;
  stream_ << last;
  stream_.close();
  note_error();
  if (!stream_) throw std::runtime_error("cannot write '" + file_ + "': " + system_reason(error_));
}

TraceReader::TraceReader(std::string file) : file_(std::move(file)) {
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) throw TraceError(file_ + ": cannot be read: expected evidence of a run");
  text_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  const std::size_t before_last =
      text_.size() < 2 ? std::string::npos : text_.rfind('\n', text_.size() - 2);
  const std::size_t end = before_last == std::string::npos ? 0 : before_last + 1;
  for (const char byte : std::string_view(text_).substr(0, end)) lines_ += byte == '\n' ? 1u : 0u;
  if (std::string_view(text_).substr(end) !=
      last_line(lines_, hash_of(std::string_view(text_).substr(0, end))))
    throw TraceError(file_ + ": truncated or altered: its last line does not fit the " +
                     std::to_string(lines_) + " lines before it");
  text_.resize(end);
}

std::string_view TraceReader::next_text() {
  if (is_at_end()) refuse("another line");
  const std::size_t begin = position_, end = text_.find('\n', begin);
  ++read_;
  position_ = end + 1;
  return std::string_view(text_).substr(begin, end - begin);
}

nlohmann::json TraceReader::next() {
  nlohmann::json value = nlohmann::json::parse(next_text(), nullptr, false);
  if (value.is_discarded()) refuse("JSON");
  return value;
}

void TraceReader::require_version(int found, int wanted, const std::string& what) const {
  if (found == wanted) return;
  refuse(what + " of version " + std::to_string(wanted) + ", found " +
         (found == 0 ? "something else" : "version " + std::to_string(found)));
}

void TraceReader::refuse(const std::string& expected) const {
  throw TraceError(file_ + ":" + std::to_string(read_) + ": expected " + expected);
}

}  // namespace rink::game
