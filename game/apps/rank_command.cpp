// Ends ranks together: the launcher kills all others as soon as one has failed.
#include "game/apps/rank_command.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "game/apps/command.h"

namespace rink::game {
namespace {

constexpr int lost = static_cast<int>(ExitStatus::connection_lost);
constexpr std::uint8_t ending = static_cast<std::uint8_t>(RankChannel::ending);

/// By rank; nothing of one that has not ended.
using Endings = std::vector<std::optional<int>>;

void hear_endings(rti::Ranks& ranks, Endings& endings) {
  for (std::uint32_t from = 0; from < ranks.count(); ++from)
    while (!endings[from]) {
      const std::optional<rti::RankMessage> message = ranks.receive(from);
      if (!message) break;
      if (message->channel == ending && message->bytes.size() == 1)
        endings[from] = message->bytes.front();
    }
}

/// Who ended only because another one had ends with the status of that one.
int shared_status(int own, const Endings& endings) {
  if (own != lost) return own;
  const auto cause = std::ranges::find_if(endings, [](const std::optional<int>& other) {
    return other && *other != 0 && *other != lost;
  });
  return cause == endings.end() ? own : cause->value_or(own);
}

}  // namespace

std::invalid_argument said_by_launcher(const std::string& flags) {
  return std::invalid_argument(
      flags +
      ": with --transport mpi the launcher says how many there are and brings them together "
      "(mpirun -np 4): expected none of these");
}

rti::Ranks& RankCommand::begin() { return ranks_.emplace(); }

int RankCommand::run(const std::function<ExitStatus()>& play) {
  int own = 0;
  try {
    own = static_cast<int>(play());
  } catch (const std::exception& error) {
    if (!ranks_) throw;
    own = explained(error);
  }
  return ranks_ ? end(own) : own;
}

int RankCommand::explained(const std::exception& error) const {
  const bool is_thrown_at_all = dynamic_cast<const RanksDiffer*>(&error) != nullptr;
  if (!is_thrown_at_all) complain("rank ", ranks_->number(), ": ", error.what());
  else if (ranks_->number() == 0) complain(error.what());
  return status_of_(error);
}

/// A rank that is still busy after a failure elsewhere is not waited for; one that still has
/// players is, however long they stay.
int RankCommand::end(int own) {
  const double give_up_s = own == 0 ? std::numeric_limits<double>::infinity() : now_s() + 5.0;
  Endings endings(ranks_->count());
  endings[ranks_->number()] = own;
  for (std::uint32_t to = 0; to < ranks_->count(); ++to)
    if (to != ranks_->number())
      ranks_->send(to, {.channel = ending, .bytes = {static_cast<std::uint8_t>(own)}});
  while (!std::ranges::all_of(endings, &std::optional<int>::has_value) || ranks_->unsent() > 0) {
    if (now_s() > give_up_s) ranks_->abort(own);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    hear_endings(*ranks_, endings);
  }
  const int status = shared_status(own, endings);
  if (ranks_->is_gathering()) ranks_->abort(status);
  ranks_->finish();
  return status;
}

}  // namespace rink::game
