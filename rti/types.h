// The arguments of services and callbacks: sets, stamps and times, regions, choices.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "im/region.h"
#include "rti/handle_set.h"
#include "rti/handles.h"

namespace rink::rti {

/// A bit for each attribute of a class. Two machine words hold the widest class of the published
/// models (88 attributes) and still travel in registers.
using AttributeBits = unsigned __int128;
/// Attributes of one object class.
using AttributeSet = HandleSet<AttributeHandle, AttributeBits>;
/// Handles of attributes are below it. The topmost bit is free, so that a set's bits from 63 on fit
/// one word (rti/wire/attribute_bits.h).
inline constexpr std::uint32_t attribute_max = AttributeSet::capacity - 1;
/// Every object has this attribute, HLAprivilegeToDeleteObject, whether its class names it or not:
/// its owner may delete the object. It has no value, every federate that publishes any attribute of
/// a class publishes it, and only ownership management names it. Its number is above those of
/// classes that a word of 32 bits holds; wider classes leave that number out.
inline constexpr AttributeHandle privilege_to_delete_object{31};
/// Most attributes that a class may name, inherited ones included.
inline constexpr std::uint32_t named_attribute_max = attribute_max - 1;

/// Dimensions of one object model.
using DimensionSet = HandleSet<DimensionHandle, std::uint64_t>;
/// Most dimensions that a model may have.
inline constexpr std::uint32_t dimension_max = DimensionSet::capacity;

inline constexpr std::size_t text_max = 255;  ///< longest name or label [bytes]
inline constexpr std::size_t parameters_max =
    32 * 1024;  ///< longest parameters of one interaction [bytes]
inline constexpr std::size_t values_max =
    32 * 1024;  ///< longest values of one update as they travel [bytes]
inline constexpr std::uint32_t region_max = 1u << 18;  ///< regions of one federate
/// An object handle is the block that the RTI gave its owner, times `object_block`, plus the
/// owner's own count. A federate that has used half of its block is given a further one, so that
/// only what it has at once is limited.
inline constexpr std::uint32_t object_block = 1u << 18;
inline constexpr std::uint32_t object_block_max = 1u << 14;

enum class Transportation : std::uint8_t { reliable, best_effort };
enum class Order : std::uint8_t { receive, timestamp };

/// How a federate receives callbacks.
enum class CallbackModel : std::uint8_t {
  immediate,  ///< while bytes are received
  evoked,     ///< when it calls `evoke_callback` or `evoke_multiple_callbacks`
};

/// What happens to the attributes that a federate owns when it leaves (IEEE 1516.1-2010, 4.10 and
/// 10.4); the numbers are those on the wire.
enum class ResignAction : std::uint8_t {
  unconditionally_divest_attributes,
  delete_objects,  ///< those whose deletion it may order
  cancel_pending_ownership_acquisitions,
  delete_objects_then_divest,
  cancel_then_delete_then_divest,  ///< the default, also for a federate that is lost
  no_action,
};

/// The advisories of IEEE 1516.1-2010 that a federate may switch.
enum class Advisory : std::uint8_t {
  object_class_relevance,
  attribute_relevance,
  attribute_scope,
  interaction_relevance
};

/// When a message was sent. Carried once per run of equal stamps, not per update.
struct Stamp {
  double time = 0.0;      ///< logical time [s], the sender's
  std::uint64_t tag = 0;  ///< the sender's user-supplied tag, which the RTI only carries
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

/// An instant of logical time [s], of its own type so that a time-stamped service can't be taken
/// for the one that only carries a stamp. From 0 to below the greatest double: every instant has
/// one just above it.
struct LogicalTime {
  double value;
  explicit LogicalTime(double seconds) : value(seconds) {}
  friend auto operator<=>(const LogicalTime&, const LogicalTime&) = default;
};

/// Names a message that was sent in time-stamp order, for its sender and its receivers. Empty if it
/// went in receive order.
struct RetractionHandle {
  FederateHandle sender;
  std::uint64_t number = 0;  ///< the sender's count
  double time = 0.0;         ///< the message's time stamp
  explicit operator bool() const { return static_cast<bool>(sender); }
  friend bool operator==(const RetractionHandle&, const RetractionHandle&) = default;
};

/// What comes with a message that was sent in time-stamp order.
struct TimedStamp {
  Stamp stamp;
  bool is_in_order = false;  ///< received in time-stamp order too; else its receiver was not
                             ///< constrained, and it came as soon as it could
  RetractionHandle handle;   ///< the handle that `request_retraction` will name
};

/// A closed stretch of one dimension: ranges that touch overlap. Finite, `low <= high`.
struct Range {
  double low = 0.0, high = 0.0;
  bool overlaps(const Range& other) const { return low <= other.high && other.low <= high; }
  friend bool operator==(const Range&, const Range&) = default;
};

/// Attributes and the regions that they are published or wanted in: each attribute with each
/// region.
struct AttributeRegions {
  AttributeSet attributes;
  std::vector<RegionHandle> regions;
};

/// A region and the bounds that it shall have.
struct RegionBounds {
  RegionHandle region;
  im::Region bounds;  ///< over the dimensions X and Y [m]
};

/// One federation execution of a host.
struct FederationExecutionInformation {
  std::string federation, model;  ///< its name and that of its object model
  std::uint32_t federates = 0;    ///< joined now
  friend bool operator==(const FederationExecutionInformation&,
                         const FederationExecutionInformation&) = default;
};

/// Timeouts of a silent connection.
struct Timeouts {
  double heartbeat_s = 1.0;   ///< period of a side's heartbeat when it has nothing else to send
  double lost_after_s = 5.0;  ///< a side that was silent for so long is lost
  /// For so many times as long at most what waits unread excuses silence.
  static constexpr double excuse_max = 4.0;
};

}  // namespace rink::rti
