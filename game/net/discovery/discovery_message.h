// What a window asks all of a local network, and what hosts of matches answer (docs/play.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "rti/transport/multicast/multicast_socket.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// 239.255.82.75 and ff02::524b, at UDP port 4712.
rti::MulticastGroup discovery_group();

inline constexpr std::uint8_t discovery_version = 1;
/// Of query and answer alike: nobody can make hosts send more than they are sent.
inline constexpr std::size_t discovery_size = 64;
inline constexpr std::size_t match_name_size_max = 32;
using DiscoveryBytes = std::array<std::byte, discovery_size>;

/// "Who hosts a match?"
struct DiscoveryQuery {
  std::uint64_t number = 0;  ///< drawn at random; the answer repeats it
};

struct DiscoveryAnswer {
  std::uint64_t number = 0;    ///< of the query
  std::uint64_t host = 0;      ///< drawn at random by each host: tells two of one name apart
  std::uint16_t port = 0;      ///< of TCP, where players join
  std::uint16_t protocol = 0;  ///< its version of the RTI's protocol
  std::string name;            ///< as match_name() gives it
};

/// `name` without control characters, cut to match_name_size_max bytes at a character's end; UTF-8.
std::string match_name(const std::string& name);

DiscoveryBytes encoded(const DiscoveryQuery& query);
/// `answer.name` must be a match_name() (asserted).
DiscoveryBytes encoded(const DiscoveryAnswer& answer);
/// Nothing of bytes that are not exactly such a message of this version.
std::optional<DiscoveryQuery> query_of(rti::Bytes bytes);
std::optional<DiscoveryAnswer> answer_of(rti::Bytes bytes);

}  // namespace rink::game
