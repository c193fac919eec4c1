// What a federation execution keeps of one federate, from its joining to its leaving.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federate_ambassador.h"
#include "rti/federation/datagram_way.h"
#include "rti/federation/outbox.h"
#include "rti/fom/fom.h"
#include "rti/handles.h"
#include "rti/management/federation_report.h"
#include "rti/objects/object_map.h"
#include "rti/ownership/holding.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// Vectors by class are of fixed size.
struct JoinedFederate {
  bool is_joined = false, is_watching = false;
  ConnectionId connection = 0;
  FederateHandle handle;
  std::uint32_t block = 0;                       ///< of its objects' handles
  std::uint32_t objects_registered = 0;          ///< in that block
  std::optional<std::uint32_t> further_block{};  ///< that it was given for when this one is used up
  std::vector<std::uint32_t> former_blocks{};    ///< used up
  std::size_t name_bytes = 0;                    ///< of their names
  std::string name, type;
  std::vector<Subscription>
      told_relevance;  ///< what it was told that others hear, by row of `Relevance`
  std::unique_ptr<ObjectMap<AttributeSet>>
      told_objects;  ///< likewise of objects, if it asked for it: those that others hear
  Outbox outbox;
  ResignAction resign_action = ResignAction::cancel_then_delete_then_divest;
  double last_said = 0.0;
  double report_period = 0.0;  ///< of its HLAfederate object [s]; 0: none
  double lookahead = 0.0;      ///< as it last asked for [s]
  bool is_advancing = false;   ///< in logical time
  std::uint64_t objects_deleted = 0, objects_removed = 0, objects_discovered = 0;
  FederateCounts counts;             ///< what is counted as it happens; `report` adds the rest
  std::uint32_t frames = 0;          ///< sent to it
  bool has_stream_only = false;      ///< no datagrams, whatever its connection could carry
  std::unique_ptr<DatagramWay> way;  ///< null until it has one
};

}  // namespace rink::rti
