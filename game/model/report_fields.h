// The fields of reports that one process writes and another reads, or that several write: their
// names and types. docs/metrics.md defines them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rink::game {

/// `Held` is the type of the value.
template <class Held>
struct ReportField {
  const char* key;
  operator const char*() const { return key; }
};

/// Durations, as Histogram writes them.
struct Durations {};

using AmountField = ReportField<double>;  ///< 0 or more
using CountField = ReportField<std::uint64_t>;
using TextField = ReportField<std::string>;
using TruthField = ReportField<bool>;
using DurationsField = ReportField<Durations>;
using AmountsField = ReportField<std::vector<double>>;

namespace report {

// Fields of a server, of peers in its place, and in part of the bots.
inline constexpr TextField mode{"mode"}, scheme{"scheme"}, policy{"policy"};
inline constexpr AmountField threshold{"threshold"}, clients{"clients"},
    tick_rate_hz{"tick_rate_hz"}, output_rate_hz{"output_rate_hz"};
inline constexpr CountField seed{"seed"}, ticks{"ticks"};
inline constexpr AmountField ticks_on_time_fraction{"ticks_on_time_fraction"},
    physics_us_per_tick{"physics_us_per_tick"}, filter_us_per_tick{"filter_us_per_tick"},
    send_us_per_tick{"send_us_per_tick"}, measured_s{"measured_s"};
inline constexpr CountField server_rss_bytes{"server_rss_bytes"}, evidence_bytes{"evidence_bytes"},
    entities{"entities"};
inline constexpr TruthField valid{"valid"};
inline constexpr TextField why_invalid{"why_invalid"}, state_hash{"state_hash"};
inline constexpr AmountField bytes_sent{"bytes_sent"}, bytes_received{"bytes_received"},
    writes_sent{"writes_sent"}, messages_sent{"messages_sent"}, segments_sent{"segments_sent"},
    acknowledgements_sent{"acknowledgements_sent"}, kernel_segments_sent{"kernel_segments_sent"},
    header_bytes_sent{"header_bytes_sent"},  // of datagrams, by who sends no segments
    state_bytes_sent{"state_bytes_sent"}, key_bytes_received{"key_bytes_received"},
    physics_events{"physics_events"};
inline constexpr CountField lost_federates{"lost_federates"},
    dropped_connections{"dropped_connections"}, keys_over_limit{"keys_over_limit"};

/// Where the payload goes, an array of objects: direction, channel, form, field, bits, times.
inline constexpr const char* bytes_by_field = "bytes_by_field";

// Totals from first to last, as counted here and by the kernel.
inline constexpr AmountField total_bytes_sent{"total_bytes_sent"},
    total_bytes_received{"total_bytes_received"}, kernel_bytes_sent{"kernel_bytes_sent"},
    kernel_bytes_received{"kernel_bytes_received"};

// Fields of the bots.
inline constexpr DurationsField update_age_ms{"update_age_ms"},
    key_to_effect_ms{"key_to_effect_ms"}, send_lateness_ms{"send_lateness_ms"};
inline constexpr CountField keys_due{"keys_due"}, keys_sent{"keys_sent"},
    keys_unanswered{"keys_unanswered"}, federates_lost{"federates_lost"};
inline constexpr AmountField late_sends_fraction{"late_sends_fraction"}, cpu_share{"cpu_share"},
    histogram_ns_per_record{"histogram_ns_per_record"};
inline constexpr TextField schedule_trouble{"schedule_trouble"};
inline constexpr AmountsField bytes_received_by_bot{"bytes_received_by_bot"};

// Fields of a node: what it sent each of them, by number; and of all nodes together, with headers.
inline constexpr AmountsField node_bytes_sent{"node_bytes_sent"},
    node_segments_sent{"node_segments_sent"},
    node_acknowledgements_sent{"node_acknowledgements_sent"},
    node_kernel_segments_sent{"node_kernel_segments_sent"};
inline constexpr AmountField between_nodes_bytes{"between_nodes_bytes"};

// Fields of peers together; the bytes are in the order of game::Traffic.
inline constexpr std::array<AmountField, 7> traffic_bytes{
    AmountField{"halo_bytes"},     AmountField{"claims_bytes"},  AmountField{"agreement_bytes"},
    AmountField{"interest_bytes"}, AmountField{"updates_bytes"}, AmountField{"keys_bytes"},
    AmountField{"standby_bytes"}};
inline constexpr AmountField busiest_node_bytes{"busiest_node_bytes"},
    busiest_link_bytes{"busiest_link_bytes"},  // with headers and acknowledgements, both ways
    busiest_node_events{"busiest_node_events"};

// Fields of one peer's process.
inline constexpr CountField windows{"windows"}, repeats{"repeats"}, own_events{"own_events"},
    ghost_events{"ghost_events"}, hand_overs{"hand_overs"}, held_max{"held_max"},
    rss_bytes{"rss_bytes"};
inline constexpr AmountField mean_ghosts{"mean_ghosts"};
inline constexpr TextField hash{"hash"};
/// The traffic of its connections, an object.
inline constexpr const char* transport = "transport";

}  // namespace report
}  // namespace rink::game
