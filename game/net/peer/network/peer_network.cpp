// Connections, frames, and waiting for them.
#include "game/net/peer/network/peer_network.h"

#include <algorithm>
#include <chrono>

namespace rink::game {

namespace {

constexpr std::size_t strangers_max = 64;
/// Limits of side messages that wait for a listener, and of the wait for a connection's first
/// message.
constexpr std::size_t deferred_max = 4096;
constexpr double stranger_patience_s = 5.0;
/// Transports close a connection whose queue gets longer than a megabyte; bytes beyond half of that
/// wait in an outbox here.
constexpr std::size_t queued_max = 512 * 1024, slice_max = 128 * 1024;
constexpr double wait_s_max = 0.05;
/// An interrupted peer has so long, and three windows, to hand over its bodies.
constexpr double leaving_s_max = 3.0, leaving_windows_max = 3.0;
/// The time to wait for the others' farewells.
constexpr double goodbye_s_max = 5.0;
/// A waiting peer sends this many signs of life in each timeout.
constexpr double signs_per_patience = 4.0;

}  // namespace

PeerNetwork::PeerNetwork(rti::SocketTransport& sockets, const PeerNetworkSettings& settings,
                         double (*now_s)())
    : sockets_(sockets), settings_(settings), now_s_(now_s) {}

void PeerNetwork::note(ExitStatus status, const std::string& what) {
  if (!error_) error_.emplace(status, what);
}

/// The game continues without the peer, if it can.
void PeerNetwork::lose(Link& link, ExitStatus status, const std::string& what) {
  if (!may_lose_) return note(status, what);
  if (link.loss.empty()) link.loss = what;
}

void PeerNetwork::show_signs() {
  for (auto& [connection, link] : links_)
    if (link.role == Role::peer && link.is_open && !link.is_closed &&
        now_s_() > link.sent_s + settings_.patience_s / signs_per_patience)
      send_frame(connection, FrameKind::sign, {});
}

void PeerNetwork::attend(double wait_s) {
  if (before_wait) wait_s = std::clamp(before_wait() - now_s_(), 0.0, wait_s);
  if (may_lose_) show_signs();
  push_all();
  const bool is_sending = std::any_of(
      links_.begin(), links_.end(), [](const auto& entry) { return !entry.second.outbox.empty(); });
  sockets_.get().poll(std::chrono::nanoseconds(static_cast<std::int64_t>(
                          1e9 * (is_sending ? std::min(0.001, wait_s) : wait_s))),
                      *this);
  deliver_deferred();
  std::vector<rti::ConnectionId> idle;
  for (const auto& [connection, link] : links_) {
    const double patience_s =
        link.role == Role::stranger && link.early ? settings_.patience_s : stranger_patience_s;
    if ((link.role == Role::stranger || link.role == Role::dismissed) &&
        now_s_() > link.since_s + patience_s)
      idle.push_back(connection);
  }
  for (const rti::ConnectionId connection : idle) dismiss(connection);
  const bool must_end = settings_.must_end();
  if (must_end && !interrupted_s_) interrupted_s_ = now_s_();
  if (must_end && !may_leave_in_order()) throw SessionError(ExitStatus::interrupted, "interrupted");
  if (error_) throw SessionError(*error_);
}

/// Not before the first window: until then there is nothing to hand over.
bool PeerNetwork::may_leave_in_order() const {
  return may_lose_ && window_begin_s_ &&
         now_s_() <= *interrupted_s_ + leaving_s_max +
                         leaving_windows_max * std::max(terms_.window, longest_window_s_);
}

void PeerNetwork::begin() {
  is_playing_ = true;
  may_lose_ = terms_.is_replicated;
}

void PeerNetwork::note_window() {
  const double now = now_s_();
  if (window_begin_s_) longest_window_s_ = std::max(longest_window_s_, now - *window_begin_s_);
  window_begin_s_ = now;
}

void PeerNetwork::abandon() {
  for (auto& [connection, link] : links_)
    if (!link.is_closed) sockets_.get().close(connection);
  links_.clear();
}

void PeerNetwork::deliver_deferred() {
  while (receive_aside && !deferred_.empty()) {
    const auto [from, bytes] = std::move(deferred_.front());
    deferred_.pop_front();
    Link* const link = link_at(from);
    if (!link || link->is_parted || receive_aside(from, bytes)) continue;
    lose(*link, ExitStatus::failed, name_of(*link) + " sent a side message that no peer sends");
  }
}

void PeerNetwork::push_all() {
  for (auto& [connection, link] : links_) push(connection, link);
}

void PeerNetwork::push(rti::ConnectionId connection, Link& link) {
  while (link.is_open && !link.is_closed && !link.outbox.empty() &&
         sockets_.get().queued_bytes(connection) < queued_max) {
    const std::vector<std::uint8_t>& first = link.outbox.front();
    const std::size_t size = std::min(slice_max, first.size() - link.out_begin);
    const rti::Bytes slice = std::as_bytes(std::span(first).subspan(link.out_begin, size));
    sockets_.get().send(connection, std::span(&slice, 1));
    link.out_begin += size;
    if (link.out_begin == first.size()) link.outbox.pop_front(), link.out_begin = 0;
  }
}

void PeerNetwork::dial(const PeerInfo& info, Role role, peer::PeerNumber number) {
  const rti::ConnectionId connection = sockets_.connect(info.place.address, info.place.port);
  Link& link = links_[connection];
  link.role = role, link.info = info, link.since_s = now_s_();
  if (role == Role::peer) become_peer(connection, number, info);
}

void PeerNetwork::send_frame(rti::ConnectionId connection, FrameKind kind,
                             const std::vector<std::uint8_t>& content) {
  Link& link = links_.at(connection);
  if (link.is_closed) return;
  link.sent_s = now_s_();
  link.outbox.push_back(framed(kind, content));
  if (link.role == Role::peer) bytes_sent_ += link.outbox.back().size();
  push(connection, link);
}

void PeerNetwork::dismiss(rti::ConnectionId connection) {
  ++dismissed_;
  links_.erase(connection);
  sockets_.get().close(connection);
}

void PeerNetwork::refuse(rti::ConnectionId connection, RefusalKind kind,
                         const std::string& reason) {
  send_frame(connection, FrameKind::refusal, bytes_of(Refused{kind, reason}));
  dismiss(connection);
}

void PeerNetwork::on_open(rti::ConnectionId connection) {
  const auto [entry, is_stranger] = links_.try_emplace(connection);
  Link& link = entry->second;
  link.is_open = true;
  if (is_stranger) {
    link.since_s = now_s_();
    const auto is_one = [](const auto& other) { return other.second.role == Role::stranger; };
    if (static_cast<std::size_t>(std::count_if(links_.begin(), links_.end(), is_one)) >
        strangers_max)
      dismiss(connection);
  } else if (link.role == Role::asked) {
    Hello hello;
    hello.session_fingerprint = settings_.session_fingerprint, hello.info = settings_.self;
    send_frame(connection, FrameKind::hello, bytes_of(hello));
  } else {
    push(connection, link);
  }
}

void PeerNetwork::on_bytes(rti::ConnectionId connection, rti::Bytes bytes) {
  const auto entry = links_.find(connection);
  if (entry == links_.end() || entry->second.is_closed) return;
  entry->second.reader.add(bytes);
  entry->second.received_s = now_s_();
  read_frames(connection);
}

void PeerNetwork::read_frames(rti::ConnectionId connection) {
  for (auto entry = links_.find(connection);
       entry != links_.end() && !entry->second.is_closed && !entry->second.early;
       entry = links_.find(connection)) {
    Link& link = entry->second;
    const std::optional<Frame> frame =
        link.reader.next(link.role == Role::peer ? peer_frame_max : stranger_frame_max);
    if (!frame && (!link.reader.is_broken() || link.role == Role::dismissed)) return;
    const Role role = link.role;
    if (role == Role::dismissed) continue;
    const auto handles = [&] {
      if (role == Role::stranger) return handle_stranger(connection, *frame);
      return role == Role::asked
                 ? handle_answer(connection, *frame)
                 : role == Role::peer && handle_peer_frame(connection, link, *frame);
    };
    const bool is_good = frame && handles();
    if (is_good) continue;
    if (role == Role::stranger || role == Role::caller) return dismiss(connection);
    if (role == Role::peer)
      lose(link, ExitStatus::failed, name_of(link) + " sent what is no message");
    else
      note(ExitStatus::no_server,
           "what answers at " + link.info.place.text() + " is no peer that speaks version " +
               std::to_string(peer_protocol_version) + " of the peers' protocol");
    link.is_closed = true;
    sockets_.get().close(connection);
  }
}

void PeerNetwork::on_close(rti::ConnectionId connection, rti::CloseReason reason,
                           const std::string& detail) {
  const auto entry = links_.find(connection);
  if (entry == links_.end()) return;
  Link& link = entry->second;
  const std::string why =
      std::string(rti::to_string(reason)) + (detail.empty() ? "" : ", " + detail);
  link.is_closed = true;
  link.outbox.clear();
  if (link.role == Role::peer && !link.is_done && !link.is_parted)
    lose(link, ExitStatus::connection_lost,
         name_of(link) + (link.is_open ? " is gone: " : " cannot be reached: ") + why);
  if (link.role == Role::asked)
    unanswered_ = "no peer answers at " + link.info.place.text() + ": " + why;
  // The loss of a connection with an early greeting is reported when its peer is expected.
  if (link.role != Role::peer && !link.early) links_.erase(entry);
}

bool PeerNetwork::handle_peer_frame(rti::ConnectionId connection, Link& link, const Frame& frame) {
  if (frame.kind == FrameKind::refusal && !members_.empty()) {
    const auto refused = message_from<Refused>(frame.content);
    if (refused && sent_away_.empty()) sent_away_ = name_of(link) + ": " + refused->reason;
    return refused.has_value();
  }
  if (frame.kind == FrameKind::mail) {
    link.inbox.push_back(frame.content);
    return !link.is_done;
  }
  if (frame.kind == FrameKind::aside) {
    // Without interest beyond the peers' parts there are no side messages; with it no sender is
    // further ahead of its receivers than a window.
    if (!terms_.interest.is_wanted() || deferred_.size() >= deferred_max) return false;
    deferred_.emplace_back(link.number, frame.content);
    return !link.is_done;
  }
  if (frame.kind == FrameKind::sign) return frame.content.empty();
  const auto farewell =
      frame.kind == FrameKind::farewell ? message_from<Farewell>(frame.content) : std::nullopt;
  if (!farewell) return false;
  link.is_done = true;
  // A peer that leaves with consent waits for this message.
  if (link.is_parted && !link.is_closed)
    send_frame(connection, FrameKind::farewell, bytes_of(Farewell{}));
  if (farewell->kind == FarewellKind::interrupted)
    lose(link, ExitStatus::connection_lost,
         name_of(link) + " was interrupted" + (may_lose_ ? "" : ", so all end"));
  if (farewell->kind == FarewellKind::trouble)
    lose(link, ExitStatus::connection_lost, name_of(link) + " ended: " + farewell->reason);
  return true;
}

/// A peer that is expected and has not connected yet gets it then.
void PeerNetwork::send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  if (to < peers_.size() && peers_[to]) return send_frame(*peers_[to], FrameKind::mail, bytes);
  if (expected_.contains(to)) waiting_mail_[to].push_back(std::move(bytes));
}

