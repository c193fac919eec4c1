// Implements ranks by MPI. Operations are begun and tested, never waited for, so that a silent rank
// can be noticed.
#include "rti/transport/mpi/ranks.h"

#include <mpi.h>

#include <cassert>
#include <climits>
#include <cstdlib>
#include <deque>
#include <utility>

#include "rti/transport/transport.h"

namespace rink::rti {

namespace {

/// MPI keeps messages of different tags in order too where any tag is received.
constexpr int first_tag = 1;

}  // namespace

struct Ranks::Requests {
  struct Outgoing {
    std::vector<std::uint8_t> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  struct Incoming {
    RankMessage message;
    MPI_Request request = MPI_REQUEST_NULL;
    bool is_coming = false;
    std::optional<RankMessage> put_back;
  };
  std::deque<Outgoing> outgoing;   ///< a deque, for MPI keeps the addresses
  std::vector<Incoming> incoming;  ///< by rank
  std::vector<std::uint8_t> sent, received;
  MPI_Request gathering = MPI_REQUEST_NULL;
  bool is_finished = false;
};

bool Ranks::is_built_in() { return true; }

Ranks::Ranks() : requests_(std::make_unique<Requests>()) {
  int is_initialised = 0;
  MPI_Initialized(&is_initialised);
  if (is_initialised)
    throw TransportError(TransportError::Kind::failed,
                         "MPI has been begun in this process already, and it cannot begin again");
  int threads = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  if (threads < MPI_THREAD_SERIALIZED)
    throw TransportError(TransportError::Kind::failed,
                         "this MPI serves one thread of a process alone: expected one that lets "
                         "several take turns (MPI_THREAD_SERIALIZED), as Open MPI does");
  int number = 0, count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &number);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  number_ = static_cast<std::uint32_t>(number);
  count_ = static_cast<std::uint32_t>(count);
  requests_->incoming.resize(count_);
}

Ranks::~Ranks() {
  if (!requests_->is_finished) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
}

void Ranks::send(std::uint32_t to, RankMessage message) {
  assert(to < count_ && to != number_ && message.bytes.size() <= INT_MAX);
  unsent();
  Requests::Outgoing& outgoing = requests_->outgoing.emplace_back();
  outgoing.bytes = std::move(message.bytes);
  MPI_Isend(outgoing.bytes.data(), static_cast<int>(outgoing.bytes.size()), MPI_BYTE,
            static_cast<int>(to), first_tag + message.channel, MPI_COMM_WORLD, &outgoing.request);
}

/// From the oldest to the first that is still on its way: those behind it are seen later.
std::size_t Ranks::unsent() {
  auto& outgoing = requests_->outgoing;
  for (int is_sent = 1; !outgoing.empty();) {
    MPI_Test(&outgoing.front().request, &is_sent, MPI_STATUS_IGNORE);
    if (!is_sent) break;
    outgoing.pop_front();
  }
  return outgoing.size();
}

/// A message is matched first, so that its length is known, then taken without waiting for the rest
/// of it.
std::optional<RankMessage> Ranks::receive(std::uint32_t from) {
  assert(from < count_ && from != number_);
  unsent();
  Requests::Incoming& incoming = requests_->incoming[from];
  if (incoming.put_back) return std::exchange(incoming.put_back, std::nullopt);
  if (!incoming.is_coming) {
    int is_there = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(static_cast<int>(from), MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &message, &status);
    if (!is_there) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    incoming.message.channel = static_cast<std::uint8_t>(status.MPI_TAG - first_tag);
    incoming.message.bytes.resize(static_cast<std::size_t>(size));
    MPI_Imrecv(incoming.message.bytes.data(), size, MPI_BYTE, &message, &incoming.request);
    incoming.is_coming = true;
  }
  int is_whole = 0;
  MPI_Test(&incoming.request, &is_whole, MPI_STATUS_IGNORE);
  if (!is_whole) return std::nullopt;
  incoming.is_coming = false;
  return std::exchange(incoming.message, {});
}

void Ranks::put_back(std::uint32_t from, RankMessage message) {
  assert(from < count_ && !requests_->incoming[from].put_back);
  requests_->incoming[from].put_back = std::move(message);
}

void Ranks::begin_gathering(std::span<const std::uint8_t> own) {
  assert(requests_->gathering == MPI_REQUEST_NULL && own.size() * count_ <= INT_MAX);
  requests_->sent.assign(own.begin(), own.end());
  requests_->received.resize(own.size() * count_);
  const int size = static_cast<int>(own.size());
  MPI_Iallgather(requests_->sent.data(), size, MPI_BYTE, requests_->received.data(), size, MPI_BYTE,
                 MPI_COMM_WORLD, &requests_->gathering);
}

std::optional<std::span<const std::uint8_t>> Ranks::gathered() {
  unsent();
  int is_done = 0;
  MPI_Test(&requests_->gathering, &is_done, MPI_STATUS_IGNORE);
  if (!is_done) return std::nullopt;
  return requests_->received;
}

bool Ranks::is_gathering() const { return requests_->gathering != MPI_REQUEST_NULL; }

void Ranks::finish() {
  assert(requests_->outgoing.empty() && requests_->gathering == MPI_REQUEST_NULL);
  requests_->is_finished = true;
  MPI_Finalize();
}

void Ranks::abort(int status) {
  requests_->is_finished = true;
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

}  // namespace rink::rti
