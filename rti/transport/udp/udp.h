// UDP beside TCP: the stream by TCP, datagrams by UDP, bound to each other so that none can be
// injected and no third party flooded (docs/wire.md, "UDP beside TCP").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "rti/transport/tcp/tcp.h"
#include "rti/transport/udp/datagram_socket.h"

namespace rink::rti {

struct UdpSettings {
  TcpSettings tcp;
  bool use_offload = true;  ///< segmentation and its reverse by the kernel, if supported
};

struct UdpCounters {
  std::uint64_t ways_opened = 0;  ///< connections whose datagrams get through
  std::uint64_t ways_failed =
      0;  ///< connections whose datagrams never did, which have the stream only
  std::uint64_t rejected_datagrams =
      0;  ///< of an unknown key, from a wrong address, or malformed: ignored, never answered
  std::uint64_t lost_datagrams = 0;  ///< that the operating system did not take
  std::uint64_t send_calls = 0;      ///< of the operating system, for datagrams
  bool uses_offload = false;         ///< the kernel cuts; false once it has refused
};

/// A TcpTransport whose connections have, after a round trip or two, a channel for datagrams. Where
/// UDP does not get through, the stream works alone. Clients of a plain TcpTransport may connect to
/// it; a client of this one needs a server of this one.
class UdpTransport final : public Transport, private TransportListener {
 public:
  explicit UdpTransport(const UdpSettings& settings = {});
  UdpTransport(const UdpTransport&) = delete;
  UdpTransport& operator=(const UdpTransport&) = delete;

  /// As TcpTransport::listen; the UDP socket takes the same port if it is free, else any.
  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  bool is_behind() const override { return tcp_.is_behind() || is_behind_; }
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;
  std::string peer_network(ConnectionId connection) const override {
    return tcp_.peer_network(connection);
  }
  std::size_t datagram_max(ConnectionId connection) const override;
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override;
  void push() override { sender_.push(); }

  /// Sum over all connections that ever were.
  TransportCounters totals() const;
  UdpCounters udp_counters() const;

 private:
  /// The kind of a datagram, in the first byte after its key.
  enum class Kind : std::uint8_t { data, hello, welcome, confirm, open };
  static constexpr std::uint32_t datagram_magic = 0x47444b52;  ///< "RKDG": no frame is that long
  static constexpr std::size_t payload_max = 1200, prefix_size = 9;
  static constexpr std::size_t magic_size = 4, greeting_size = magic_size + 2 + 8 + 8;

  /// One connection's datagrams. A server's is `undecided` until the client's first bytes show
  /// whether it asks for datagrams.
  struct Channel {
    enum class Role : std::uint8_t { undecided, none, server, client };
    enum class State : std::uint8_t { closed, hello, confirm, open };
    Role role = Role::undecided;
    State state = State::closed;
    int tries = 0;
    std::array<std::byte, greeting_size> head{};  ///< of the stream, as far as it has come
    std::size_t head_size = 0;
    std::uint64_t up_key = 0, down_key = 0, nonce = 0;
    SocketAddress address;  ///< the other end's
    std::vector<std::vector<std::byte>>
        held;  ///< writes of a server that must not come before its greeting
    std::size_t held_bytes = 0;
    File file;  ///< a client's own socket, connected
  };
  /// Corrects counters by the greeting, which is no payload, and adds the datagrams of one
  /// connection.
  struct Tally {
    std::uint64_t stream_sent = 0, stream_received = 0, datagrams_sent = 0, datagrams_received = 0,
                  bytes_sent = 0, bytes_received = 0;
  };

  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override;
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;
  bool on_shortage() override { return listener_->on_shortage(); }

  // udp.cpp
  Channel* find(ConnectionId connection) const {
    return connection < channels_.size() ? channels_[connection].get() : nullptr;
  }
  Channel& add(ConnectionId connection);
  void let_go(ConnectionId connection, Channel& channel);
  void forward(ConnectionId connection, Bytes bytes);
  void receive_pending();
  void handle_client_datagram(const SocketAddress& source, Bytes datagram);
  void handle_server_datagram(ConnectionId connection, Channel& channel, Bytes datagram);
  void handle_data(ConnectionId connection, Bytes datagram);

  // udp_opening.cpp
  Bytes read_head(ConnectionId connection, Bytes bytes);
  void greet(ConnectionId connection, Channel& channel);
  void open_socket(ConnectionId connection, Channel& channel);
  void send_control(const Channel& channel, Kind kind, std::uint64_t key, std::uint64_t nonce,
                    std::size_t size);
  void ask(const Channel& channel);
  void ask_again();
  void set_timer();

  UdpSettings settings_;
  TcpTransport tcp_;
  Readiness readiness_;
  File timer_;
  File server_;  ///< the socket of all connections of clients
  std::uint16_t server_port_ = 0;
  std::vector<std::unique_ptr<Channel>> channels_;  ///< by connection; null once closed
  std::vector<Tally> tallies_;                      ///< by connection
  std::unordered_map<std::uint64_t, ConnectionId>
      by_key_;                        ///< by the keys that clients' datagrams begin with
  std::vector<ConnectionId> asking_;  ///< clients' channels that are not open yet
  DatagramSender sender_;
  DatagramReader reader_;
  UdpCounters counters_;
  TransportListener* listener_ = nullptr;  ///< while polling
  bool is_behind_ = false;                 ///< with datagrams, since the last poll
  bool has_received_ = false;
};

}  // namespace rink::rti
