// Agrees on who is lost, then on what the lost have said last.
#include "game/node/match/match_members.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "game/net/peer/network/peer_interrupted.h"
#include "game/peer/message_bytes.h"

namespace rink::game {
namespace {

/// A node says a round, and the next one before others have read it.
constexpr std::size_t waiting_max = 4;

bool is_round(std::span<const std::uint8_t> bytes) {
  return !bytes.empty() && (bytes.front() & 0x80) != 0;
}

peer::SessionSettings settings_of(peer::PeerNumber own, peer::PeerNumber count, bool is_surviving) {
  peer::SessionSettings settings{.number = own, .peer_count = count, .end_of = {}};
  settings.is_replicated = is_surviving;
  settings.keeps_to_neighbours = false;
  return settings;
}

peer::State state_of(const peer::Start& start, peer::PeerNumber count) {
  std::vector<peer::PeerNumber> members(count);
  std::iota(members.begin(), members.end(), peer::PeerNumber{0});
  peer::State state{.members = std::move(members),
                    .cuts = peer::Cuts::by_count(start.spec().field, {}, count)};
  state.slots = state.next_number = count;
  return state;
}

}  // namespace

MatchMembers::MatchMembers(peer::Mail& mail, const peer::Start& start, peer::PeerNumber own,
                           peer::PeerNumber count, bool is_surviving)
    : mail_(mail),
      settings_(settings_of(own, count, is_surviving)),
      own_(own),
      all_(state_of(start, count)),
      now_(all_),
      inbox_(settings_, peer::Validator(start), mail, false),
      said_(count),
      last_(count),
      waiting_(count) {
  assert(own < count);
  inbox_.make_room(count);
}

bool MatchMembers::takes_part(peer::PeerNumber node) const {
  const auto last = last_rounds_.find(node);
  return last == last_rounds_.end() || round_ < last->second;
}

/// Until nobody is lost any more.
template <class Attempt>
void MatchMembers::survive(Attempt&& attempt) {
  for (;;) try {
      if (inbox_.must_recover()) recover();
      return attempt();
    } catch (const peer::LossTold&) {
    } catch (const PeerInterrupted& gone) {
      note_gone(gone, true);
    } catch (const peer::PeerGone& gone) {
      note_gone(gone, gone.has_finished());
    }
}

/// What it has said before it went counts. One that only stood still learns that it is given up.
void MatchMembers::note_gone(const peer::PeerGone& gone, bool has_left) {
  if (!settings_.is_replicated) throw peer::Halt(gone.what());
  try {
    while (hooks_.next_mail) {
      std::optional<Bytes> bytes = hooks_.next_mail(gone.peer());
      if (!bytes) break;
      hear(gone.peer(), std::move(*bytes));
    }
  } catch (const peer::LossTold&) {
    return;                          // it has said what cannot be
  } catch (const peer::PeerGone&) {  // that was all
  }
  if (inbox_.losses().is_away(gone.peer())) return;
  peer::Loss farewell{.step = all_.step, .gone = inbox_.losses().gone()};
  farewell.questions.push_back({gone.peer(), peer::Answer::missed});
  mail_.send(gone.peer(), peer::written(std::move(farewell)));
  inbox_.note_gone(gone.peer(), gone.what(), has_left);
}

bool MatchMembers::hear(peer::PeerNumber from, Bytes bytes) {
  if (is_round(bytes)) {
    if (waiting_[from].size() >= waiting_max) inbox_.give_up(from, "says rounds ahead of all");
    waiting_[from].push_back(std::move(bytes));
    return false;
  }
  if (LastWords words; settings_.is_replicated && peer::read_whole(bytes, words)) {
    std::deque<LastWords>& told = told_[from];
    if (told.size() >= count()) told.pop_front();  // no more attempts than losses
    told.push_back(std::move(words));
    inbox_.count_word(from);
    return false;
  }
  if (peer::Loss loss;
      settings_.is_replicated && now_.members.size() <= 2 && peer::read(bytes, loss) &&
      std::ranges::find(loss.questions, peer::Question{own_, peer::Answer::missed}) !=
          loss.questions.end())
    inbox_.halt("peer " + std::to_string(from) +
                " has given this one up: it halts, others may go on");
  const bool is_news = inbox_.learns_of_loss(from, bytes, all_);
  if (!is_news) inbox_.count_word(from);
  return is_news;
}

MatchMembers::Bytes MatchMembers::next_round(peer::PeerNumber from) {
  while (waiting_[from].empty())
    if (hear(from, mail_.receive(from))) throw peer::LossTold(from, last_loss());
  Bytes first = std::move(waiting_[from].front());
  waiting_[from].pop_front();
  return first;
}

std::vector<MatchMembers::Bytes> MatchMembers::exchange(Bytes own) {
  assert(!has_said_ && is_round(own));
  survive([] {});
  for (const peer::PeerNumber to : now_.members)
    if (to != own_) mail_.send(to, own);
  said_[own_] = std::move(own);
  has_said_ = true;
  survive([&] {
    for (peer::PeerNumber from = 0; from < count(); ++from) {
      if (inbox_.must_recover()) throw peer::LossTold(own_, last_loss());
      if (said_[from] || !takes_part(from)) continue;
      if (const auto word = of_lost_.find({round_, from}); word != of_lost_.end())
        said_[from] = word->second;
      else if (is_lost(from))
        throw peer::ProtocolError("nobody has told what the lost peer " + std::to_string(from) +
                                  " said last");
      else said_[from] = next_round(from);
    }
  });
  for (peer::PeerNumber from = 0; from < count(); ++from)
    last_[from] = std::exchange(said_[from], std::nullopt).value_or(Bytes());
  has_said_ = false;
  ++round_;
  return last_;
}

void MatchMembers::finish_round() {
  std::erase_if(of_lost_, [this](const auto& word) { return word.first.first + 1 < round_; });
  let_go();
}

void MatchMembers::let_go() {
  for (const peer::PeerNumber node : std::exchange(leaving_, {}))
    if (takes_part(node)) leaving_.push_back(node);
    else if (hooks_.when_left) hooks_.when_left(node);
}

void MatchMembers::look() {
  survive([this] {
    for (const peer::PeerNumber from : now_.members)
      while (from != own_ && hooks_.next_mail) {
        std::optional<Bytes> bytes = hooks_.next_mail(from);
        if (!bytes) break;
        if (hear(from, std::move(*bytes))) throw peer::LossTold(from, last_loss());
      }
  });
}

void MatchMembers::give_up(peer::PeerNumber peer, const std::string& fault) try {
  inbox_.give_up(peer, fault);
} catch (const peer::LossTold&) {
  // All recover before the next round.
}

void MatchMembers::recover() {
  is_recovering_ = true;
  while (!agree()) {
  }
  const peer::Losses& losses = inbox_.losses();
  const peer::Losses::Majority majority = losses.majority(now_);
  if (majority == peer::Losses::Majority::none)
    inbox_.halt(losses.last() + ". Too few of " + std::to_string(now_.members.size()) +
                " nodes are left on this side: it halts, for the others may go on");
  keep_words_of_lost();
  std::map<peer::PeerNumber, LastWords> told{{own_, own_last_words()}};
  std::vector<peer::PeerNumber> others = now_.members;
  std::erase_if(others,
                [&](peer::PeerNumber node) { return node == own_ || losses.is_gone(node); });
  const Bytes own = peer::bytes_from(told.at(own_));
  for (const peer::PeerNumber to : others) mail_.send(to, own);
  for (const peer::PeerNumber from : others) told.emplace(from, last_words_of(from));
  follow_last_words(told);
  may_have_split_ = may_have_split_ || majority == peer::Losses::Majority::doubtful;
  newly_lost_.clear();
  for (const peer::PeerNumber node : losses.gone())
    if (now_.has(node)) {
      std::erase(now_.members, node);
      leaving_.push_back(node), newly_lost_.push_back(node);
      if (now_.cuts.has(node)) now_.cuts = now_.cuts.without(node);
    }
  inbox_.recovered();
  is_recovering_ = false;
  if (hooks_.when_recovered) hooks_.when_recovered();
  let_go();
}

/// As of a session of peers, but for steps to go back. False if there may be something new to tell.
bool MatchMembers::agree() {
  inbox_.tell(all_);
  const peer::Losses& losses = inbox_.losses();
  std::vector<peer::PeerNumber> awaited = all_.members;
  std::erase_if(awaited, [&](peer::PeerNumber node) {
    return node == own_ || losses.is_away(node) || losses.agrees(node);
  });
  if (awaited.empty()) return inbox_.has_settled(all_);
  auto [from, bytes] = mail_.receive_any(awaited);
  hear(from, std::move(bytes));
  return false;
}

/// They may be read, or wait.
void MatchMembers::keep_words_of_lost() {
  for (const peer::PeerNumber node : inbox_.losses().gone()) {
    if (!takes_part(node)) continue;
    if (!said_[node] && !waiting_[node].empty()) said_[node] = next_round(node);
    if (said_[node]) of_lost_.try_emplace({round_, node}, *said_[node]);
    if (!last_[node].empty() && round_ > 0) of_lost_.try_emplace({round_ - 1, node}, last_[node]);
  }
}

LastWords MatchMembers::own_last_words() {
  LastWords words{.round = round_, .gone = inbox_.losses().gone()};
  for (const auto& [key, bytes] : of_lost_)
    if (key.first + 1 >= round_) words.words.push_back({key.second, key.first, bytes});
  for (const auto& [node, round] : last_rounds_) words.last_rounds.push_back({node, round});
  if (hooks_.referee_words) words.referee = hooks_.referee_words();
  return words;
}

/// Those of an attempt that another loss has ended are left out.
LastWords MatchMembers::last_words_of(peer::PeerNumber from) {
  for (;;) {
    std::deque<LastWords>& told = told_[from];
    while (!told.empty() && told.front().gone != inbox_.losses().gone()) told.pop_front();
    while (told.size() > 1 && told[1].gone == told.front().gone) told.pop_front();
    if (!told.empty()) {
      LastWords words = std::move(told.front());
      told.pop_front();
      if (const std::string fault = fault_of(words); !fault.empty()) inbox_.give_up(from, fault);
      return words;
    }
    if (hear(from, mail_.receive(from))) throw peer::LossTold(from, last_loss());
  }
}

std::string MatchMembers::fault_of(const LastWords& words) const {
  if (words.round > round_ + 1 || words.round + 1 < round_)
    return "is at round " + std::to_string(words.round) + ", here it is " + std::to_string(round_);
  const auto is_gone = [&](peer::PeerNumber node) { return inbox_.losses().is_gone(node); };
  for (const LostWord& word : words.words)
    if (!is_gone(word.node) || word.round > words.round + 1 || word.round + 1 < words.round ||
        !is_round(word.bytes))
      return "tells what no lost peer has said";
  for (const LastRound& last : words.last_rounds)
    if (!is_gone(last.node) || !may_be_last(last, words))
      return "tells a last round of peer " + std::to_string(last.node) + " that cannot be";
  return {};
}

/// Who has learnt it in a recovery that did not end here was told then that this node is in this
/// round, and has all words up to the last.
bool MatchMembers::may_be_last(const LastRound& last, const LastWords& words) const {
  if (const auto known = last_rounds_.find(last.node); known != last_rounds_.end())
    return last.round == known->second;
  const bool is_said_here = of_lost_.count({round_, last.node}) > 0;
  if (last.round < round_ + is_said_here || last.round > round_ + 2) return false;
  for (std::uint64_t round = round_; round < last.round; ++round)
    if (std::ranges::none_of(words.words, [&](const LostWord& word) {
          return word.node == last.node && word.round == round;
        }))
      return false;
  return true;
}

/// Who has said a word of the furthest round to anybody takes part in it.
void MatchMembers::follow_last_words(const std::map<peer::PeerNumber, LastWords>& told) {
  std::uint64_t furthest = 0;
  for (const auto& [from, words] : told) {
    furthest = std::max(furthest, words.round);
    for (const LostWord& word : words.words)
      of_lost_.try_emplace({word.round, word.node}, word.bytes);
  }
  for (const peer::PeerNumber node : inbox_.losses().gone()) {
    for (const auto& [from, words] : told)
      for (const LastRound& last : words.last_rounds)
        if (last.node == node) last_rounds_.try_emplace(node, last.round);
    last_rounds_.try_emplace(node, furthest + of_lost_.count({furthest, node}));
  }
  for (const auto& [from, words] : told)
    if (from != own_ && hooks_.hear_referee && !hooks_.hear_referee(words.referee))
      inbox_.give_up(from, "tells what no referee has said");
}

}  // namespace rink::game
