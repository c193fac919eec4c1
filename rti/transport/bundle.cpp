// Writes and reads records: each connection's bytes under its number.
#include "rti/transport/bundle.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "im/basics/checked.h"
#include "im/basics/varint.h"

namespace rink::rti {

namespace {

constexpr std::size_t record_size_max = 0xfffffffe;  ///< of one record
constexpr std::size_t bundled_counters_kept = 1024;  ///< of closed connections

void append(std::vector<std::byte>& to, Bytes bytes) {
  if (bytes.empty()) return;
  const std::size_t before = to.size();
  to.resize(before + bytes.size());
  std::memcpy(to.data() + before, bytes.data(), bytes.size());
}

}  // namespace

BundledTransport::Trunk& BundledTransport::trunk(ConnectionId id) {
  if (id >= trunks_.size()) trunks_.resize(id + 1);
  return trunks_[id];
}

BundledTransport::Channel* BundledTransport::find(ConnectionId connection) {
  Channel* channel = connection < channels_.size() ? channels_[connection].get() : nullptr;
  return channel != nullptr && !channel->is_closed ? channel : nullptr;
}

ConnectionId BundledTransport::add(ConnectionId trunk_id) {
  Trunk& carrying = trunk(trunk_id);
  const auto connection = static_cast<ConnectionId>(channels_.size());
  channels_.push_back(std::make_unique<Channel>(
      Channel{.trunk = trunk_id, .number = static_cast<std::uint32_t>(carrying.channels.size())}));
  carrying.channels.push_back(connection);
  ++carrying.channels_left;
  return connection;
}

ConnectionId BundledTransport::connect(ConnectionId trunk_id) {
  Trunk& carrying = trunk(trunk_id);
  carrying.is_ours = true;
  const ConnectionId connection = add(trunk_id);
  if (carrying.is_closed) {
    end(connection, CloseReason::closed_by_peer, "its trunk was closed before");
    return connection;
  }
  write_header(trunk_id, channels_[connection]->number, opens);
  if (carrying.is_open) news_.push_back({connection, true, {}, {}});
  return connection;
}

void BundledTransport::write_header(ConnectionId trunk_id, std::uint32_t number,
                                    std::uint32_t coded_size) {
  assert(trunk_id < trunks_.size() && !trunks_[trunk_id].is_closed);
  assert(number < trunks_[trunk_id].channels.size());
  std::vector<std::byte>& gathered = trunks_[trunk_id].gathered;
  if (gathered.empty()) full_.push_back(trunk_id);
  const std::size_t before = gathered.size();
  gathered.resize(before + varint_size(number) + varint_size(coded_size));
  put_varint(put_varint(&gathered[before], number), coded_size);
}

void BundledTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  Channel* channel = find(connection);
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (channel == nullptr || size == 0 || size > record_size_max) return;
  ++channel->counters.writes;
  channel->counters.segments_sent += (size + 1447) / 1448;
  if (channel->counters.bytes_sent == 0) ++trunks_[channel->trunk].channels_told;
  channel->counters.bytes_sent += size;
  write_header(channel->trunk, channel->number, static_cast<std::uint32_t>(size + 1));
  Trunk& carrying = trunks_[channel->trunk];
  for (const Bytes part : parts) append(carrying.gathered, part);
  if (carrying.gathered.size() >= gathered_max) send_gathered(channel->trunk);
}

void BundledTransport::send_gathered(ConnectionId trunk_id) {
  std::vector<std::byte>& gathered = trunks_[trunk_id].gathered;
  if (gathered.empty()) return;
  std::erase(full_, trunk_id);
  const Bytes bytes = gathered;
  carrier_.send(trunk_id, std::span(&bytes, 1));
  gathered.clear();
  const std::size_t channels = std::max<std::size_t>(1, trunks_[trunk_id].channels_told),
                    queued = carrier_.queued_bytes(trunk_id);
  if (queued <= trunk_queue_max && queued / channels <= queue_max) return;
  carrier_.close(trunk_id);
  end_all(trunk_id, CloseReason::queue_full,
          "its bundle did not read: more than " +
              (queued > trunk_queue_max ? std::to_string(trunk_queue_max) + " bytes waited"
                                        : std::to_string(queue_max) + " bytes waited for each of " +
                                              std::to_string(channels)));
}

