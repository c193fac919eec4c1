// Reads the decisions from the RTI without deciding again.
#include "game/net/server/interest_report.h"

#include <algorithm>

#include "game/net/interest_codec.h"
#include "rti/wire/stream.h"

namespace rink::game {
namespace {

/// Cuts the lists so that the answer fits its limit.
void cut(InterestSeen& seen) {
  if (seen.views.size() > interest_views_max) seen.views.resize(interest_views_max);
  rti::Measurer measurer;
  std::vector<std::uint32_t> heard;
  heard.swap(seen.heard);
  exchange(measurer, seen);
  std::size_t bytes = measurer.size(), count = 0;
  for (std::uint32_t before = 0; count < heard.size(); before = heard[count++]) {
    bytes += varint_size(heard[count] - before);
    if (bytes > interest_bytes_max) break;
  }
  heard.resize(count);
  heard.swap(seen.heard);
}

}  // namespace

InterestSeen interest_report(const Server& server, const rti::FederationExecution& execution,
                             rti::ObjectHandle asked) {
  std::vector<rti::SubscribedRegion> regions;
  execution.list_subscribed_regions(regions);
  InterestSeen seen{.asked = asked.value,
                    .cell_size = static_cast<float>(execution.filter().cell_size()),
                    .views = {},
                    .heard = {}};
  for (const auto& [federate, bounds] : regions) {
    const rti::ObjectHandle bat = server.bat_of(federate);
    if (!bat) continue;  // a watcher is no part of the experiment
    seen.views.push_back({.bat = bat.value,
                          .hears = execution.is_in_scope(federate, asked),
                          .low_x = static_cast<float>(bounds.low_x),
                          .low_y = static_cast<float>(bounds.low_y),
                          .high_x = static_cast<float>(bounds.high_x),
                          .high_y = static_cast<float>(bounds.high_y)});
    if (seen.views.back().hears) ++seen.hearer_count;
    if (bat != asked) continue;
    std::vector<rti::ObjectHandle> scope;
    execution.list_scope(federate, scope);
    for (const rti::ObjectHandle object : scope)
      if (server.publisher().is_entity(object)) seen.heard.push_back(object.value);
  }
  std::ranges::sort(seen.heard);
  seen.view_count = static_cast<std::uint32_t>(seen.views.size());
  seen.heard_count = static_cast<std::uint32_t>(seen.heard.size());
  cut(seen);
  return seen;
}

}  // namespace rink::game