void PeerNetwork::send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  if (to < peers_.size() && peers_[to]) send_frame(*peers_[to], FrameKind::aside, bytes);
}

std::vector<std::uint8_t> PeerNetwork::receive(peer::PeerNumber from) {
  double begin_s = now_s_(), looked_s = begin_s;
  for (;;) {
    // A peer that was itself stopped must not take that for the others' silence: it has not read
    // their messages yet.
    const double now = now_s_();
    if (now - looked_s > std::max(0.5 * settings_.patience_s, 2.0 * wait_s_max)) begin_s = now;
    looked_s = now;
    if (!sent_away_.empty()) throw peer::SentAway(sent_away_);
    for (const auto& [connection, other] : links_)
      if (other.role == Role::peer && other.is_counted && !other.loss.empty() && !other.is_parted)
        throw peer::PeerGone(other.number, false, other.loss);
    Link* const link = link_at(from);
    if (link && !link->inbox.empty()) {
      std::vector<std::uint8_t> first = std::move(link->inbox.front());
      link->inbox.pop_front();
      return first;
    }
    if (link && link->is_done && may_lose_)
      throw peer::PeerGone(from, true, name_of(*link) + " has left");
    if (link && link->is_done)
      throw SessionError(ExitStatus::connection_lost, name_of(*link) + " left before the end");
    const std::string silence =
        " was silent for " + std::to_string(static_cast<int>(settings_.patience_s)) + " s";
    if (!link && now > begin_s + settings_.patience_s)
      throw peer::PeerGone(from, false, "peer " + std::to_string(from) + silence);
    if (link && now > std::max(begin_s, link->received_s) + settings_.patience_s) {
      link->is_counted = true;
      lose(*link, ExitStatus::connection_lost, name_of(*link) + silence);
    }
    if (!link || link->loss.empty() || !link->is_counted || link->is_parted) attend(wait_s_max);
  }
}

