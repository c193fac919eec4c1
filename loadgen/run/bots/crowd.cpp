// Connects, sums and ends bots; lost bots count in all sums but send nothing more.
#include "loadgen/run/bots/crowd.h"

#include <cassert>
#include <utility>

#include "rti/transport/federate_link.h"
#include "rti/transport/socket_transport.h"

namespace rink::loadgen {

Bot& Crowd::add(std::unique_ptr<Bot> bot) {
  assert(bot_of_connection_.empty() && "all are added before they connect");
  bot->number = size();
  bots_.push_back(std::move(bot));
  return *bots_.back();
}

void Crowd::connect(const Connect& connect) {
  for (const std::unique_ptr<Bot>& bot : bots_) {
    bot->connection = connect(bot->number);
    if (bot_of_connection_.size() <= bot->connection)
      bot_of_connection_.resize(bot->connection + std::size_t{1});
    bot_of_connection_[bot->connection] = bot->number;
  }
}

void Crowd::send(Bot& bot) {
  rti::send_waiting(bot.client.ambassador(), transport_, bot.connection);
}

void Crowd::lose(Bot& bot, const std::string& why, game::ExitStatus status) {
  if (bot.is_lost) return;
  bot.is_lost = true;
  ++lost_;
  if (!first_error_.empty()) return;
  first_error_ = why;
  first_status_ = status;
}

void Crowd::resign() {
  for_each_present([this](Bot& bot) {
    bot.client.ambassador().resign();
    send(bot);
    transport_.close(bot.connection);
  });
}

std::uint64_t Crowd::unanswered_keys() const {
  std::uint64_t count = 0;
  for (const std::unique_ptr<Bot>& bot : bots_) count += bot->probe.unanswered();
  return count;
}

std::size_t Crowd::memory_bytes() const {
  std::size_t sum = 0;
  for (const std::unique_ptr<Bot>& bot : bots_) sum += bot->client.memory_bytes();
  return sum;
}

std::vector<std::uint64_t> Crowd::received_by_bot() const {
  std::vector<std::uint64_t> bytes;
  bytes.reserve(bots_.size());
  for (const std::unique_ptr<Bot>& bot : bots_)
    bytes.push_back(rti::with_datagrams(transport_.counters(bot->connection)).bytes_received);
  return bytes;
}

CrowdTraffic Crowd::traffic() const {
  CrowdTraffic sum;
  const auto add = [&sum](const rti::TransportCounters& counters) {
    sum.bytes_sent += counters.bytes_sent;
    sum.bytes_received += counters.bytes_received;
    sum.segments_sent += counters.segments_sent;
    sum.acknowledgements_sent += counters.acknowledgements_sent;
    sum.kernel_segments_sent += counters.kernel_segments_sent.value_or(counters.segments_sent);
    sum.kernel_bytes_sent += counters.kernel_bytes_sent.value_or(counters.bytes_sent);
    sum.kernel_bytes_received += counters.kernel_bytes_received.value_or(counters.bytes_received);
  };
  if (totals_) add(totals_());
  for (const std::unique_ptr<Bot>& bot : bots_) {
    if (!totals_) add(rti::with_datagrams(transport_.counters(bot->connection)));
    sum.updates_received += bot->client.replicas().counters().updates;
  }
  return sum;
}

}  // namespace rink::loadgen
