// A network under a virtual clock: bytes arrive when a model of the link says so, in the same order
// in every run.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rti/transport/modelled/delayed_acknowledgements.h"
#include "rti/transport/modelled/line_identity.h"
#include "rti/transport/report_queue.h"
#include "rti/transport/transport.h"

namespace rink::rti {

/// What becomes of a write on a reliable line: it arrives at `instant_ns`, or its sender gives up
/// then.
struct Delivery {
  std::int64_t instant_ns = 0;
  bool is_given_up = false;
};

/// When a datagram arrives: not at all, once or twice.
class DatagramArrivals {
 public:
  void add(std::int64_t instant_ns) {
    assert(count_ < instants_ns_.size());
    instants_ns_[count_++] = instant_ns;
  }
  const std::int64_t* begin() const { return instants_ns_.data(); }
  const std::int64_t* end() const { return instants_ns_.data() + count_; }

 private:
  std::array<std::int64_t, 2> instants_ns_{};
  std::size_t count_ = 0;
};

/// Decides when sent bytes arrive. Lines are reliable and ordered, as TCP's are, so every effect on
/// a packet shows as delay; datagrams can be lost, doubled and reordered.
class LinkModel {
 public:
  virtual ~LinkModel() = default;
  /// The instant [ns] at which `size` bytes sent at `now_ns` over `line` arrive, not before
  /// `now_ns`. Lines are numbered in order of connecting, each direction apart, so that a model may
  /// keep a queue for each. The network delays writes that would overtake others.
  virtual std::int64_t arrival_ns(std::uint32_t line, std::int64_t now_ns, std::size_t size) = 0;

  /// A new line, before anything is sent on it.
  virtual void open_line(std::uint32_t, const LineIdentity&) {}
  /// `arrival_ns` for models in which senders may give up.
  virtual Delivery deliver(std::uint32_t line, std::int64_t now_ns, std::size_t size) {
    return {arrival_ns(line, now_ns, size), false};
  }
  /// The arrivals of a datagram, which may be lost, come twice and overtake others.
  virtual DatagramArrivals datagram(std::uint32_t line, std::int64_t now_ns, std::size_t size) {
    DatagramArrivals arrivals;
    arrivals.add(arrival_ns(line, now_ns, size));
    return arrivals;
  }
  /// Bytes sent on `line` that have not left the sender at `now_ns`.
  virtual std::size_t queued_bytes(std::uint32_t, std::int64_t) const { return 0; }
};

/// Every byte takes the same time.
class ConstantDelay final : public LinkModel {
 public:
  /// `delay_ns`, 0 or more.
  explicit ConstantDelay(std::int64_t delay_ns) : delay_ns_(delay_ns) { assert(delay_ns >= 0); }
  std::int64_t arrival_ns(std::uint32_t, std::int64_t now_ns, std::size_t) override {
    return now_ns + delay_ns_;
  }

 private:
  std::int64_t delay_ns_;
};

class VirtualEndpoint;

/// Longest payload of a datagram: what an Ethernet packet of 1500 bytes leaves after the headers of
/// IPv4 and UDP.
inline constexpr std::size_t virtual_datagram_max = 1472;

/// The clock and the network between endpoints; must outlive them. A discrete-event queue ordered
/// by (instant, order of sending). Only `advance_to` moves the clock, in whole nanoseconds, so that
/// no sum of delays is ever rounded. All use one thread.
class VirtualNetwork {
 public:
  /// The clock starts at `now_ns`; `model` must outlive the network. `queue_max` [bytes]: what may
  /// wait at a sender whose line is slow before it is closed.
  explicit VirtualNetwork(LinkModel& model, std::int64_t now_ns = 0,
                          std::size_t queue_max = 64u << 20)
      : model_(model), now_ns_(now_ns), queue_max_(queue_max) {}
  VirtualNetwork(const VirtualNetwork&) = delete;
  VirtualNetwork& operator=(const VirtualNetwork&) = delete;

  std::int64_t now_ns() const { return now_ns_; }
  double now_s() const { return 1e-9 * static_cast<double>(now_ns_); }
  /// When something next arrives anywhere; nothing if nothing is under way.
  std::optional<std::int64_t> next_arrival_ns() const;
  /// Moves the clock to `until_ns`, not before now; what has arrived by then waits for its
  /// receiver's `poll`.
  void advance_to(std::int64_t until_ns);
  /// Opens channels for datagrams beside the reliable lines.
  void carry_datagrams() { carries_datagrams_ = true; }
  /// How much has arrived since the beginning.
  std::uint64_t arrival_count() const { return arrived_; }
  /// Asserts the order of what is under way, and that no parcel is free twice or free and under
  /// way.
  void check() const;

