// Opens and closes connections, and sends frames in slices that transports take.
#include "game/net/peer/network/peer_links.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::game {

namespace {

constexpr std::size_t strangers_max = 64;
/// Limit of what waits of a connection until it is known as a peer's [bytes]: whose greeting came
/// early may play already, and sends its first window's messages, in which a hundred thousand
/// bodies fit.
constexpr std::size_t early_max = 4 * 1024 * 1024;
/// Limit of the wait for a connection's first message.
constexpr double stranger_patience_s = 5.0;
/// Transports close a connection whose queue gets longer than a megabyte; bytes beyond half of that
/// wait in an outbox here.
constexpr std::size_t queued_max = 512 * 1024, slice_max = 128 * 1024;
/// A waiting peer sends this many signs of life in each timeout.
constexpr double signs_per_patience = 4.0;

}  // namespace

PeerLinks::PeerLinks(rti::SocketTransport& sockets, double (*now_s)())
    : sockets_(sockets), now_s_(now_s) {
  assert(now_s != nullptr);
}

PeerLink* PeerLinks::find(rti::ConnectionId connection) {
  const auto entry = links_.find(connection);
  return entry == links_.end() ? nullptr : &entry->second;
}

const PeerLink* PeerLinks::at(peer::PeerNumber number) const {
  if (number >= peers_.size() || !peers_[number]) return nullptr;
  const auto entry = links_.find(*peers_[number]);
  return entry == links_.end() ? nullptr : &entry->second;
}

PeerLink* PeerLinks::at(peer::PeerNumber number) {
  return const_cast<PeerLink*>(std::as_const(*this).at(number));
}

bool PeerLinks::are_open(peer::PeerNumber count, peer::PeerNumber own) const {
  for (peer::PeerNumber k = 0; k < count; ++k)
    if (const PeerLink* const link = at(k); k != own && (!link || !link->is_open)) return false;
  return true;
}

rti::TransportCounters PeerLinks::counters_of(peer::PeerNumber number) const {
  if (number >= peers_.size() || !peers_[number]) return {};
  return sockets_.get().counters(*peers_[number]);
}

rti::ConnectionId PeerLinks::dial(const PeerInfo& info, LinkRole role) {
  assert((role == LinkRole::asked || role == LinkRole::peer) && info.place.port != 0);
  const rti::ConnectionId connection = sockets_.connect(info.place.address, info.place.port);
  PeerLink& link = links_[connection];
  link.role = role, link.info = info, link.since_s = now_s_();
  return connection;
}

void PeerLinks::open(rti::ConnectionId connection) {
  const auto [entry, is_stranger] = links_.try_emplace(connection);
  PeerLink& link = entry->second;
  link.is_open = true;
  if (!is_stranger) return push(connection, link);
  link.since_s = now_s_();
  const auto is_one = [](const auto& other) { return other.second.role == LinkRole::stranger; };
  if (static_cast<std::size_t>(std::count_if(links_.begin(), links_.end(), is_one)) > strangers_max)
    dismiss(connection);
}

void PeerLinks::add(rti::ConnectionId connection, rti::Bytes bytes) {
  PeerLink* const link = find(connection);
  if (!link || link->is_closed) return;
  link->frames.add(bytes);
  link->received_s = now_s_();
  if (link->role != LinkRole::peer && link->frames.waiting_bytes() > early_max) dismiss(connection);
}

void PeerLinks::identify(rti::ConnectionId connection, peer::PeerNumber number,
                         const PeerInfo& info) {
  PeerLink& link = links_.at(connection);
  link.role = LinkRole::peer, link.number = number, link.info = info;
  if (number >= peers_.size()) peers_.resize(number + 1);
  peers_[number] = connection;
  if (const auto mail = waiting_mail_.extract(number))
    for (const std::vector<std::uint8_t>& bytes : mail.mapped())
      send(connection, FrameKind::mail, bytes);
}

void PeerLinks::release(peer::PeerNumber number) {
  waiting_mail_.erase(number);
  if (number < peers_.size()) peers_[number].reset();
}

