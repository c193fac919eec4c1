// Writes and reads a server's trace: a header with counts, ticks, keys, object names, then one line
// per sampled decision.
#include "game/net/server_trace.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "game/control/game_state.h"
#include "game/net/trace_lines.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 2;  // 2: may begin from a saved game

/// Ascending numbers as first and length of each run; the decisions of `none` are one run.
Json runs_of(std::span<const std::uint32_t> numbers) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    runs.push_back(numbers[i]);
    runs.push_back(end - i);
    i = end;
  }
  return runs;
}

void append_runs(const nlohmann::json& runs, std::vector<std::uint32_t>& numbers,
                 const TraceReader& reader) {
  constexpr std::uint64_t length_max = 1'000'000;
  if (runs.size() % 2 != 0) reader.refuse("pairs of first and length");
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    const auto first = runs[i].get<std::uint32_t>();
    const auto length = runs[i + 1].get<std::uint64_t>();
    if (length == 0 || length > length_max) reader.refuse("runs of 1 to 1,000,000 objects");
    for (std::uint32_t k = 0; k < length; ++k) numbers.push_back(first + k);
  }
}

std::string hash_of_state(std::span<const std::uint8_t> state) {
  return hexadecimal(hash_of({reinterpret_cast<const char*>(state.data()), state.size()}));
}

Json header_of(const ServerTrace& trace, const std::filesystem::path& file) {
  Json header{{"rink-server-evidence", version},
              {"scene", trace.choice.scene},
              {"bats", trace.choice.bats},
              {"bat_count", trace.choice.bat_count},
              {"puck_count", trace.choice.puck_count},
              {"seed", trace.choice.seed},
              {"scheme", trace.scheme},
              {"policy", trace.policy},
              {"clients", trace.clients},
              {"rate_hz", trace.rate_hz},
              {"from_s", trace.from_s},
              {"until_s", trace.until_s},
              {"end_s", trace.end_s},
              {"state_hash", hexadecimal(trace.state_hash)},
              {"decisions", trace.decisions.size()}};
  if (!trace.state_file.empty())
    header["begins_from"] = {
        {"file", std::filesystem::absolute(trace.state_file)
                     .lexically_relative(std::filesystem::absolute(file).parent_path())
                     .generic_string()},
        {"fnv1a", hash_of_state(trace.state)}};
  return header;
}

/// Saved games are found relative to the folder, so that it can be moved.
void read_state(const nlohmann::json& begins_from, const std::filesystem::path& folder,
                ServerTrace& trace) {
  const std::filesystem::path file =
      (folder / begins_from.at("file").get<std::string>()).lexically_normal();
  try {
    trace.state = read_game_state(file);
  } catch (const SceneError& error) {
    throw TraceError(error.what());
  }
  if (hash_of_state(trace.state) != begins_from.at("fnv1a").get<std::string>())
    throw TraceError(file.string() +
                     ": is not the saved game that the evidence began from: its hash differs");
  trace.state_file = file.string();
}

void read_header(const nlohmann::json& line, ServerTrace& trace, const TraceReader& reader) {
  reader.require_version(line.value("rink-server-evidence", 0), version, "a server's evidence");
  trace.choice = {.scene = line.at("scene"),
                  .bats = line.at("bats"),
                  .bat_count = line.at("bat_count"),
                  .puck_count = line.at("puck_count"),
                  .seed = line.at("seed")};
  trace.scheme = line.at("scheme");
  trace.policy = line.at("policy");
  trace.clients = line.at("clients");
  trace.rate_hz = line.at("rate_hz");
  trace.from_s = line.at("from_s");
  trace.until_s = line.at("until_s");
  trace.end_s = line.at("end_s");
  trace.state_hash = std::stoull(line.at("state_hash").get<std::string>(), nullptr, 16);
  if (!(trace.rate_hz >= 1.0 && trace.from_s >= 0.0 && trace.end_s >= 0.0 && trace.end_s <= 1e6))
    reader.refuse("a rate of 1 Hz or more and instants from 0 s to 1,000,000 s");
}

