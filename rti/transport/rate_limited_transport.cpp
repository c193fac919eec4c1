// Counts bytes and frames as they pass.
#include "rti/transport/rate_limited_transport.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "rti/wire/frame.h"

namespace rink::rti {

/// One connection's buckets, and where in its frames it is.
struct RateLimitedTransport::Meter {
  TokenBucket bytes, frames;
  std::byte header[frame_header_size] = {};
  std::size_t header_size = 0;  ///< of it heard
  std::uint32_t body_left = 0;  ///< of the frame at hand
  bool is_closing = false;

  /// Frames whose header ends in `heard`.
  int count_frames(Bytes heard) {
    int count = 0;
    while (!heard.empty()) {
      if (body_left > 0) {
        const std::size_t skipped = std::min<std::size_t>(body_left, heard.size());
        body_left -= static_cast<std::uint32_t>(skipped);
        heard = heard.subspan(skipped);
        continue;
      }
      header[header_size++] = heard.front();
      heard = heard.subspan(1);
      if (header_size < frame_header_size) continue;
      std::memcpy(&body_left, header, sizeof body_left);
      header_size = 0;
      ++count;
    }
    return count;
  }
};

class RateLimitedTransport::Relay final : public TransportListener {
 public:
  Relay(RateLimitedTransport& limited, TransportListener& listener)
      : limited_(limited), listener_(listener) {}
  void on_open(ConnectionId connection) override {
    if (connection >= limited_.meters_.size()) limited_.meters_.resize(connection + 1);
    const double now = limited_.now_s_();
    limited_.meters_[connection] =
        std::make_unique<Meter>(Meter{TokenBucket(limited_.limit_.bytes_per_s, now),
                                      TokenBucket(limited_.limit_.frames_per_s, now)});
    listener_.on_open(connection);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    if (limited_.allows(connection, bytes, false)) listener_.on_bytes(connection, bytes);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    if (limited_.allows(connection, datagram, true)) listener_.on_datagram(connection, datagram);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override {
    const bool was_too_fast = connection < limited_.meters_.size() &&
                              limited_.meters_[connection] &&
                              limited_.meters_[connection]->is_closing;
    if (connection < limited_.meters_.size()) limited_.meters_[connection].reset();
    if (was_too_fast)
      listener_.on_close(connection, CloseReason::too_fast, to_string(CloseReason::too_fast));
    else listener_.on_close(connection, reason, detail);
  }

 private:
  RateLimitedTransport& limited_;
  TransportListener& listener_;
};

RateLimitedTransport::RateLimitedTransport(Transport& inner, const RateLimit& limit, Clock now_s)
    : inner_(inner), limit_(limit), now_s_(std::move(now_s)) {}
RateLimitedTransport::~RateLimitedTransport() = default;

/// Closes who exceeds the limit.
bool RateLimitedTransport::allows(ConnectionId connection, Bytes bytes, bool is_datagram) {
  Meter* meter = connection < meters_.size() ? meters_[connection].get() : nullptr;
  if (meter == nullptr || meter->is_closing) return false;
  const double now = now_s_();
  const bool has_frames = limit_.frames_per_s > 0.0;
  if (meter->bytes.take(static_cast<double>(bytes.size()), now) &&
      (!has_frames || meter->frames.take(is_datagram ? 1 : meter->count_frames(bytes), now)))
    return true;
  meter->is_closing = true;
  ++closed_;
  if (const Bytes words = limit_.last_words; !words.empty())
    inner_.send(connection, std::span(&words, 1));
  inner_.close(connection);
  return false;
}

void RateLimitedTransport::poll(std::chrono::nanoseconds longest_wait,
                                TransportListener& listener) {
  Relay relay(*this, listener);
  inner_.poll(longest_wait, relay);
}

}  // namespace rink::rti
