// Writes and reads a peer's trace: a header with its events and decisions, then its player's trace.
#include "game/net/peer/peer_trace.h"

#include <nlohmann/json.hpp>

#include "game/net/trace_lines.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 2;  // 2: its player's trace is that of a bot

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
  if (header.at("is_watched").get<bool>()) trace.player = read_bots_lines(reader);
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
  if (trace.player) write_lines(writer, *trace.player);
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