InputEvent read_key(const nlohmann::json& line, const TraceReader& reader) {
  InputEvent event{.time = line.at(0),
                   .player = line.at(1),
                   .kind = static_cast<InputKind>(line.at(2).get<std::uint8_t>())};
  bool is_sound = event.time >= 0.0 && event.kind <= InputKind::push;
  if (event.kind == InputKind::push) {
    const int x = line.at(3), y = line.at(4);
    is_sound = is_sound && std::abs(x) <= Push::whole && std::abs(y) <= Push::whole;
    event.push = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)};
  } else {
    event.key = static_cast<Key>(line.at(3).get<std::uint8_t>());
    is_sound = is_sound && std::ranges::find(all_keys, event.key) != std::end(all_keys);
  }
  if (!is_sound) reader.refuse("keys as time, player, kind and key or push");
  return event;
}

ServerTrace read_lines(TraceReader& reader, const std::filesystem::path& folder) {
  ServerTrace trace;
  const nlohmann::json header = reader.next();
  read_header(header, trace, reader);
  if (header.contains("begins_from")) read_state(header["begins_from"], folder, trace);
  const nlohmann::json ticks = reader.next().at("ticks_us");
  for (const nlohmann::json& tick : ticks)
    trace.ticks.push_back({tick.at(0), 1e-6 * tick.at(1).get<double>(),
                           1e-6 * tick.at(2).get<double>(), 1e-6 * tick.at(3).get<double>()});
  const nlohmann::json keys = reader.next().at("keys");
  for (const nlohmann::json& key : keys) trace.keys.push_back(read_key(key, reader));
  const nlohmann::json objects = reader.next().at("objects");
  for (const nlohmann::json& naming : objects)
    trace.objects.push_back({naming.at(0), naming.at(1)});
  for (std::size_t i = 0; i < header.at("decisions").get<std::size_t>(); ++i) {
    const nlohmann::json line = reader.next();
    const std::size_t first = trace.in_scope.size();
    append_runs(line.at("in_scope"), trace.in_scope, reader);
    trace.decisions.push_back(
        {line.at("instant_s"), line.at("player"), first, trace.in_scope.size()});
  }
  return trace;
}

}  // namespace

void write_trace(const std::string& file, const ServerTrace& trace) {
  TraceWriter writer(file);
  writer.line(header_of(trace, file));
  Json ticks = Json::array(), keys = Json::array(), objects = Json::array();
  const auto us = [](double seconds) { return std::round(1e9 * seconds) * 1e-3; };
  for (const ServerTrace::Tick& tick : trace.ticks)
    ticks.push_back({tick.simulated_s, us(tick.physics_s), us(tick.filter_s), us(tick.send_s)});
  for (const InputEvent& event : trace.keys) {
    const int kind = static_cast<int>(event.kind);
    if (event.kind == InputKind::push)
      keys.push_back({event.time, event.player, kind, event.push.x, event.push.y});
    else keys.push_back({event.time, event.player, kind, static_cast<int>(event.key)});
  }
  for (const ServerTrace::Naming& naming : trace.objects)
    objects.push_back({naming.object, naming.body});
  writer.line({{"ticks_us", ticks}});
  writer.line({{"keys", keys}});
  writer.line({{"objects", objects}});
  for (const ServerTrace::Decision& decision : trace.decisions)
    writer.line({{"instant_s", decision.instant_s},
                 {"player", decision.player},
                 {"in_scope", runs_of(trace.scope_of(decision))}});
  writer.finish();
}

ServerTrace read_server_trace(const std::string& file) {
  TraceReader reader(file);
  try {
    return read_lines(reader, std::filesystem::path(file).parent_path());
  } catch (const nlohmann::json::exception& error) {
    reader.refuse(std::string("the server's evidence as docs/metrics.md describes it (") +
                  error.what() + ")");
  } catch (const std::logic_error&) {
    reader.refuse("a state_hash of hexadecimal digits");
  }
}

}  // namespace rink::game
