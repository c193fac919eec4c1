// Reads what ranks send each other, and waits with a timeout.
#include "game/net/peer/ranks/rank_network.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <thread>

namespace rink::game {

namespace {

/// While a rank rests until its next window.
constexpr double rest_s_max = 5e-4;
/// The time to wait for the others' farewells.
constexpr double farewells_s_max = 5.0;
/// Looks at one rank between two looks at all.
constexpr std::uint32_t looks_at_one = 64;

std::string name_of(peer::PeerNumber rank) { return "rank " + std::to_string(rank); }

/// Looks again at once while an answer may take microseconds only, then yields the processor to
/// other ranks, since there may be more ranks than processors.
void wait(std::uint32_t looks) {
  if (looks < 64) return;
  if (looks < 256) return std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::microseconds(20));
}

rti::RankMessage message_of(RankChannel channel, std::vector<std::uint8_t> bytes) {
  return {static_cast<std::uint8_t>(channel), std::move(bytes)};
}

}  // namespace

RankNetwork::RankNetwork(rti::Ranks& ranks, const PeerNetworkSettings& settings, double (*now_s)())
    : ranks_(ranks), settings_(settings), now_s_(now_s), others_(ranks.count()) {
  assert(settings.self.bat_count <= settings.bats);
  others_[ranks.number()].has_left = true;
}

void RankNetwork::agree(const Terms& terms) {
  assert(infos_.empty());
  terms_ = terms;
  terms_.peer_count = ranks_.count();
  RankWords words;
  words.session_fingerprint = settings_.session_fingerprint;
  words.until = terms.until, words.window = terms.window;
  words.balance_windows = terms.balance_windows;
  words.info = settings_.self;
  const std::span<const std::uint8_t> all = collect(spoken(words));
  const std::vector<RefusedRank> refused = refused_ranks(all, settings_.bats);
  infos_ = refused.empty() ? seated_ranks(all) : std::vector<PeerInfo>();
  if (refused.empty()) return;
  std::string text;
  for (const RefusedRank& rank : refused)
    text += (text.empty() ? "" : "; ") + name_of(rank.number) +
            " cannot play with rank 0: " + rank.reason;
  const bool is_version = std::all_of(refused.begin(), refused.end(), [](const RefusedRank& rank) {
    return rank.kind == RefusalKind::wrong_version;
  });
  throw RanksDiffer(is_version ? ExitStatus::wrong_version : ExitStatus::not_admitted, text);
}

void RankNetwork::attend() {
  if (before_wait && now_s_() >= attend_s_) attend_s_ = before_wait();
}

/// Who waits for one rank alone would not hear that another has ended.
void RankNetwork::await(const std::string& what, const std::function<bool()>& is_there) {
  const double give_up_s = now_s_() + settings_.patience_s;
  for (std::uint32_t looks = 1; !is_there(); ++looks) {
    if (looks % looks_at_one == 0) attend(), read_all();
    check();
    if (now_s_() > give_up_s)
      throw SessionError(
          ExitStatus::connection_lost,
          what + " for " + std::to_string(static_cast<int>(settings_.patience_s)) + " s");
    wait(looks);
  }
}

void RankNetwork::check() const {
  if (settings_.must_end()) throw SessionError(ExitStatus::interrupted, "interrupted");
  if (error_) throw SessionError(*error_);
}

/// No more than up to the next mail, so that side messages behind it are as late as their sender
/// means them to be.
void RankNetwork::read(peer::PeerNumber from) {
  Other& other = others_[from];
  while (other.inbox.empty() && !other.has_left) {
    std::optional<rti::RankMessage> message = ranks_.receive(from);
    if (!message) break;
    take(from, std::move(*message));
  }
  deliver_deferred();
}

void RankNetwork::read_all() {
  for (peer::PeerNumber from = 0; from < others_.size(); ++from) read(from);
}

void RankNetwork::take(peer::PeerNumber from, rti::RankMessage message) {
  switch (static_cast<RankChannel>(message.channel)) {
    case RankChannel::mail:
      others_[from].inbox.push_back(std::move(message.bytes));
      return;
    case RankChannel::aside:
      if (terms_.interest.is_wanted() && deferred_.add(from, std::move(message.bytes))) return;
      break;
    case RankChannel::farewell:
      return take_farewell(from, message.bytes);
    case RankChannel::ending:
      // It also says how: whoever ends this process reads that.
      others_[from].has_left = true;
      ranks_.put_back(from, std::move(message));
      return lose(from, ExitStatus::connection_lost, " has ended");
  }
  lose(from, ExitStatus::failed, " sent what is no message");
}

