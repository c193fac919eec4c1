// Writes and reads a peer's trace: a header, its events, its decisions, and its player's replicas.
#include "game/net/peer/peer_trace.h"

#include <nlohmann/json.hpp>

#include "game/net/trace_lines.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 1;

Json json_of(const PeerLoad& load) {
  return {{"instant_s", load.instant_s},
          {"bytes", load.bytes},
          {"messages", load.messages},
          {"bytes_sent", load.bytes_sent},
          {"bytes_received", load.bytes_received},
          {"writes", load.writes},
          {"segments", load.segments},
          {"acknowledgements", load.acknowledgements},
          {"kernel_segments", load.kernel_segments},
          {"events", load.events}};
}

PeerLoad load_in(const nlohmann::json& json) {
  PeerLoad load;
  load.instant_s = json.at("instant_s");
  load.bytes = json.at("bytes"), load.messages = json.at("messages");
  load.bytes_sent = json.at("bytes_sent"), load.bytes_received = json.at("bytes_received");
  load.writes = json.at("writes"), load.segments = json.at("segments"),
  load.events = json.at("events");
  load.acknowledgements = json.at("acknowledgements"),
  load.kernel_segments = json.at("kernel_segments");
  return load;
}

void write_player(TraceWriter& writer, const PlayerTrace& player) {
  Json changes = Json::array();
  for (const PlayerTrace::ScopeChange& change : player.changes)
    changes.push_back({change.instant_s, change.body, change.is_in});
  writer.line({{"bat", player.bat}, {"samples", player.samples.size()}, {"changes", changes}});
  for (const PlayerTrace::Sample& sample : player.samples) {
    Json replicas = Json::array();
    for (std::size_t k = sample.first; k < sample.last; ++k) {
      const PlayerTrace::Replica& replica = player.replicas[k];
      Json entry{replica.body, replica.bytes};
      if (replica.is_in_scope)
        for (const physics::Vector2& place : {replica.matched, replica.displayed})
          entry.push_back(place.x()), entry.push_back(place.y());
      replicas.push_back(std::move(entry));
    }
    writer.line({{"displayed_s", sample.displayed_s},
                 {"matched_s", sample.matched_s},
                 {"window_s", sample.window_s},
                 {"bodies", replicas}});
  }
}

PlayerTrace read_player(TraceReader& reader) {
  PlayerTrace player;
  const nlohmann::json head = reader.next();
  player.bat = head.at("bat");
  for (const nlohmann::json& change : head.at("changes"))
    player.changes.push_back({change.at(0), change.at(1), change.at(2)});
  for (std::size_t k = 0; k < head.at("samples").get<std::size_t>(); ++k) {
    const nlohmann::json line = reader.next();
    const std::size_t first = player.replicas.size();
    for (const nlohmann::json& entry : line.at("bodies")) {
      PlayerTrace::Replica replica{
          .body = entry.at(0), .bytes = entry.at(1), .is_in_scope = entry.size() > 2};
      if (replica.is_in_scope)
        replica.matched = {entry.at(2).get<double>(), entry.at(3).get<double>()},
        replica.displayed = {entry.at(4).get<double>(), entry.at(5).get<double>()};
      player.replicas.push_back(replica);
    }
    player.samples.push_back({.displayed_s = line.at("displayed_s"),
                              .matched_s = line.at("matched_s"),
                              .window_s = line.at("window_s"),
                              .first = first,
                              .last = player.replicas.size()});
  }
  return player;
}

PeerTrace read_lines(TraceReader& reader) {
  PeerTrace trace;
  const nlohmann::json header = reader.next();
  reader.require_version(header.value("rink-peer-evidence", 0), version, "a peer's evidence");
  trace.peer = header.at("peer"), trace.peer_count = header.at("peers");
  trace.begin = load_in(header.at("begin")), trace.end = load_in(header.at("end"));
  for (const nlohmann::json& event : header.at("events")) {
    const auto kind = event.at(0).get<unsigned>();
    if (kind > static_cast<unsigned>(PeerTrace::Kind::known))
      reader.refuse("an event of kind 0 to 2");
    trace.events.push_back(
        {static_cast<PeerTrace::Kind>(kind), event.at(1), event.at(2), event.at(3)});
  }
  for (const nlohmann::json& decision : header.at("decisions"))
    trace.decisions.push_back({decision.at(0), decision.at(1), decision.at(2)});
  if (header.at("is_watched").get<bool>()) trace.player = read_player(reader);
  return trace;
}

}  // namespace

void write_trace(const std::string& file, const PeerTrace& trace) {
  TraceWriter writer(file);
  Json events = Json::array(), decisions = Json::array();
  for (const PeerTrace::Event& event : trace.events)
    events.push_back({static_cast<unsigned>(event.kind), event.due_s, event.instant_s, event.felt});
  for (const PeerTrace::Decision& decision : trace.decisions)
    decisions.push_back({decision.instant_s, decision.peer, decision.bodies});
  writer.line({{"rink-peer-evidence", version},
               {"peer", trace.peer},
               {"peers", trace.peer_count},
               {"is_watched", trace.player.has_value()},
               {"begin", json_of(trace.begin)},
               {"end", json_of(trace.end)},
               {"events", events},
               {"decisions", decisions}});
  if (trace.player) write_player(writer, *trace.player);
  writer.finish();
}

PeerTrace read_peer_trace(const std::string& file) {
  TraceReader reader(file);
  try {
    return read_lines(reader);
  } catch (const nlohmann::json::exception& error) {
    reader.refuse(std::string("a peer's evidence as docs/metrics.md describes it (") +
                  error.what() + ")");
  }
}

}  // namespace rink::game