void BundledTransport::push() {
  while (!full_.empty()) send_gathered(full_.back());
  carrier_.push();
}

void BundledTransport::close(ConnectionId connection) {
  const Channel* channel = find(connection);
  if (channel == nullptr) return;
  write_header(channel->trunk, channel->number, closes);
  end(connection, CloseReason::closed_by_us, "closed by us");
}

void BundledTransport::end(ConnectionId connection, CloseReason reason, const std::string& detail) {
  Channel& channel = *channels_[connection];
  assert(!channel.is_closed);  // its end is reported once
  channel.is_closed = true;
  Trunk& carrying = trunks_[channel.trunk];
  assert(carrying.channels_left > 0);
  if (--carrying.channels_left == 0) carrying.idle_since = std::chrono::steady_clock::now();
  if (channel.counters.bytes_sent > 0) --carrying.channels_told;
  news_.push_back({connection, false, reason, detail});
}

std::size_t BundledTransport::queued_bytes(ConnectionId connection) const {
  if (connection >= channels_.size() || !channels_[connection] || channels_[connection]->is_closed)
    return 0;
  const ConnectionId trunk_id = channels_[connection]->trunk;
  const Trunk& trunk = trunks_[trunk_id];
  return (carrier_.queued_bytes(trunk_id) + trunk.gathered.size()) /
         std::max<std::size_t>(1, trunk.channels_told);
}

std::string BundledTransport::peer_network(ConnectionId connection) const {
  const bool is_there = connection < channels_.size() && channels_[connection];
  return is_there ? carrier_.peer_network(channels_[connection]->trunk) : std::string();
}

TransportCounters BundledTransport::counters(ConnectionId connection) const {
  if (connection >= channels_.size()) return {};
  if (!channels_[connection]) {
    const auto at =
        std::ranges::find(last_counters_, connection, [](const auto& each) { return each.first; });
    return at == last_counters_.end() ? TransportCounters{} : at->second;
  }
  TransportCounters counters = channels_[connection]->counters;
  counters.queued_bytes = queued_bytes(connection);
  return counters;
}

void BundledTransport::check() const {
  for (ConnectionId id = 0; id < trunks_.size(); ++id) {
    [[maybe_unused]] const Trunk& each = trunks_[id];
    assert(each.gathered.empty() == (std::ranges::find(full_, id) == full_.end()));
    assert(!each.is_closed || each.gathered.empty());
    assert(each.header_size < sizeof each.header);
    assert(each.left == 0 || each.number < each.channels.size());
    [[maybe_unused]] std::size_t left = 0, told = 0;
    for (const ConnectionId connection : each.channels) {
      const Channel* channel = channels_[connection].get();
      if (channel == nullptr || channel->is_closed) continue;
      ++left, told += channel->counters.bytes_sent > 0 ? 1 : 0;
    }
    assert(each.channels_left == left && each.channels_told == told);
  }
  for (ConnectionId connection = 0; connection < channels_.size(); ++connection) {
    [[maybe_unused]] const Channel* channel = channels_[connection].get();
    if (channel == nullptr || trunks_[channel->trunk].is_closed) continue;
    assert(trunks_[channel->trunk].channels[channel->number] == connection);
  }
}

void BundledTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  listener_ = &listener;
  push();
  report();
  carrier_.poll(telling_.empty() && news_.empty() ? longest_wait : std::chrono::nanoseconds(0),
                *this);
  report();
  close_idle_trunks();
  telling_.clear();
  listener_ = nullptr;
  if constexpr (checks_whole_structures) check();
}

/// Closes sockets of peers that carry no channel: listeners are told of channels only.
void BundledTransport::close_idle_trunks() {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_for_idle_ < std::chrono::seconds(1)) return;
  // Nobody has looked meanwhile, and what has come may not be read yet.
  const bool stood_still = now - looked_for_idle_ > idle_max / 2;
  looked_for_idle_ = now;
  for (ConnectionId id = 0; id < trunks_.size(); ++id) {
    Trunk& each = trunks_[id];
    if (stood_still) each.idle_since = now;
    if (each.is_open && !each.is_closed && !each.is_ours && each.channels_left == 0 &&
        now - each.idle_since > idle_max)
      carrier_.close(id);
  }
}

