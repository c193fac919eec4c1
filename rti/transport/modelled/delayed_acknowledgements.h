// Counts the acknowledgements without data that TCP would send, for transports without TCP.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rink::rti {

/// The receiving end of one connection: every second full segment is acknowledged at once; what is
/// left waits for `delay_ns`, and what goes the other way meanwhile carries the acknowledgement
/// (RFC 1122 4.2.3.2, RFC 5681 4.2: at least every second full segment, and within 500 ms).
/// Instants [ns] never decrease.
class DelayedAcknowledgements {
 public:
  static constexpr std::size_t full_segment = 1448;     ///< bytes of payload
  static constexpr std::int64_t delay_ns = 40'000'000;  ///< Linux's least (TCP_DELACK_MIN)

  /// A write of so many bytes has come, as many full segments as are in it and a rest.
  void received(std::size_t bytes, std::int64_t now_ns);
  /// Data was sent in the other direction.
  void sent(std::int64_t now_ns);
  /// Acknowledgements without data until `now_ns`.
  std::uint64_t count(std::int64_t now_ns) const {
    return count_ + (is_waiting_ && now_ns >= due_ns_ ? 1 : 0);
  }

 private:
  void settle(std::int64_t now_ns);

  std::uint64_t count_ = 0;
  std::int64_t due_ns_ = 0;
  bool is_waiting_ = false;  ///< something is not acknowledged yet
  bool is_odd_ = false;      ///< and among it one full segment
};

}  // namespace rink::rti
