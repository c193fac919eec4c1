// A network under a virtual clock: bytes arrive when a model of the link says so, in the same order in every run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rti/transport/transport.h"

namespace rink::rti {

/// Decides when what is sent arrives. Lines are reliable and ordered, as TCP's are, so whatever a model does to a packet shows as delay.
class LinkModel {
 public:
  virtual ~LinkModel() = default;
  /// The instant [ns] at which `size` bytes sent at `now_ns` over `line` arrive, not before `now_ns`. Lines are numbered in order of connecting, each direction
  /// apart, so that a model may seed a generator or keep a queue for each. The network delays further what would overtake.
  virtual std::int64_t arrival_ns(std::uint32_t line, std::int64_t now_ns, std::size_t size) = 0;
};

/// Every byte takes the same time.
class ConstantDelay final : public LinkModel {
 public:
  /// `delay_ns`, 0 or more.
  explicit ConstantDelay(std::int64_t delay_ns) : delay_ns_(delay_ns) {}
  std::int64_t arrival_ns(std::uint32_t, std::int64_t now_ns, std::size_t) override { return now_ns + delay_ns_; }

 private:
  std::int64_t delay_ns_;
};

class VirtualEndpoint;

/// The clock and the air between endpoints; must outlive them. A discrete-event queue ordered by (instant, order of sending). The clock stands still but in
/// `advance_to`; whole nanoseconds, so that no sum of delays is ever rounded. One thread for all.
class VirtualNetwork {
 public:
  /// The clock starts at `now_ns`; `model` must outlive the network.
  explicit VirtualNetwork(LinkModel& model, std::int64_t now_ns = 0) : model_(model), now_ns_(now_ns) {}
  VirtualNetwork(const VirtualNetwork&) = delete;
  VirtualNetwork& operator=(const VirtualNetwork&) = delete;

  std::int64_t now_ns() const { return now_ns_; }
  double now_s() const { return 1e-9 * static_cast<double>(now_ns_); }
  /// When something next arrives anywhere; nothing if nothing is under way.
  std::optional<std::int64_t> next_arrival_ns() const;
  /// Moves the clock to `until_ns`, not before now; what has arrived by then waits for its receiver's `poll`.
  void advance_to(std::int64_t until_ns);

 private:
  friend class VirtualEndpoint;
  enum class Kind : std::uint8_t { request, open, bytes, close };
  /// Something on its way, or arrived and waiting.
  struct Parcel {
    Kind kind = Kind::bytes;
    CloseReason reason = CloseReason::closed_by_peer;
    ConnectionId connection = 0;          ///< the receiver's number
    VirtualEndpoint* receiver = nullptr;  ///< null if it is no more
    std::vector<std::byte> bytes;
    std::string detail;
  };
  struct Arrival {
    std::int64_t instant_ns;
    std::uint64_t number;  ///< of sending
    std::uint32_t parcel;
    bool operator<(const Arrival& other) const { return instant_ns != other.instant_ns ? instant_ns > other.instant_ns : number > other.number; }
  };

  /// A parcel to fill; its buffer has been used before, so that steady traffic allocates nothing.
  std::uint32_t take_parcel();
  void return_parcel(std::uint32_t parcel);
  void dispatch(std::uint32_t parcel, std::int64_t instant_ns);
  void arrive(std::uint32_t parcel);
  void forget(const VirtualEndpoint* endpoint);

  LinkModel& model_;
  std::int64_t now_ns_;
  std::uint64_t sent_ = 0;
  std::uint32_t next_line_ = 0;
  std::map<std::string, VirtualEndpoint*> listeners_;
  std::vector<Parcel> parcels_;
  std::vector<std::uint32_t> free_;
  std::vector<Arrival> arrivals_;  ///< a heap, earliest first
};

/// One end: a server's, or that of any number of clients. `poll` never waits: the clock is not its to move.
class VirtualEndpoint final : public Transport {
 public:
  explicit VirtualEndpoint(VirtualNetwork& network) : network_(network) {}
  ~VirtualEndpoint() override;
  VirtualEndpoint(const VirtualEndpoint&) = delete;
  VirtualEndpoint& operator=(const VirtualEndpoint&) = delete;

  /// Others may connect to `name` from now on. Throws TransportError in_use if the name is taken.
  void listen(const std::string& name);
  /// The listener's `on_open` follows when the request has arrived there, ours when its answer is back; `on_close` with `refused` if nobody listens.
  ConnectionId connect(const std::string& name);
  /// True if something has arrived that `poll` would report.
  bool has_arrivals() const { return !inbox_.empty(); }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  TransportCounters counters(ConnectionId connection) const override;
  /// Of all connections, closed ones included; nothing is queued.
  const TransportCounters& totals() const { return totals_; }

 private:
  friend class VirtualNetwork;
  struct Line {
    VirtualEndpoint* peer = nullptr;
    ConnectionId peer_connection = 0;
    std::uint32_t number = 0;       ///< the model's
    bool is_open = false;           ///< may send, and hears
    std::int64_t last_ns = 0;       ///< nothing sent from here arrives before this
    TransportCounters counters;
  };
  ConnectionId add_line(VirtualEndpoint* peer);
  /// A parcel that tells this end why `connection` is no more; not yet on its way.
  std::uint32_t closing(ConnectionId connection, CloseReason reason);
  void post(Line& line, std::uint32_t parcel, VirtualNetwork::Kind kind);
  void report(std::uint32_t number, TransportListener& listener);

  VirtualNetwork& network_;
  std::string name_;
  std::vector<Line> lines_;  ///< by connection
  std::vector<std::uint32_t> inbox_, reporting_;  ///< parcels that have arrived
  std::vector<std::byte> delivering_;
  TransportCounters totals_;
};

}  // namespace rink::rti
