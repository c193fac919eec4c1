// A federation execution's record of one federate, from its joining to its leaving.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rti/baselines/entry_values.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federate_ambassador.h"
#include "rti/federation/datagram_channel.h"
#include "rti/federation/outbox.h"
#include "rti/fom/fom.h"
#include "rti/handles.h"
#include "rti/management/federation_report.h"
#include "rti/objects/object_map.h"
#include "rti/ownership/holding.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"
#include "rti/wire/entry_block.h"
#include "rti/wire/stamp_steps.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Vectors by class are of fixed size.
struct JoinedFederate {
  bool is_joined = false, is_watching = false;
  bool has_notice = false;  ///< for the host, which has not taken it yet
  ConnectionId connection = 0;
  FederateHandle handle;
  std::uint32_t block = 0;  ///< of its objects' handles
  std::string name, type;
  Outbox outbox;
  double last_sent = 0.0;
  std::uint64_t objects_deleted = 0, objects_removed = 0, objects_discovered = 0;
  FederateCounts counts;            ///< what is counted as it happens; `report` adds the rest
  std::uint32_t frames = 0;         ///< sent to it
  std::uint64_t times_updated = 0;  ///< flushes that sent it values at its turn
  StampSteps stamp_steps;           ///< of these frames
  EntryValues entry_values;         ///< of entries in these frames
  EntryHeader entry_header;         ///< of the last block of entries in these frames
  bool has_stream_only = false;     ///< no datagrams, whatever its connection could carry
  bool was_restored = false;        ///< its datagrams may be older than the restore
  std::unique_ptr<DatagramChannel> channel;  ///< null until it has one
};

/// What outlasts the connection.
template <class Stream>
bool keep(Stream& stream, JoinedFederate& federate) {
  return keep_all(stream, federate.is_joined, federate.is_watching, federate.handle, federate.block,
                  federate.name, federate.type, federate.outbox);
}

}  // namespace rink::rti