/// Leaves the reported events in `telling_`, so that a poll knows that it has reported any.
void BundledTransport::report() {
  while (!news_.empty()) {
    telling_.swap(news_);
    news_.clear();
    for (const News& each : telling_) {
      if (each.is_open) {
        Channel* channel = find(each.connection);
        if (channel == nullptr || channel->is_open) continue;
        channel->is_open = true;
        listener_->on_open(each.connection);
      } else {
        last_counters_.emplace_back(each.connection, channels_[each.connection]->counters);
        if (last_counters_.size() > bundled_counters_kept) last_counters_.pop_front();
        channels_[each.connection].reset();
        listener_->on_close(each.connection, each.reason, each.detail);
      }
    }
  }
}

void BundledTransport::on_open(ConnectionId trunk_id) {
  Trunk& opened = trunk(trunk_id);
  opened.is_open = true;
  opened.idle_since = std::chrono::steady_clock::now();
  for (const ConnectionId connection : opened.channels) news_.push_back({connection, true, {}, {}});
  report();
}

void BundledTransport::on_bytes(ConnectionId trunk_id, Bytes bytes) {
  while (!bytes.empty() && !trunks_[trunk_id].is_closed) {
    Trunk& trunk = trunks_[trunk_id];
    if (trunk.left == 0) {
      const std::byte byte = bytes.front();
      bytes = bytes.subspan(1);
      if (!take_of_header(trunk_id, byte)) {
        carrier_.close(trunk_id);
        return on_close(trunk_id, CloseReason::failed, "sent bytes that are no record of a bundle");
      }
      continue;
    }
    const Bytes part = bytes.first(std::min<std::size_t>(trunk.left, bytes.size()));
    bytes = bytes.subspan(part.size());
    trunk.left -= static_cast<std::uint32_t>(part.size());
    const ConnectionId connection = trunk.channels[trunk.number];
    if (Channel* channel =
            find(connection)) {  // else this end closed it, and the peer does not know yet
      channel->counters.bytes_received += part.size();
      listener_->on_bytes(connection, part);
    }
  }
}

bool BundledTransport::take_of_header(ConnectionId trunk_id, std::byte byte) {
  Trunk& trunk = trunks_[trunk_id];
  trunk.header[trunk.header_size++] = byte;
  if ((byte & std::byte{0x80}) == std::byte{0}) ++trunk.numbers_read;
  if (trunk.numbers_read == 2) return handle_header(trunk_id);
  return trunk.header_size < sizeof trunk.header;
}

bool BundledTransport::handle_header(ConnectionId trunk_id) {
  Trunk& trunk = trunks_[trunk_id];
  const Bytes header = Bytes(trunk.header).first(trunk.header_size);
  trunk.header_size = trunk.numbers_read = 0;
  std::uint64_t number = 0, size = 0;
  const std::size_t number_size = get_varint(header, number);
  if (number_size == 0 || get_varint(header.subspan(number_size), size) == 0) return false;
  if (size > record_size_max + 1) return false;
  if (size == opens) {
    if (trunk.is_ours || number != trunk.channels.size() || number >= channel_max) return false;
    const ConnectionId connection = add(trunk_id);
    news_.push_back({connection, true, {}, {}});
    return report(), true;
  }
  if (number >= trunk.channels.size()) return false;
  if (size == closes) {
    if (find(trunk.channels[number]) != nullptr)
      end(trunk.channels[number], CloseReason::closed_by_peer, "closed by peer");
    return report(), true;
  }
  trunk.number = static_cast<std::uint32_t>(number);
  trunk.left = static_cast<std::uint32_t>(size - 1);
  return true;
}

void BundledTransport::on_close(ConnectionId trunk_id, CloseReason reason,
                                const std::string& detail) {
  end_all(trunk_id, reason, detail);
  report();
}

void BundledTransport::end_all(ConnectionId trunk_id, CloseReason reason,
                               const std::string& detail) {
  Trunk& closed = trunk(trunk_id);
  if (std::exchange(closed.is_closed, true)) return;
  std::erase(full_, trunk_id);
  closed.gathered = {};
  for (const ConnectionId connection : closed.channels)
    if (find(connection) != nullptr) end(connection, reason, detail);
  closed.channels = {};
  closed.number = closed.left = 0;
  closed.header_size = closed.numbers_read = 0;
}

}  // namespace rink::rti
