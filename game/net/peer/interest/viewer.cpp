// Sends and receives side messages at the steps of a session's windows.
#include "game/net/peer/interest/viewer.h"

#include <algorithm>

#include "game/net/peer/network/frames.h"
#include "im/filter.h"
#include "rti/wire/stream.h"

namespace rink::game {

namespace {

/// The window of an update message.
std::uint32_t window_of(rti::Bytes updates) {
  rti::Reader reader(updates);
  std::uint32_t window = 0;
  return reader.varint(window) ? window : 0;
}

}  // namespace

Viewer::Viewer(const SharedGame& game, InterestSettings settings, SideChannel& side_channel)
    : game_(game), settings_(std::move(settings)), side_channel_(side_channel) {
  if (const auto complaint = im::complaint_about(settings_.scheme, {}))
    throw peer::ProtocolError("the first peer has a faulty scheme: " + *complaint);
  if (settings_.policy != "on-event" && settings_.policy != "periodic")
    throw peer::ProtocolError("the first peer names the policy '" + settings_.policy +
                              "': expected on-event or periodic");
}

Viewer::~Viewer() { side_channel_.receive_aside = {}; }

void Viewer::begin(const peer::Session& session) {
  session_ = &session;
  members_ = session.members();
  lost_ = session.is_recovering() ? peer::numbers_max : session.lost().size();
  InterestSettings settings = settings_;
  settings.bats = bats();
  settings.is_late = session.step() > 0;
  interest_.emplace(
      SharedStart{game_.scene(), game_.start(), game_.extent_max()}, settings, session.peer(),
      session.division(),
      [this](peer::PeerNumber to, Traffic about, const std::vector<std::uint8_t>& content) {
        sent_[static_cast<std::size_t>(about)] += content.size();
        framed_bytes_[static_cast<std::size_t>(about)] += framed_size(1 + content.size());
        ++messages_sent_[static_cast<std::size_t>(about)];
        side_channel_.send_aside(to, with_purpose(about, content));
      });
  interest_->set_members(members_, bats());
  interest_->note_places();
  side_channel_.receive_aside = [this](peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    return receive(from, std::move(bytes));
  };
}

/// By peer, the bats that all agree on.
std::vector<std::uint32_t> Viewer::bats() const {
  std::vector<std::uint32_t> bats = settings_.bats;
  bats.resize(session_->slots(), no_bat);
  for (const peer::Player& player : session_->players())
    if (player.bat_count > 0 && player.peer < bats.size())
      bats[player.peer] = game_.start().bat(player.first_bat)->index;
  return bats;
}

/// The members follow from the step, which no peer gets before all others have what leads to it; so
/// all settle before they handle a newcomer's message.
void Viewer::settle() {
  if (session_->members() == members_) return;
  members_ = session_->members();
  interest_->set_members(members_, bats());
}

bool Viewer::receive(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
  if (bytes.empty() || bytes[0] >= traffic_count) return false;
  if (!is_recovering()) return apply(from, bytes);
  put_off_.emplace_back(from, std::move(bytes));
  return true;
}

/// Messages that a peer sent before it left no longer count.
bool Viewer::apply(peer::PeerNumber from, std::span<const std::uint8_t> bytes) {
  settle();
  if (!std::binary_search(members_.begin(), members_.end(), from)) return true;
  return interest_->receive(from, static_cast<Traffic>(bytes[0]), std::as_bytes(bytes.subspan(1)));
}

void Viewer::when_played() {
  if (is_recovering()) return;
  settle();
  interest_->begin_window();
  interest_->look_around();
}

void Viewer::when_told() {
  if (is_recovering()) return;
  interest_->finish(static_cast<std::uint32_t>(session_->window() + 1));
  if (on_final) on_final();
}

void Viewer::when_stepped() {
  const bool has_recovered = is_recovering();
  lost_ = session_->lost().size();
  if (!has_recovered) {
    settle();
    interest_->note_places();
  } else {
    members_ = session_->members();
    interest_->begin_again(members_, bats());
    // Senders have forgotten their updates of windows up to this one.
    for (const auto& [from, bytes] : std::exchange(put_off_, {}))
      if (static_cast<Traffic>(bytes[0]) != Traffic::updates ||
          window_of(std::as_bytes(std::span(bytes).subspan(1))) > session_->window())
        apply(from, bytes);
  }
  if (on_commit) on_commit();
}

void Viewer::end() {
  std::vector<std::uint32_t> scope;
  interest_->list_scope(scope);
  in_view_ = scope.size();
  told_of_ =
      static_cast<std::size_t>(std::count_if(scope.begin(), scope.end(), [&](std::uint32_t body) {
        return interest_->replicas().replica(body).is_there;
      }));
  side_channel_.receive_aside = [](peer::PeerNumber, const std::vector<std::uint8_t>&) {
    return true;
  };  // others may still send messages
  interest_.reset();
}

}  // namespace rink::game
