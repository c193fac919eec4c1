// Adds losses in order, and counts who is left.
#include "game/peer/session/losses.h"
#include "im/basics/sorted_set.h"

#include <cassert>
#include <functional>
#include <utility>

namespace rink::peer {

bool Losses::note(PeerNumber peer, const std::string& what, bool has_finished) {
  if (has_finished && !State::is_in(finished_, peer))
    finished_.insert(std::ranges::upper_bound(finished_, peer), peer);
  if (is_gone(peer)) return false;
  last_ = what;
  gone_.insert(std::ranges::upper_bound(gone_, peer), peer);
  for (std::vector<Missed>* list : {&missed_, &doubted_})
    std::erase_if(*list, [&](const Missed& one) { return one.peer == peer; });
  return true;
}

bool Losses::misses(PeerNumber peer) const {
  return std::ranges::find(missed_, peer, &Missed::peer) != missed_.end();
}

bool Losses::miss(PeerNumber peer, const std::string& what) {
  assert(peer != own_ && !what.empty());
  if (is_away(peer)) return false;
  missed_.push_back({peer, what});
  return true;
}

void Losses::doubt(PeerNumber peer, const std::string& what) {
  assert(peer != own_ && !what.empty());
  if (!is_away(peer)) doubted_.push_back({peer, what});
}

/// The peers that this one, or a peer that it hears, hears no more. Each loss begins the questions
/// anew, or those that it has settled would go round for ever.
std::vector<PeerNumber> Losses::asked() const {
  std::vector<PeerNumber> peers;
  for (const std::vector<Missed>* list : {&missed_, &doubted_})
    for (const Missed& one : *list) peers.push_back(one.peer);
  for (PeerNumber from = 0; from < heard_.size(); ++from) {
    if (!heard_[from] || is_away(from) || heard_[from]->gone != gone_) continue;
    for (const Question& question : heard_[from]->questions)
      if (!is_gone(question.peer)) peers.push_back(question.peer);
  }
  make_sorted_set(peers);
  return peers;
}

Answer Losses::answer_in(const Loss& told, PeerNumber peer) {
  const auto question = std::ranges::find(told.questions, peer, &Question::peer);
  return question == told.questions.end() ? Answer::open : question->answer;
}

/// One is heard that answers that it is there. Who is no member at this step is nobody here.
Answer Losses::answer(PeerNumber peer, const State& now) const {
  if (peer == own_) return Answer::heard;
  if (misses(peer) || !now.has(peer)) return Answer::missed;
  const bool has_answered =
      heard(peer) && heard(peer)->gone == gone_ && answer_in(*heard(peer), peer) == Answer::heard;
  return has_answered ? Answer::heard : Answer::open;
}

Loss Losses::told(const State& now) const {
  Loss loss{.step = now.step, .gone = gone_, .finished = finished_};
  for (const PeerNumber peer : asked()) loss.questions.push_back({peer, answer(peer, now)});
  return loss;
}

bool Losses::is_news(PeerNumber from, const Loss& told) const {
  const std::vector<PeerNumber> known = asked();
  return std::ranges::any_of(told.gone, [&](PeerNumber peer) { return !is_gone(peer); }) ||
         (!is_away(from) && told.gone == gone_ &&
          std::ranges::any_of(told.questions, [&](const Question& question) {
            return !State::is_in(known, question.peer);
          }));
}

bool Losses::agrees(PeerNumber from) const {
  return heard(from) && heard(from)->gone == gone_ &&
         std::ranges::equal(asked(), heard(from)->questions, {}, {}, &Question::peer) &&
         std::ranges::none_of(heard(from)->questions, [](const Question& question) {
           return question.answer == Answer::open;
         });
}

/// Of who is not heard here nothing is known but that it does not hear this one, if others ask
/// about this one.
Answer Losses::answer_by(PeerNumber voter, PeerNumber peer, const State& now) const {
  if (voter == own_) return answer(peer, now);
  if (misses(voter)) return peer == own_ ? Answer::missed : Answer::open;
  return heard(voter) ? answer_in(*heard(voter), peer) : Answer::open;
}

Losses::Votes Losses::votes_on(PeerNumber peer, const State& now,
                               std::span<const Sentence> sentences) const {
  Votes votes;
  for (const PeerNumber voter : now.members) {
    if (voter == peer || is_gone(voter) ||
        std::ranges::find(sentences, voter, &Sentence::peer) != sentences.end())
      continue;
    const Answer answer = answer_by(voter, peer, now);
    if (answer == Answer::missed) votes.missing.push_back(voter);
    votes.hearing += answer == Answer::heard;
  }
  return votes;
}

std::string Losses::reason(PeerNumber peer) const {
  for (const std::vector<Missed>* list : {&missed_, &doubted_})
    for (const Missed& one : *list)
      if (one.peer == peer) return one.what;
  return "peer " + std::to_string(peer) + " is gone, according to most";
}

std::vector<Losses::Sentence> Losses::settle(const State& now, bool are_doubts_right) {
  std::vector<Sentence> sentences;
  for (const PeerNumber peer : asked()) {
    if (std::ranges::find(sentences, peer, &Sentence::peer) != sentences.end()) continue;
    const Votes votes = votes_on(peer, now, sentences);
    if (votes.missing.size() > votes.hearing || (are_doubts_right && votes.missing.empty())) {
      sentences.push_back({peer, reason(peer)});
      continue;
    }
    for (const PeerNumber voter : votes.missing)
      sentences.push_back({voter, "peer " + std::to_string(voter) + " says that peer " +
                                      std::to_string(peer) + " is gone, which answers"});
  }
  for (std::optional<Loss>& told : heard_)
    if (told) told->questions.clear();
  doubted_.clear();
  return sentences;
}

void Losses::begin(const State& now) {
  std::erase_if(gone_, [&](PeerNumber peer) { return !now.has(peer); });
  std::erase_if(missed_, [&](const Missed& one) { return !now.has(one.peer); });
  gone_.insert(gone_.end(), now.gone.begin(), now.gone.end());
  std::sort(gone_.begin(), gone_.end());
}

/// Peers are at most a step apart, and a member's number was assigned at an earlier step.
std::string Losses::fault_of(const Loss& told, const State& now) {
  assert(std::ranges::is_sorted(told.gone));
  if (!told.gone.empty() && told.gone.back() >= now.next_number)
    return "sends the loss of peer " + std::to_string(told.gone.back()) + ", which never was";
  if (!told.questions.empty() && told.questions.back().peer >= now.next_number)
    return "asks for peer " + std::to_string(told.questions.back().peer) + ", which never was";
  if (told.step > now.step + 1)
    return "is at step " + std::to_string(told.step) + ", here it is " + std::to_string(now.step);
  return {};
}

void Losses::hear(PeerNumber from, Loss told) {
  assert(from < heard_.size());
  heard_[from] = std::move(told);
}

const std::optional<Loss>& Losses::heard(PeerNumber from) const {
  assert(from < heard_.size());
  return heard_[from];
}

void Losses::make_room(PeerNumber slots) {
  if (slots > heard_.size()) heard_.resize(slots);
}

/// A majority is more than half; or half, with the first of them. Of two peers either continues,
/// but the second one cannot know whether the first does too.
Losses::Majority Losses::majority_of(std::vector<PeerNumber> voters) const {
  std::erase_if(voters, [&](PeerNumber peer) { return State::is_in(finished_, peer); });
  const std::size_t count = voters.size();
  const auto left = static_cast<std::size_t>(
      std::count_if(voters.begin(), voters.end(), [&](PeerNumber peer) { return !is_gone(peer); }));
  if (left > 0 && (2 * left > count || (2 * left == count && !is_gone(voters.front()))))
    return Majority::sure;
  assert(left <= count);
  return left > 0 && count == 2 ? Majority::doubtful : Majority::none;
}

/// Majorities of neighbouring steps must have a common peer, too.
Losses::Majority Losses::majority(const State& now) const {
  return std::min(majority_of(now.voters()), majority_of(now.next_voters()));
}

void Losses::check() const {
  assert(std::ranges::adjacent_find(gone_, std::greater_equal<>()) == gone_.end());
  assert(std::ranges::includes(gone_, finished_));
}

}  // namespace rink::peer
