// Which line of a modelled network something is said of.
#pragma once

#include <cstdint>
#include <string_view>

namespace rink::rti {

enum class LinkDirection : std::uint8_t { to_listener, from_listener };

/// Which line this is, whatever else is connected: the `link`-th to connect to `listener`, from 0,
/// and the direction.
struct LineIdentity {
  std::string_view listener;
  std::uint32_t link = 0;
  LinkDirection direction = LinkDirection::to_listener;
};

}  // namespace rink::rti
