// Counts bytes and frames as they pass.
#include "rti/transport/staged/rate_limiter.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "rti/wire/frame.h"

namespace rink::rti {

/// One connection's buckets, and where in its frames it is.
struct RateLimiter::Meter {
  TokenBucket bytes, frames;
  std::byte front[frame_head_max] = {};  ///< of the present frame, until its head is known
  std::size_t front_size = 0;
  std::size_t body_left = 0;  ///< of the present frame
  bool is_closing = false;

  /// Counts the frames whose head gets known by `stream`.
  int count_frames(Bytes stream) {
    int count = 0;
    while (!stream.empty()) {
      if (body_left > 0) {
        const std::size_t skipped = std::min(body_left, stream.size());
        body_left -= skipped;
        stream = stream.subspan(skipped);
        continue;
      }
      front[front_size++] = stream.front();
      stream = stream.subspan(1);
      const std::optional<FrameHead> head = read_frame_head(Bytes(front).first(front_size));
      if (!head) continue;
      body_left = head->size + head->length - std::min(front_size, head->size + head->length);
      front_size = 0;
      ++count;
    }
    return count;
  }
};

RateLimiter::RateLimiter(const RateLimit& limit, Clock now_s)
    : limit_(limit), now_s_(std::move(now_s)) {}
RateLimiter::~RateLimiter() = default;

void RateLimiter::on_open(ConnectionId connection) {
  if (connection >= meters_.size()) meters_.resize(connection + 1);
  assert(meters_[connection] == nullptr);  // connections are never numbered twice
  const double now = now_s_();
  meters_[connection] = std::make_unique<Meter>(
      Meter{TokenBucket(limit_.bytes_per_s, now), TokenBucket(limit_.frames_per_s, now)});
  TransportStage::on_open(connection);
}

void RateLimiter::on_close(ConnectionId connection, CloseReason reason, const std::string& detail) {
  const std::unique_ptr<Meter> meter =
      connection < meters_.size() ? std::move(meters_[connection]) : nullptr;
  if (meter && meter->is_closing)
    TransportStage::on_close(connection, CloseReason::too_fast, to_string(CloseReason::too_fast));
  else TransportStage::on_close(connection, reason, detail);
}

/// Closes a connection that exceeds the limit.
bool RateLimiter::allows(ConnectionId connection, Bytes bytes, bool is_datagram) {
  Meter* meter = connection < meters_.size() ? meters_[connection].get() : nullptr;
  if (meter == nullptr || meter->is_closing) return false;
  const double now = now_s_();
  const bool has_frames = limit_.frames_per_s > 0.0;
  if (meter->bytes.take(static_cast<double>(bytes.size()), now) &&
      (!has_frames || meter->frames.take(is_datagram ? 1 : meter->count_frames(bytes), now)))
    return true;
  meter->is_closing = true;
  ++closed_;
  if (const Bytes words = limit_.last_words; !words.empty()) send(connection, std::span(&words, 1));
  close(connection);
  return false;
}

}  // namespace rink::rti