 private:
  friend class VirtualEndpoint;
  enum class Kind : std::uint8_t { request, open, bytes, datagram, close };
  /// Something on its way, or arrived and waiting.
  struct Parcel {
    Kind kind = Kind::bytes;
    CloseReason reason = CloseReason::closed_by_peer;
    ConnectionId connection = 0;          ///< the receiver's number
    VirtualEndpoint* receiver = nullptr;  ///< null if it no longer exists
    std::vector<std::byte> bytes;
    std::string detail;
  };
  struct Arrival {
    std::int64_t instant_ns;
    std::uint64_t number;  ///< of sending
    std::uint32_t parcel;
    bool operator<(const Arrival& other) const {
      return instant_ns != other.instant_ns ? instant_ns > other.instant_ns : number > other.number;
    }
  };

  /// A parcel to fill; its buffer has been used before, so that steady traffic allocates nothing.
  std::uint32_t take_parcel();
  void return_parcel(std::uint32_t parcel);
  void dispatch(std::uint32_t parcel, std::int64_t instant_ns);
  void arrive(std::uint32_t parcel);
  void forget(const VirtualEndpoint* endpoint);

  LinkModel& model_;
  std::int64_t now_ns_;
  std::size_t queue_max_;
  bool carries_datagrams_ = false;
  std::uint64_t sent_ = 0, arrived_ = 0;
  std::uint32_t next_line_ = 0;
  std::map<std::string, VirtualEndpoint*> listeners_;
  std::map<std::string, std::uint32_t>
      link_counts_;  ///< by listener, also for names without a listener
  std::vector<Parcel> parcels_;
  std::vector<std::uint32_t> free_;
  std::vector<Arrival> arrivals_;  ///< a heap, earliest first
};

/// One end: a server's, or that of any number of clients. `poll` never waits, since it may not move
/// the clock.
class VirtualEndpoint final : public Transport {
 public:
  explicit VirtualEndpoint(VirtualNetwork& network) : network_(network) {}
  ~VirtualEndpoint() override;
  VirtualEndpoint(const VirtualEndpoint&) = delete;
  VirtualEndpoint& operator=(const VirtualEndpoint&) = delete;

  /// Others may connect to `name` from now on. Throws TransportError in_use if the name is taken.
  void listen(const std::string& name);
  /// The listener's `on_open` follows when the request has arrived there, ours when its answer is
  /// back; `on_close` with `refused` if nobody listens.
  ConnectionId connect(const std::string& name);
  /// True if something has arrived that `poll` would report.
  bool has_arrivals() const { return !inbox_.is_empty(); }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  TransportCounters counters(ConnectionId connection) const override;
  /// `virtual_datagram_max` once the connection has been reported open here, if the network carries
  /// datagrams; each then arrives once, twice or never, in any order, as the model says. They share
  /// a limited rate with the reliable bytes and nothing else.
  std::size_t datagram_max(ConnectionId connection) const override;
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override;
  /// Of all connections, closed ones included; nothing is queued.
  TransportCounters totals() const;

 private:
  friend class VirtualNetwork;
  struct Line {
    VirtualEndpoint* peer = nullptr;
    ConnectionId peer_connection = 0;
    std::uint32_t number = 0;  ///< the model's
    bool is_open = false;      ///< may send and receive
    bool is_reported = false;  ///< `on_open` was called: datagrams may be sent, and those that came
                               ///< before are lost
    bool is_given_up = false;  ///< nothing gets through: closed once the sender has noticed
    std::int64_t last_ns = 0;  ///< nothing sent from here arrives before this
    TransportCounters counters;
    DelayedAcknowledgements acknowledgements;
  };
  ConnectionId add_line(VirtualEndpoint* peer, const LineIdentity& identity);
  /// A parcel that reports to this end why `connection` has closed; not yet on its way.
  std::uint32_t closing(ConnectionId connection, CloseReason reason);
  void post(Line& line, std::uint32_t parcel, VirtualNetwork::Kind kind);
  void give_up(Line& line, std::int64_t instant_ns);
  void overflow(ConnectionId connection);
  std::uint32_t packed(std::span<const Bytes> parts, std::size_t size);
  void report(std::uint32_t number, TransportListener& listener);
  void report_datagram(Line& line, ConnectionId connection, TransportListener& listener);

  VirtualNetwork& network_;
  std::string name_;
  std::vector<Line> lines_;           ///< by connection
  ReportQueue<std::uint32_t> inbox_;  ///< parcels that have arrived
  std::vector<std::byte> delivering_;
  TransportCounters totals_;
};

}  // namespace rink::rti
