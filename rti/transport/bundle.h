// Many connections over one of another transport: the federates of a process share its socket, and
// one system call serves them all.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/transport.h"

namespace rink::rti {

/// A transport over a transport; both ends must have one. What is sent is gathered for each trunk
/// until the next `push` or `poll`, then goes as one write, so the peer gets a process's federates
/// with one read: a lockstep of n federates costs two system calls at either end instead of 4 n.
/// The connections share the trunk's queue in even parts, and its end: a process that does not read
/// is one slow reader. Bytes on a trunk are records: channel and size, two varints, then so many
/// bytes; `opens` or `closes` for a size is all of its record. A peer that sends anything else
/// loses its trunk.
class BundledTransport final : public Transport, private TransportListener {
 public:
  static constexpr std::uint32_t opens = 0,
                                 closes = 1;          ///< n bytes are written as n + 1
  static constexpr std::size_t channel_max = 65'536;  ///< that a peer may open on one trunk
  static constexpr std::size_t gathered_max =
      1u << 16;  ///< bytes gathered before they are sent at once
  static constexpr std::size_t queue_max =
      1u << 20;  ///< bytes queued for each channel in use of a trunk whose peer doesn't read,
                 ///< before the trunk is closed
  static constexpr std::size_t trunk_queue_max = 1u << 30;  ///< and for all together
  /// How long a peer's trunk may be without a channel before it is closed.
  static constexpr std::chrono::seconds idle_max{5};

  /// `carrier` must outlive it, and is polled by it alone. Its own limit of a queue should be that
  /// of many channels.
  explicit BundledTransport(Transport& carrier) : carrier_(carrier) {}

  /// A connection over `trunk`, one of the carrier's, which may still be opening; `on_open` follows
  /// in a poll, or `on_close` with the trunk's reason.
  ConnectionId connect(ConnectionId trunk);
  /// Whether one more connection can be made over `trunk`, which this end connected.
  bool takes_more(ConnectionId trunk) const {
    return trunk >= trunks_.size() ||
           (!trunks_[trunk].is_closed && trunks_[trunk].channels.size() < channel_max);
  }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  bool is_behind() const override { return carrier_.is_behind(); }
  /// The connection's part of its trunk's.
  std::size_t queued_bytes(ConnectionId connection) const override;
  /// Of the connection's own payload, without the records' headers; the kernel knows trunks only.
  TransportCounters counters(ConnectionId connection) const override;
  /// Whose its trunk is.
  std::string peer_network(ConnectionId connection) const override;
  void push() override;
  /// Asserts that trunks and channels refer to each other, and that trunks with gathered bytes are
  /// on the list.
  void check() const;

 private:
  static constexpr std::size_t head_number_max = 5;  ///< bytes of a channel's number, of a size
  struct Channel {
    ConnectionId trunk = 0;
    std::uint32_t number = 0;  ///< on its trunk
    bool is_open = false, is_closed = false;
    TransportCounters counters{};
  };
  struct Trunk {
    bool is_open = false, is_closed = false,
         is_ours = false;                ///< this end connected it, and numbers and opens channels
    std::vector<ConnectionId> channels;  ///< by number
    std::size_t channels_left = 0,       ///< of these, not closed yet
        channels_told = 0;               ///< and of those, have been sent something
    std::chrono::steady_clock::time_point idle_since{};  ///< without a channel
    std::vector<std::byte> gathered;
    std::byte header[2 * head_number_max] = {};
    std::size_t header_size = 0, numbers_read = 0;  ///< bytes and whole numbers of it received
    std::uint32_t number = 0, left = 0;             ///< of the present record
  };
  struct News {
    ConnectionId connection;
    bool is_open;
    CloseReason reason;
    std::string detail;
  };

  void on_open(ConnectionId trunk) override;
  void on_bytes(ConnectionId trunk, Bytes bytes) override;
  void on_close(ConnectionId trunk, CloseReason reason, const std::string& detail) override;

  Trunk& trunk(ConnectionId id);
  Channel* find(ConnectionId connection);
  ConnectionId add(ConnectionId trunk_id);
  void write_header(ConnectionId trunk_id, std::uint32_t number, std::uint32_t coded_size);
  /// Takes a byte of a header; false if none has it there.
  bool take_of_header(ConnectionId trunk_id, std::byte byte);
  void send_gathered(ConnectionId trunk_id);
  /// False if the header is invalid.
  bool handle_header(ConnectionId trunk_id);
  void end(ConnectionId connection, CloseReason reason, const std::string& detail);
  void end_all(ConnectionId trunk_id, CloseReason reason, const std::string& detail);
  void report();
  void close_idle_trunks();

  Transport& carrier_;
  std::vector<Trunk> trunks_;                       ///< by the carrier's connection
  std::vector<std::unique_ptr<Channel>> channels_;  ///< by connection; null once closed
  std::deque<std::pair<ConnectionId, TransportCounters>>
      last_counters_;               ///< of those that closed last
  std::vector<ConnectionId> full_;  ///< trunks with something gathered
  std::vector<News> news_, telling_;
  std::chrono::steady_clock::time_point looked_for_idle_{};
  TransportListener* listener_ = nullptr;  ///< while polling
};

}  // namespace rink::rti