void PeerLinks::send(rti::ConnectionId connection, FrameKind kind,
                     const std::vector<std::uint8_t>& content) {
  PeerLink& link = links_.at(connection);
  if (link.is_closed) return;
  link.sent_s = now_s_();
  link.outbox.push_back(framed(kind, content));
  if (link.role == LinkRole::peer) bytes_sent_ += link.outbox.back().size();
  push(connection, link);
}

bool PeerLinks::send_to(peer::PeerNumber number, FrameKind kind,
                        const std::vector<std::uint8_t>& content) {
  if (!at(number)) return false;
  send(*peers_[number], kind, content);
  return true;
}

void PeerLinks::keep_for(peer::PeerNumber number, std::vector<std::uint8_t> mail) {
  assert(!at(number));
  waiting_mail_[number].push_back(std::move(mail));
}

void PeerLinks::push_all() {
  for (auto& [connection, link] : links_) push(connection, link);
}

void PeerLinks::push(rti::ConnectionId connection, PeerLink& link) {
  while (link.is_open && !link.is_closed && !link.outbox.empty() &&
         sockets_.get().queued_bytes(connection) < queued_max) {
    const rti::Bytes first = link.outbox.front();
    const std::size_t size = std::min(slice_max, first.size() - link.out_begin);
    const rti::Bytes slice = first.subspan(link.out_begin, size);
    sockets_.get().send(connection, std::span(&slice, 1));
    link.out_begin += size;
    if (link.out_begin == first.size()) link.outbox.pop_front(), link.out_begin = 0;
  }
}

bool PeerLinks::is_sending() const {
  return std::any_of(links_.begin(), links_.end(),
                     [](const auto& entry) { return !entry.second.outbox.empty(); });
}

bool PeerLinks::has_unsent() const {
  return std::any_of(links_.begin(), links_.end(), [&](const auto& entry) {
    const auto& [connection, link] = entry;
    return !link.is_closed && link.is_open &&
           (!link.outbox.empty() || sockets_.get().queued_bytes(connection) > 0);
  });
}

void PeerLinks::show_signs(double patience_s) {
  for (auto& [connection, link] : links_)
    if (link.role == LinkRole::peer && link.is_open && !link.is_closed &&
        now_s_() > link.sent_s + patience_s / signs_per_patience)
      send(connection, FrameKind::sign, {});
}

void PeerLinks::note_close(rti::ConnectionId connection) {
  PeerLink& link = links_.at(connection);
  link.is_closed = true;
  link.outbox.clear();
  if (link.role != LinkRole::peer && !link.early) links_.erase(connection);
}

void PeerLinks::close(rti::ConnectionId connection) {
  links_.at(connection).is_closed = true;
  sockets_.get().close(connection);
}

void PeerLinks::forget(rti::ConnectionId connection) {
  links_.erase(connection);
  sockets_.get().close(connection);
}

void PeerLinks::dismiss(rti::ConnectionId connection) {
  ++dismissed_;
  forget(connection);
}

void PeerLinks::refuse(rti::ConnectionId connection, RefusalKind kind, const std::string& reason) {
  send(connection, FrameKind::refusal, bytes_of(Refused{kind, reason}));
  dismiss(connection);
}

void PeerLinks::dismiss_idle(double patience_s) {
  std::vector<rti::ConnectionId> idle;
  for (const auto& [connection, link] : links_) {
    const bool is_early = link.role == LinkRole::stranger && link.early;
    if ((link.role == LinkRole::stranger || link.role == LinkRole::dismissed) &&
        now_s_() > link.since_s + (is_early ? patience_s : stranger_patience_s))
      idle.push_back(connection);
  }
  for (const rti::ConnectionId connection : idle) dismiss(connection);
}

void PeerLinks::abandon() {
  for (const auto& [connection, link] : links_)
    if (!link.is_closed) sockets_.get().close(connection);
  links_.clear();
}

}  // namespace rink::game
