// Turns options into settings.
#include "game/net/peer/interest/viewing_options.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "game/model/report_fields.h"
#include "game/net/peer/network/seating.h"
#include "game/net/view.h"
#include "im/filter.h"

namespace rink::game {

std::string objection_to(const std::string& scheme) {
  if (const auto complaint = im::complaint_about(scheme, {})) return *complaint;
  const im::Traits traits = im::make_filter(scheme, {})->traits();
  if (!traits.uses_facts && !traits.uses_time) return "";
  return "'" + scheme +
         "' asks for velocities, headings, kinds or ages, which peers do not hand in: "
         "expected a condition on places and roles";
}

void require_viewing(const Terms& terms, const ViewingOptions& options, const SharedGame& game,
                     std::uint32_t bots) {
  if (!options.always.empty() && !im::names_scheme(terms.interest.scheme, "always"))
    throw std::invalid_argument(
        "--always: " +
        (terms.interest.scheme.empty()
             ? "there is no scheme that could ask"
             : "the scheme '" + terms.interest.scheme + "' does not name always") +
        ": expected one that does, such as --scheme \"region or always\"");
  if (!terms.is_seated) return;
  if (bots > 0)
    throw std::invalid_argument(
        "--bots: with --seated each peer's player is the bat in its zone, whose keys all know "
        "(--keys): expected no --bots");
  if (terms.peer_count > game.bat_count())
    throw std::invalid_argument("--seated: " + std::to_string(terms.peer_count) +
                                " peers, but the scene has " + std::to_string(game.bat_count()) +
                                " bats: expected at least one for each");
}

Viewing make_viewing(const SharedGame& game, PeerNetwork& network, const ViewingOptions& options,
                     double (*now_s)()) {
  const Terms& terms = network.terms();
  const bool wants_trace = !options.trace.empty();
  if (wants_trace && (!terms.is_seated || !terms.interest.is_wanted() || terms.is_replicated ||
                      terms.balance_windows > 0 || !terms.starts_together))
    throw std::invalid_argument(
        "--evidence: it is of a player who looks beyond what its peer has, among peers who stay as "
        "they are: expected a first peer with --scheme, --seated, --unmirrored, --balance 0 and "
        "--evidence");
  if (wants_trace && options.warm_up_s >= terms.until)
    throw std::invalid_argument("--warm-up: the game ends at " + std::to_string(terms.until) +
                                " s: expected less");
  if (!terms.interest.is_wanted()) return {};
  const physics::Field& field = game.scene().world.field;
  const double half_side =
      view_half_side(options.view_area, options.view_fraction, field.length, field.width);
  const InterestSettings settings =
      interest_settings(game.start(), terms, network.peer_infos(), half_side, options.view_margin);
  if (!wants_trace) return {std::make_unique<Viewer>(game, settings, network), nullptr};
  const SamplingSettings sampling{.seed = options.evidence_seed,
                                  .clients = terms.peer_count,
                                  .from_s = options.warm_up_s,
                                  .until_s = terms.until};
  auto recorder = std::make_unique<RunRecorder>(game, settings, network, sampling, now_s);
  RunRecorder* const itself = recorder.get();
  return {std::move(recorder), itself};
}

nlohmann::ordered_json report_of(const rti::TransportCounters& counters) {
  const auto or_null = [](const std::optional<std::uint64_t>& count) {
    return count ? nlohmann::ordered_json(*count) : nlohmann::ordered_json(nullptr);
  };
  return {{report::bytes_sent, counters.bytes_sent},
          {report::bytes_received, counters.bytes_received},
          {report::kernel_bytes_sent, or_null(counters.kernel_bytes_sent)},
          {report::kernel_bytes_received, or_null(counters.kernel_bytes_received)}};
}

nlohmann::ordered_json report_of(const Viewer& viewer) {
  nlohmann::ordered_json report;
  for (const Traffic about : {Traffic::interest, Traffic::updates, Traffic::keys}) {
    const auto k = static_cast<std::size_t>(about);
    report[report::traffic_bytes[k].key] = viewer.sent()[k];
    report[std::string(traffic_names[k]) + "_messages"] = viewer.messages_sent()[k];
  }
  report["in_view"] = viewer.in_view();
  report["told_of"] = viewer.told_of();
  return report;
}

}  // namespace rink::game
