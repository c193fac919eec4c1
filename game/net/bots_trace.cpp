// The bots' evidence as lines: a header, one line per watched bot, one per sampled replica set.
#include "game/net/bots_trace.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;
constexpr int bots_version = 1;
constexpr double nanometres = 1e9;

std::int64_t rounded(double number, double parts) {
  return std::llround(std::clamp(number, -1e9, 1e9) * parts);
}

void add_number(std::string& text, std::int64_t number) {
  std::array<char, 24> digits;
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

void add_position(std::string& text, const physics::Vector2& position) {
  for (const double coordinate : {position.x(), position.y()}) {
    text += ',';
    add_number(text, rounded(coordinate, nanometres));
  }
}

/// Writes object and bytes; if it was in scope, also its believed position at the matched instant,
/// and that at the displayed one if they differ.
void add_entry(std::string& text, const BotsTrace::Replica& replica) {
  text += '[';
  add_number(text, replica.object);
  text += ',';
  add_number(text, replica.bytes);
  if (replica.is_in_scope) add_position(text, replica.matched);
  if (replica.is_in_scope && replica.displayed != replica.matched)
    add_position(text, replica.displayed);
  text += ']';
}

Json line_of(const BotsTrace::Bot& bot) {
  Json changes = Json::array();
  for (const BotsTrace::ScopeChange& change : bot.changes)
    changes.push_back({rounded(change.instant_s, 1e6), change.object, change.is_in ? 1 : 0});
  return {{"bat", bot.object}, {"changes_us", changes}};
}

/// Written and read number by number: there are millions of them in a run, and a tree of values
/// takes more than twice as long.
std::string line_of(const BotsTrace& trace, const BotsTrace::Sample& sample) {
  assert(sample.first <= sample.last && sample.last <= trace.replicas.size());
  std::string text = Json{
      {"bot", sample.bot},
      {"displayed_s", sample.displayed_s},
      {"matched_s", sample.matched_s},
      {"window_s",
       sample.window_s}}.dump();
  text.back() = ',';
  text += "\"entities_nm\":[";
  for (std::size_t i = sample.first; i < sample.last; ++i) {
    if (i > sample.first) text += ',';
    add_entry(text, trace.replicas[i]);
  }
  return text + "]}";
}

/// Parses a sample's line into the public members.
class SampleReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit SampleReader(std::vector<BotsTrace::Replica>& replicas) : replicas_(replicas) {}

  std::map<std::string, double> facts;
  bool has_entities = false;
  std::string expected;  ///< and not found; empty if nothing more is known

  bool number_integer(std::int64_t value) override {
    return number(static_cast<double>(value), value);
  }
  bool number_unsigned(std::uint64_t value) override {
    return number(static_cast<double>(value), static_cast<std::int64_t>(value));
  }
  bool number_float(double value, const std::string&) override {
    return depth_ == 1 && (facts[name_] = value, true);
  }
  bool key(std::string& name) override { return name_ = name, true; }
  bool start_object(std::size_t) override { return depth_++ == 0; }
  bool end_object() override { return --depth_ == 0; }
  bool start_array(std::size_t) override {
    count_ = 0;
    ++depth_;
    return name_ == "entities_nm" && depth_ <= 3;
  }
  bool end_array() override {
    has_entities = true;
    return --depth_ != 2 || entry();
  }
  bool null() override { return false; }
  bool boolean(bool) override { return false; }
  bool string(std::string&) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return expected = "JSON", false;
  }

 private:
  bool number(double value, std::int64_t whole) {
    if (depth_ == 1) return facts[name_] = value, true;
    if (depth_ == 3 && count_ < numbers_.size()) numbers_[count_] = whole;
    ++count_;
    return depth_ == 3;
  }

  bool entry() {
    if (count_ != 2 && count_ != 4 && count_ != 6)
      return expected = "an entity as object, bytes and no, one or two positions", false;
    for (const std::int64_t whole : {numbers_[0], numbers_[1]})
      if (whole < 0 || whole > std::numeric_limits<std::uint32_t>::max()) return false;
    BotsTrace::Replica replica{.object = static_cast<std::uint32_t>(numbers_[0]),
                               .bytes = static_cast<std::uint32_t>(numbers_[1]),
                               .is_in_scope = count_ > 2};
    if (count_ > 2) replica.matched = replica.displayed = position(2);
    if (count_ > 4) replica.displayed = position(4);
    replicas_.push_back(replica);
    return true;
  }

  physics::Vector2 position(std::size_t at) const {
    assert(at + 1 < numbers_.size());
    return {static_cast<double>(numbers_[at]) / nanometres,
            static_cast<double>(numbers_[at + 1]) / nanometres};
  }

  std::vector<BotsTrace::Replica>& replicas_;
  std::string name_;
  int depth_ = 0;
  std::size_t count_ = 0;  ///< of numbers in the present entity
  std::array<std::int64_t, 6> numbers_{};
};

