// Learns of losses, and gives up who lies.
#include "game/peer/session/inbox.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "game/peer/verdict_tree.h"
#include "im/basics/fnv_hash.h"

namespace rink::peer {

namespace {

std::uint32_t result_of(const std::vector<Handover>& parts) {
  Fnv64 hash;
  for (const Handover& part : parts)
    for (const std::uint8_t byte : written(part)) hash.add(byte);
  return static_cast<std::uint32_t>(hash.value() ^ hash.value() >> 32);
}

}  // namespace

Inbox::Inbox(const SessionSettings& settings, Validator validator, Mail& mail, bool is_newcomer)
    : settings_(settings),
      validator_(std::move(validator)),
      mail_(mail),
      losses_(settings.number),
      is_newcomer_(is_newcomer) {}

Handover Inbox::final_handover(PeerNumber from, const State& now) {
  Handover part = received<Handover>(from, now);
  if (const std::string fault = validator_.fault_of_last(part, now.time); !fault.empty())
    give_up(from, fault);
  return part;
}

/// Whoever tells one peer another end than the next would leave two results otherwise. Who misses
/// one of the others compares with all that are left: no two of them may end with different ones.
void Inbox::confirm(const std::vector<Handover>& parts, const State& now) {
  Handover result;
  result.window = result_of(parts);
  confirmed_.clear();
  for (const PeerNumber to : now.members)
    if (to != settings_.number) mail_.send(to, written(result));
  for (const PeerNumber from : now.members)
    if (from != settings_.number) await_result(from, result.window, now);
  for (const PeerNumber peer : now.members)
    if (peer != settings_.number && !has_confirmed(peer)) throw LossTold(peer, losses_.last());
}

bool Inbox::is_confirmed(const State& now) const {
  return std::ranges::all_of(now.members, [&](PeerNumber peer) {
    return peer == settings_.number || has_confirmed(peer) || losses_.is_away(peer);
  });
}

/// Who tells of losses instead recovers, and waits for this one to do so, too.
void Inbox::await_result(PeerNumber from, std::uint32_t result, const State& now) {
  while (!losses_.is_away(from)) try {
      const std::vector<std::uint8_t> bytes = mail_.receive(from);
      Handover message;
      if (!read(bytes, message)) {
        learns_of_loss(from, bytes, now), count_word(from);
        if (must_recover_) throw LossTold(from, losses_.last());
        continue;
      }
      if (message.window != result)
        throw ProtocolError("peer " + std::to_string(from) +
                            " ended with another result than this one: neither counts");
      confirmed_.push_back(from);
      return;
    } catch (const LossTold&) {
      throw;
    } catch (const PeerGone& gone) {
      note_gone(gone.peer(), gone.what(), gone.has_finished());
    }
}

bool Inbox::learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes, const State& now) {
  Loss loss;
  if (!settings_.is_replicated || !read(bytes, loss)) give_up(from, "sent what is no message");
  std::string fault = validator_.fault_of(loss);
  if (fault.empty()) fault = Losses::fault_of(loss, now);
  // By the tree it may be who told it: all look for the link when they agree on who is lost.
  if (fault.empty() && !settings_.agrees_by_tree(now.members.size()) &&
      Marks::differ(marks_.told(now, before_ ? *before_ : now), loss.marks))
    fault = "has told this one something else than the others";
  if (!fault.empty()) give_up(from, fault);
  const bool is_missed =
      std::ranges::find(loss.questions, Question{settings_.number, Answer::missed}) !=
      loss.questions.end();
  // Of two peers neither has anybody else to ask.
  if (State::is_in(loss.gone, settings_.number) || (is_missed && now.members.size() <= 2))
    halt("peer " + std::to_string(from) + " has given this one up: it halts, others may go on");
  const bool is_news = losses_.is_news(from, loss), has_begun = must_recover_;
  for (const PeerNumber peer : loss.gone)
    if (const bool has_finished = State::is_in(loss.finished, peer);
        has_finished || !losses_.is_gone(peer))
      lose(peer,
           "peer " + std::to_string(peer) + " is gone, according to peer " + std::to_string(from),
           has_finished);
  losses_.hear(from, std::move(loss));
  const bool is_alarm = is_news && !has_begun && !must_recover_;  // a question alone
  must_recover_ = must_recover_ || is_news;
  if (is_alarm) count_alarm(from);
  return is_news;
}

/// Who passes a question on is counted by those that hear it there first, so a liar that asks
/// others by turns can have one of them given up; but who says that peers are gone is believed
/// anyway.
void Inbox::count_alarm(PeerNumber from) {
  if (++alarms_.at(from) > alarms_max) give_up(from, "asks again and again for peers that answer");
}

