// Reads what the node says, and shows its match.
#include "game/view/match_among_peers.h"

#include <algorithm>
#include <utility>

#include "game/match/sight.h"
#include "game/net/late_players.h"

namespace rink::view {
namespace {

constexpr double notice_s = 8.0;

std::string rest_of(const std::string& line, const std::string& beginning) {
  return line.starts_with(beginning) ? line.substr(beginning.size()) : std::string();
}

}  // namespace

MatchAmongPeers::MatchAmongPeers(const game::Scene& scene, const HostSettings& host,
                                 const std::string& name)
    : name_(name),
      key_file_(host.key_file),
      host_(host),
      sight_(game::sight_of(scene)),
      words_("listening on " + host_.node_place() + "\n"),
      waiting_("this peer listens on " + host_.node_place() + "; waiting for the others") {}

void MatchAmongPeers::advance(double now_s) {
  now_s_ = now_s;
  const std::string said = host_.take_words();
  words_ += said;
  for (const char letter : said)
    if (letter == '\n') hear(std::exchange(line_, {}));
    else line_ += letter;
  if (match_) match_->advance(now_s);
  show();
}

void MatchAmongPeers::hear(const std::string& line) {
  if (const std::string place = rest_of(line, "listening on "); !place.empty() && !match_)
    join(place);
  const std::string news = rest_of(line, "rink-serve: ");
  if (news.empty()) return;
  notice_ = news, notice_s_ = now_s_;
  if (const auto place = game::place_for_late_players(news); place && !match_) {
    is_elsewhere_ = true;
    join(*place);
  }
}

void MatchAmongPeers::join(const std::string& place) try {
  match_ = std::make_unique<game::JoinedMatch>(place, game::NetworkMatchSettings{.name = name_},
                                               key_file_);
} catch (const std::exception& error) {
  notice_ = error.what();
}

/// Of a node that has ended the last words say why.
void MatchAmongPeers::show() {
  if (match_) sight_ = match_->sight();
  else sight_.notice = waiting_;
  if (host_.has_ended() && !(is_elsewhere_ && match_)) {
    sight_.phase = game::MatchPhase::lost;
    sight_.notice = notice_.empty() ? "the node of this match has ended" : notice_;
  } else if (match_ && !is_elsewhere_ && sight_.notice.empty() && now_s_ < notice_s_ + notice_s) {
    sight_.notice = notice_;
  }
}

}  // namespace rink::view