void RankNetwork::take_farewell(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes) {
  const auto farewell = message_from<Farewell>(bytes);
  others_[from].has_left = true;
  if (!farewell) return lose(from, ExitStatus::failed, " sent what is no message");
  if (farewell->kind == FarewellKind::interrupted)
    lose(from, ExitStatus::connection_lost, " was interrupted, so all end");
  if (farewell->kind == FarewellKind::trouble)
    lose(from, ExitStatus::connection_lost, " ended: " + farewell->reason);
}

void RankNetwork::lose(peer::PeerNumber peer, ExitStatus status, const std::string& what) {
  if (!error_) error_.emplace(status, name_of(peer) + what);
}

void RankNetwork::deliver_deferred() {
  while (receive_aside) {
    std::optional<DeferredAsides::Aside> aside = deferred_.take();
    if (!aside) return;
    if (!receive_aside(aside->from, std::move(aside->bytes)))
      lose(aside->from, ExitStatus::failed, " sent a side message that no rank sends");
  }
}

void RankNetwork::rest_until(double time_s) {
  for (;;) {
    attend();
    read_all();
    check();
    const double left_s = time_s - now_s_();
    if (left_s <= 0.0) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, rest_s_max)));
  }
}

std::span<const std::uint8_t> RankNetwork::collect(std::span<const std::uint8_t> own) {
  ++collectives_;
  ranks_.begin_gathering(own);
  std::optional<std::span<const std::uint8_t>> all;
  await("some rank has not sent its part of a collective",
        [&] { return (all = ranks_.gathered()).has_value(); });
  return *all;
}

void RankNetwork::pass(peer::PeerNumber to, RankChannel channel, std::vector<std::uint8_t> bytes) {
  constexpr std::uint64_t segment = 1448;  // as over Ethernet, which ranks need not use
  rti::TransportCounters& sent = others_[to].sent;
  bytes_sent_ += bytes.size();
  sent.bytes_sent += bytes.size();
  ++sent.writes;
  sent.segments_sent += (bytes.size() + segment - 1) / segment;
  ranks_.send(to, message_of(channel, std::move(bytes)));
}

void RankNetwork::send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  pass(to, RankChannel::mail, std::move(bytes));
}

void RankNetwork::send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  pass(to, RankChannel::aside, std::move(bytes));
}

std::vector<std::uint8_t> RankNetwork::receive(peer::PeerNumber from) {
  assert(from < others_.size() && from != number());
  Other& other = others_[from];
  await(name_of(from) + " was silent", [&] {
    read(from);
    if (other.inbox.empty() && other.has_left)
      lose(from, ExitStatus::connection_lost, " left before the end");
    return !other.inbox.empty();
  });
  std::vector<std::uint8_t> first = std::move(other.inbox.front());
  other.inbox.pop_front();
  return first;
}

/// Places have equal size, each with its length first. Bytes count as sent to each other rank,
/// however the collective carries them.
std::vector<std::vector<std::uint8_t>> RankNetwork::share(peer::PeerNumber,
                                                          peer::PeerNumber peer_count,
                                                          std::vector<std::uint8_t> bytes) {
  bytes_sent_ += bytes.size() * (peer_count - 1);
  const std::span<const std::uint8_t> received = collect(in_its_place(bytes));
  std::vector<std::vector<std::uint8_t>> all;
  for (peer::PeerNumber from = 0; from < peer_count; ++from) {
    const auto part = out_of_its_place(received.subspan(from * rank_words, rank_words));
    all.emplace_back(part.begin(), part.end());
  }
  return all;
}

bool RankNetwork::have_all_left() const {
  return std::all_of(others_.begin(), others_.end(), [](const Other& one) { return one.has_left; });
}

/// The farewell takes a while to reach the others. What they send until then is received and thrown
/// away, or it would stay in their queues.
void RankNetwork::leave(const Farewell& farewell) {
  for (peer::PeerNumber to = 0; to < others_.size(); ++to)
    if (to != number()) ranks_.send(to, message_of(RankChannel::farewell, bytes_of(farewell)));
  receive_aside = [](peer::PeerNumber, const std::vector<std::uint8_t>&) { return true; };
  const double give_up_s = now_s_() + std::min(settings_.patience_s, farewells_s_max);
  for (std::uint32_t looks = 0; now_s_() < give_up_s; ++looks) {
    for (Other& other : others_) other.inbox.clear();
    read_all();
    if (have_all_left() && ranks_.unsent() == 0) return;
    wait(looks);
  }
}

}  // namespace rink::game