BotsTrace::Sample read_sample(TraceReader& reader, BotsTrace& trace) {
  BotsTrace::Sample sample{.first = trace.replicas.size()};
  SampleReader line(trace.replicas);
  if (!nlohmann::json::sax_parse(reader.next_text(), &line))
    reader.refuse(line.expected.empty() ? "a sample as docs/metrics.md describes it"
                                        : line.expected);
  const auto fact = [&](const char* name) {
    const auto found = line.facts.find(name);
    if (found == line.facts.end()) reader.refuse(std::string("a sample with ") + name);
    return found->second;
  };
  if (!line.has_entities) reader.refuse("a sample with entities_nm");
  const double bot = fact("bot");
  if (!(bot >= 0.0 && bot < static_cast<double>(trace.bots.size())))
    reader.refuse("a bot below " + std::to_string(trace.bots.size()));
  sample.bot = static_cast<std::uint32_t>(bot);
  sample.displayed_s = fact("displayed_s"), sample.matched_s = fact("matched_s"),
  sample.window_s = fact("window_s");
  sample.last = trace.replicas.size();
  return sample;
}

}  // namespace

void append(BotsTrace& trace, const BotsTrace& further) {
  const auto bot = static_cast<std::uint32_t>(trace.bots.size());
  const std::size_t first = trace.replicas.size();
  trace.is_complete = trace.is_complete && further.is_complete;
  trace.bots.insert(trace.bots.end(), further.bots.begin(), further.bots.end());
  trace.replicas.insert(trace.replicas.end(), further.replicas.begin(), further.replicas.end());
  for (BotsTrace::Sample sample : further.samples) {
    sample.bot += bot, sample.first += first, sample.last += first;
    trace.samples.push_back(sample);
  }
}

BotsTrace rounded(BotsTrace trace) {
  const auto round_position = [](physics::Vector2& position) {
    for (double& coordinate : position)
      coordinate = static_cast<double>(rounded(coordinate, nanometres)) / nanometres;
  };
  for (BotsTrace::Bot& bot : trace.bots)
    for (BotsTrace::ScopeChange& change : bot.changes)
      change.instant_s = 1e-6 * static_cast<double>(rounded(change.instant_s, 1e6));
  for (BotsTrace::Replica& replica : trace.replicas) {
    round_position(replica.matched);
    round_position(replica.displayed);
  }
  return trace;
}

void write_lines(TraceWriter& writer, const BotsTrace& trace) {
  writer.line({{"rink-bots-evidence", bots_version},
               {"clients", trace.clients},
               {"from_s", trace.from_s},
               {"until_s", trace.until_s},
               {"is_complete", trace.is_complete},
               {"bots", trace.bots.size()},
               {"samples", trace.samples.size()}});
  assert(std::ranges::is_sorted(trace.samples, {}, &BotsTrace::Sample::displayed_s));
  for (const BotsTrace::Bot& bot : trace.bots) writer.line(line_of(bot));
  for (const BotsTrace::Sample& sample : trace.samples) writer.line_of_text(line_of(trace, sample));
}

void write_trace(const std::string& file, const BotsTrace& trace) {
  TraceWriter writer(file);
  write_lines(writer, trace);
  writer.finish();
}

BotsTrace read_bots_lines(TraceReader& reader) {
  BotsTrace trace;
  const nlohmann::json header = reader.next();
  reader.require_version(header.value("rink-bots-evidence", 0), bots_version, "the bots' evidence");
  trace.clients = header.at("clients");
  trace.from_s = header.at("from_s");
  trace.until_s = header.at("until_s");
  trace.is_complete = header.at("is_complete");
  for (std::size_t i = 0; i < header.at("bots").get<std::size_t>(); ++i) {
    const nlohmann::json line = reader.next();
    BotsTrace::Bot& bot = trace.bots.emplace_back();
    bot.object = line.at("bat");
    for (const nlohmann::json& change : line.at("changes_us"))
      bot.changes.push_back(
          {1e-6 * change.at(0).get<double>(), change.at(1), change.at(2).get<int>() != 0});
  }
  for (std::size_t i = 0; i < header.at("samples").get<std::size_t>(); ++i)
    trace.samples.push_back(read_sample(reader, trace));
  return trace;
}

BotsTrace read_bots_trace(const std::string& file) {
  TraceReader reader(file);
  try {
    return read_bots_lines(reader);
  } catch (const nlohmann::json::exception& error) {
    reader.refuse(std::string("the bots' evidence as docs/metrics.md describes it (") +
                  error.what() + ")");
  }
}

}  // namespace rink::game
