// A network match with all that it needs: object model, TCP connection, client.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "game/match/match_source.h"
#include "game/net/client/network_match.h"
#include "game/replication/object_model.h"
#include "rti/fom/fom.h"
#include "rti/transport/staged/staged_transport.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::game {

class JoinedMatch final : public MatchSource {
 public:
  /// `place`: HOST:PORT. Throws std::invalid_argument or rti::TransportError that names its fault;
  /// an unreachable server shows later, as a match that is lost. With a key file, both ends prove
  /// that they have the same.
  JoinedMatch(const std::string& place, const NetworkMatchSettings& settings,
              const std::string& key_file = "");
  /// Resigns from the server's federation.
  ~JoinedMatch() override;

  void advance(double now_s) override { match_.advance(now_s_ = now_s); }
  const MatchSight& sight() const override { return match_.sight(); }
  std::uint32_t hand_count() const override { return match_.hand_count(); }
  void press(std::uint32_t hand, Key key, bool is_down) override {
    match_.press(hand, key, is_down);
  }
  void reach(std::uint32_t hand, const std::optional<Vector2>& place) override {
    match_.reach(hand, place);
  }
  std::string why_keys_alone() const override { return match_.why_keys_alone(); }
  void pause(bool is_wanted) override { match_.pause(is_wanted); }
  void rematch() override { match_.rematch(); }
  void inspect(std::uint32_t thing) override { match_.inspect(thing); }
  /// It is received, not only reached.
  bool is_in_match() const {
    return match_.sight().phase != MatchPhase::lost &&
           match_.client().state() == Client::State::playing;
  }
  /// See NetworkMatch::player().
  std::optional<std::uint32_t> player() const { return match_.player(); }

 private:
  static rti::ConnectionId connect(rti::TcpTransport& transport, const std::string& place);

  rti::Fom fom_;
  ObjectModel model_;
  rti::TcpTransport transport_;
  double now_s_ = 0.0;
  rti::StagedTransport gate_;
  NetworkMatch match_;
};

}  // namespace rink::game