void Inbox::recovered() {
  must_recover_ = false;
  std::ranges::fill(said_, 0);
  // Of the next loss all are told, even if there is nothing else to tell than at the last one.
  for (std::vector<std::uint8_t>& told : told_) told.clear();
  const std::size_t gone = losses_.gone().size();
  if (std::exchange(gone_before_, gone) != gone) std::ranges::fill(alarms_, 0);
}

void Inbox::lose(PeerNumber peer, const std::string& what, bool has_finished) {
  const bool is_parted = losses_.is_away(peer);
  must_recover_ = must_recover_ || !losses_.is_gone(peer);
  losses_.note(peer, what, has_finished);
  if (!is_parted) mail_.part(peer, true);
}

void Inbox::tell(const State& now) {
  Loss loss = losses_.told(now);
  loss.marks = marks_.told(now, before_ ? *before_ : now);
  const std::vector<std::uint8_t> bytes = written(std::move(loss));
  for (const PeerNumber to : now.members) {
    if (to == settings_.number || losses_.is_away(to) || told_.at(to) == bytes) continue;
    mail_.send(to, bytes);
    told_[to] = bytes;
  }
}

/// A liar may change a decision on its way down the tree. If the two ends of a link report
/// different decisions, one end lies, and the other members cannot tell which; a member that
/// differs from several others is the liar.
std::vector<Losses::Sentence> Inbox::parted_links(const State& now) const {
  struct Link {
    PeerNumber above, below;
  };
  std::vector<Link> links;
  std::vector<std::size_t> counts(now.members.back() + 1, 0);
  const VerdictTree tree(now.members.size());
  const auto marks_of = [&](PeerNumber peer) {
    if (peer == settings_.number) return marks_.told(now, before_ ? *before_ : now);
    return losses_.heard(peer) ? losses_.heard(peer)->marks : std::vector<Mark>();
  };
  for (std::size_t place = 1; place < now.members.size(); ++place) {
    const Link link{now.members[tree.parent(place)], now.members[place]};
    if (losses_.is_away(link.below) || losses_.is_away(link.above) ||
        !Marks::differ(marks_of(link.above), marks_of(link.below)))
      continue;
    links.push_back(link), ++counts[link.above], ++counts[link.below];
  }
  std::vector<Losses::Sentence> sentences;
  const auto is_named = [&](PeerNumber peer) {
    return std::ranges::find(sentences, peer, &Losses::Sentence::peer) != sentences.end();
  };
  for (const PeerNumber peer : now.members)
    if (counts[peer] > 1)
      sentences.push_back({peer, "peer " + std::to_string(peer) +
                                     " differs with several about what all have decided"});
  for (const auto& [above, below] : links)
    if (!is_named(above) && !is_named(below))
      for (const PeerNumber end : {above, below})
        sentences.push_back({end, "peers " + std::to_string(above) + " and " +
                                      std::to_string(below) +
                                      " differ about what all have decided"});
  return sentences;
}

bool Inbox::has_settled(const State& now) {
  const bool is_by_tree = settings_.agrees_by_tree(now.members.size());
  if (is_by_tree)
    if (const std::vector<Losses::Sentence> parted = parted_links(now); !parted.empty()) {
      losses_.drop_doubts();
      for (const auto& [peer, what] : parted)
        if (peer == settings_.number) halt(what + ": it halts, others may go on");
      for (const auto& [peer, what] : parted) lose(peer, what, false);
      return false;
    }
  const std::vector<Losses::Sentence> sentences = losses_.settle(now, is_by_tree);
  for (const auto& [peer, what] : sentences) {
    if (peer == settings_.number)
      halt(
          "most others hear what this one does not, or do not hear it: it halts, others may go "
          "on");
    lose(peer, what, false);
  }
  return sentences.empty() && !losses_.has_missed();
}

void Inbox::note_gone(PeerNumber peer, const std::string& what, bool has_finished) {
  assert(peer != settings_.number);
  if (!settings_.is_replicated) throw Halt(what);
  must_recover_ = true;
  if (has_finished) lose(peer, what, true);
  else if (losses_.miss(peer, what)) mail_.part(peer, true);
}

void Inbox::give_up(PeerNumber peer, const std::string& fault) {
  assert(peer != settings_.number && !fault.empty());
  const std::string what = "peer " + std::to_string(peer) + " " + fault;
  if (!settings_.is_replicated) throw ProtocolError(what);
  if (are_faults_deferred_) losses_.doubt(peer, what), must_recover_ = true;
  else lose(peer, what, false);
  throw LossTold(peer, what);
}

void Inbox::halt(const std::string& what) const {
  if (is_newcomer_) throw SentAway(what);
  throw Halt(what);
}

void Inbox::begin(const State& now) {
  assert(is_newcomer_);
  losses_.begin(now);
  must_recover_ = losses_.has_missed() || std::ranges::any_of(losses_.gone(), [&](PeerNumber peer) {
                    return now.has(peer);
                  });
}

}  // namespace rink::peer
