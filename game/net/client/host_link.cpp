// Measures a host's clock, and notices its loss.
#include "game/net/client/host_link.h"

namespace rink::game {
namespace {

/// Why the connection ended, as a player would say it.
std::string words_of(rti::CloseReason reason) {
  using enum rti::CloseReason;
  if (reason == closed_by_peer) return "the host has ended or left";
  if (reason == queue_full) return "the network is too slow for this match";
  if (reason == too_fast) return "the host was sent more than it allows";
  if (reason == too_many) return "too many have joined from this address";
  return "the network connection is broken";
}

/// `why` names the versions of both ends as the RTI does.
std::string words_of(rti::Refusal refusal, const std::string& why) {
  if (refusal == rti::Refusal::wrong_version || refusal == rti::Refusal::wrong_fom)
    return "this Rink and the host's are of different versions, and play together only if they are "
           "of one: " +
           why;
  return "the host refuses: " + why;
}

constexpr double match_patience_s = 3.0;  ///< for the state of a match, once joined
constexpr double join_patience_s = 5.0;   ///< for the first word

}  // namespace

HostLink::HostLink(Client& client, rti::Transport& transport, rti::ConnectionId connection,
                   bool is_player)
    : client_(client),
      transport_(transport),
      link_(client.ambassador(), transport, connection),
      is_player_(is_player) {
  links_.add(link_);
}

void HostLink::leave(double now_s) {
  if (client_.ambassador().is_joined()) client_.ambassador().resign();
  link_.flush(now_s);
  link_.close();
}

void HostLink::lose(const std::string& why) {
  error_ = why.empty() ? "the connection is lost" : why;
}

void HostLink::converse(double now_s) {
  transport_.poll({}, links_);
  if (!begun_s_) begun_s_ = now_s;
  if (!joined_s_ && client_.ambassador().is_joined()) joined_s_ = now_s;
  listen(now_s);
  look_for_errors(now_s);
  if (is_lost()) return;
  if (const auto pong = client_.remote()->take_pong())
    clock_.answered(pong->number, pong->server_s, now_s);
  clock_.advance(now_s);
  if (!client_.ambassador().is_joined() || !client_.replicas().has_match()) return;
  if (const auto question = clock_.ask(now_s)) client_.remote()->ping(*question);
}

/// A window that itself stood still reads first what has come meanwhile.
void HostLink::listen(double now_s) {
  const std::uint64_t frames = client_.ambassador().counters().frames_received;
  if (!joined_s_ || frames != heard_frames_) heard_s_ = now_s;
  heard_frames_ = frames;
  silent_s_ = now_s - heard_s_;
}

void HostLink::look_for_errors(double now_s) {
  const Joining& joining = client_.joining();
  const std::string beginning = joined_s_ ? "" : "no answer from the host: ";
  if (client_.state() == Client::State::refused)
    lose(joining.refusal() ? words_of(*joining.refusal(), joining.error())
                           : "the match is full: " + joining.error());
  else if (link_.is_finished() && joined_s_ &&
           link_.close_reason() != rti::CloseReason::closed_by_us)
    lose(words_of(link_.close_reason()));
  else if (client_.state() == Client::State::lost) lose(beginning + joining.error());
  else if (link_.is_finished()) lose(beginning + words_of(link_.close_reason()));
  else if (!joined_s_ && now_s > *begun_s_ + join_patience_s)
    lose(beginning + "it accepts the connection, but says nothing");
  else if (is_player_ && joined_s_ && now_s > *joined_s_ + match_patience_s &&
           !client_.replicas().has_match())
    lose("no match is hosted there; the game can be watched");
}

}  // namespace rink::game