void PeerNetwork::part(peer::PeerNumber peer, bool is_lost) {
  Link* const link = link_at(peer);
  if (!link) return;
  link->is_parted = true;
  if (link->is_closed) return;
  if (!is_lost) {
    if (link->is_done) send_frame(*peers_[peer], FrameKind::farewell, bytes_of(Farewell{}));
    return;
  }
  link->is_closed = true;
  sockets_.get().close(*peers_[peer]);
}

void PeerNetwork::rejoin(peer::PeerNumber peer) {
  Link* const link = link_at(peer);
  if (!link) return;
  link->is_parted = false;
  if (link->is_closed && !link->is_done)
    lose(*link, ExitStatus::connection_lost, name_of(*link) + " is gone");
}

void PeerNetwork::rest_until(double time_s) {
  for (double left_s = time_s - now_s_(); left_s > 0.0 && !settings_.must_end();
       left_s = time_s - now_s_())
    attend(std::min(left_s, wait_s_max));
}

void PeerNetwork::leave(const Farewell& farewell) {
  for (auto& [connection, link] : links_)
    if (link.role == Role::peer && !link.is_closed)
      send_frame(connection, FrameKind::farewell, bytes_of(farewell));
  // Closing a connection before all is read may discard the last bytes sent.
  const double give_up_s =
      now_s_() +
      (farewell.kind == FarewellKind::done ? std::min(settings_.patience_s, goodbye_s_max) : 0.5);
  const auto is_open = [](const auto& entry) {
    return entry.second.role == Role::peer && entry.second.is_open && !entry.second.is_closed &&
           !entry.second.is_done;
  };
  const auto is_sending = [&](const auto& entry) {
    return !entry.second.is_closed && entry.second.is_open &&
           (!entry.second.outbox.empty() || sockets_.get().queued_bytes(entry.first) > 0);
  };
  while ((std::any_of(links_.begin(), links_.end(), is_open) ||
          std::any_of(links_.begin(), links_.end(), is_sending)) &&
         now_s_() < give_up_s) {
    push_all();
    sockets_.get().poll(std::chrono::milliseconds(1), *this);
  }
}

}  // namespace rink::game
