// The bots' evidence as lines: a header, one line per watched bot, one per sampled mirror.
#include "loadgen/bots_evidence.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "game/net/evidence_lines.h"

namespace rink::loadgen {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 1;
constexpr double nanometres = 1e9;

std::int64_t rounded(double number, double parts) { return std::llround(std::clamp(number, -1e9, 1e9) * parts); }

void add_position(Json& entry, const physics::Vector2& position) {
  entry.push_back(rounded(position.x(), nanometres));
  entry.push_back(rounded(position.y(), nanometres));
}

/// Object and bytes; where it was in scope, also where it was believed to be at the matched instant, and where at the displayed one if that differs.
Json entry_of(const BotsEvidence::Belief& belief) {
  Json entry = Json::array({belief.object, belief.bytes});
  if (!belief.is_in_scope) return entry;
  add_position(entry, belief.matched);
  if (belief.displayed != belief.matched) add_position(entry, belief.displayed);
  return entry;
}

physics::Vector2 position_in(const nlohmann::json& entry, std::size_t at) {
  return {static_cast<double>(entry.at(at).get<std::int64_t>()) / nanometres, static_cast<double>(entry.at(at + 1).get<std::int64_t>()) / nanometres};
}

BotsEvidence::Belief belief_in(const nlohmann::json& entry, const game::EvidenceReader& reader) {
  if (entry.size() != 2 && entry.size() != 4 && entry.size() != 6) reader.refuse("an entity as object, bytes and no, one or two positions");
  BotsEvidence::Belief belief{.object = entry.at(0), .bytes = entry.at(1), .is_in_scope = entry.size() > 2};
  if (entry.size() > 2) belief.matched = belief.displayed = position_in(entry, 2);
  if (entry.size() > 4) belief.displayed = position_in(entry, 4);
  return belief;
}

Json line_of(const BotsEvidence::Bot& bot) {
  Json changes = Json::array();
  for (const BotsEvidence::ScopeChange& change : bot.changes) changes.push_back({rounded(change.instant_s, 1e6), change.object, change.is_in ? 1 : 0});
  return {{"bat", bot.object}, {"changes_us", changes}};
}

Json line_of(const BotsEvidence& evidence, const BotsEvidence::Sample& sample) {
  Json entities = Json::array();
  for (std::size_t i = sample.first; i < sample.last; ++i) entities.push_back(entry_of(evidence.beliefs[i]));
  return {{"bot", sample.bot}, {"displayed_s", sample.displayed_s}, {"matched_s", sample.matched_s}, {"window_s", sample.window_s}, {"entities_nm", entities}};
}

BotsEvidence read_lines(game::EvidenceReader& reader) {
  BotsEvidence evidence;
  const nlohmann::json header = reader.next();
  reader.require_version(header.value("rink-bots-evidence", 0), version, "the bots' evidence");
  evidence.clients = header.at("clients");
  evidence.from_s = header.at("from_s");
  evidence.until_s = header.at("until_s");
  evidence.is_complete = header.at("is_complete");
  for (std::size_t i = 0; i < header.at("bots").get<std::size_t>(); ++i) {
    const nlohmann::json line = reader.next();
    BotsEvidence::Bot& bot = evidence.bots.emplace_back();
    bot.object = line.at("bat");
    for (const nlohmann::json& change : line.at("changes_us")) bot.changes.push_back({1e-6 * change.at(0).get<double>(), change.at(1), change.at(2).get<int>() != 0});
  }
  for (std::size_t i = 0; i < header.at("samples").get<std::size_t>(); ++i) {
    const nlohmann::json line = reader.next();
    const std::size_t first = evidence.beliefs.size();
    for (const nlohmann::json& entry : line.at("entities_nm")) evidence.beliefs.push_back(belief_in(entry, reader));
    evidence.samples.push_back({.bot = line.at("bot"), .displayed_s = line.at("displayed_s"), .matched_s = line.at("matched_s"), .window_s = line.at("window_s"),
                                .first = first, .last = evidence.beliefs.size()});
    if (evidence.samples.back().bot >= evidence.bots.size()) reader.refuse("a bot below " + std::to_string(evidence.bots.size()));
  }
  return evidence;
}

}  // namespace

void write_evidence(const std::string& file, const BotsEvidence& evidence) {
  game::EvidenceWriter writer(file);
  writer.line({{"rink-bots-evidence", version}, {"clients", evidence.clients}, {"from_s", evidence.from_s}, {"until_s", evidence.until_s}, {"is_complete", evidence.is_complete},
               {"bots", evidence.bots.size()}, {"samples", evidence.samples.size()}});
  for (const BotsEvidence::Bot& bot : evidence.bots) writer.line(line_of(bot));
  for (const BotsEvidence::Sample& sample : evidence.samples) writer.line(line_of(evidence, sample));
  writer.finish();
}

BotsEvidence read_bots_evidence(const std::string& file) {
  game::EvidenceReader reader(file);
  try {
    return read_lines(reader);
  } catch (const nlohmann::json::exception& error) {
    reader.refuse(std::string("the bots' evidence as docs/metrics.md describes it (") + error.what() + ")");
  }
}

}  // namespace rink::loadgen
