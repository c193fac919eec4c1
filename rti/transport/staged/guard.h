// Admits only connections to the RTI, or to a federate, whose other end has proven that it has the
// shared key, and seals all that passes afterwards.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "rti/admission/handshake.h"
#include "rti/transport/staged/staged_transport.h"

namespace rink::rti {

struct GuardSettings {
  Role role = Role::rti;  ///< of this end
  std::string federation = "rink";
  double patience_s =
      3.0;  ///< for a peer to prove itself; it costs a file and less than 2 kB meanwhile
};

/// Holds a handshake on each connection (rti/admission/handshake.h). The connection opens for the
/// user once both ends have proven themselves. One that does not is closed, unnoticed by the user
/// at the RTI's end, with `failed` and a reason at the federate's. Bytes that a federate sends
/// before the proof wait for it. Afterwards bytes and datagrams are encrypted and authenticated
/// (rti/admission/seal.h): a connection with altered, missing or repeated bytes ends with `failed`
/// where that is noticed, such datagrams are dropped and counted. A stream cut off between two
/// records is not told from an end that is gone.
class Guard final : public TransportStage {
 public:
  Guard(const SharedKey& key, GuardSettings settings, Clock now_s);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t datagram_max(ConnectionId connection) const override;
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override;

  /// Unproven connections closed so far.
  std::uint64_t refused() const { return refused_; }
  /// Datagrams dropped so far: altered, repeated or of strangers.
  std::uint64_t rejected_datagrams() const { return rejected_datagrams_; }

 private:
  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override;
  void on_datagram(ConnectionId connection, Bytes datagram) override;
  bool on_shortage() override;
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;

  struct Admission {
    ConnectionId connection;
    double since;
    Handshake handshake;
    std::vector<std::byte> pending;  ///< to be sent to it once it is proven
    bool is_open = false, is_refused = false;
  };
  /// A proven connection.
  struct Session {
    Seal outgoing;
    SealReader incoming;
    FrameReader records{};
    bool is_broken = false, is_closing = false;
  };
  Session* session_of(ConnectionId connection);
  bool is_known(ConnectionId connection) const {
    return connection < is_known_.size() && is_known_[connection];
  }
  Admission* find(ConnectionId connection);
  Admission& admission_of(ConnectionId connection);
  void forget(ConnectionId connection);
  void send_handshake(Admission& admission);
  void refuse(Admission& admission);
  void admit(ConnectionId connection);
  void open(ConnectionId connection, Bytes bytes);

  SharedKey key_;
  GuardSettings settings_;
  Clock now_s_;
  std::vector<std::unique_ptr<Admission>> admissions_;
  std::vector<bool> is_known_;  ///< by connection: proven
  std::unordered_map<ConnectionId, Session> sessions_;
  FrameWriter sealed_{seal_record_max};
  std::vector<std::byte> opened_;
  std::vector<std::vector<std::byte>> sealed_datagrams_;
  std::vector<Datagram> to_send_;
  std::uint64_t refused_ = 0, rejected_datagrams_ = 0;
};

}  // namespace rink::rti
