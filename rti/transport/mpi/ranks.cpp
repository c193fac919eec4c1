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

constexpr int mail_tag = 1;

}  // namespace

struct Ranks::Requests {
  struct Outgoing {
    std::vector<std::uint8_t> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  struct Incoming {
    std::vector<std::uint8_t> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
    bool is_coming = false;
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
  MPI_Init(nullptr, nullptr);
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

void Ranks::send(std::uint32_t to, std::vector<std::uint8_t> bytes) {
  assert(to < count_ && to != number_ && bytes.size() <= INT_MAX);
  unsent();
  Requests::Outgoing& outgoing = requests_->outgoing.emplace_back();
  outgoing.bytes = std::move(bytes);
  MPI_Isend(outgoing.bytes.data(), static_cast<int>(outgoing.bytes.size()), MPI_BYTE,
            static_cast<int>(to), mail_tag, MPI_COMM_WORLD, &outgoing.request);
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
std::optional<std::vector<std::uint8_t>> Ranks::receive(std::uint32_t from) {
  assert(from < count_ && from != number_);
  unsent();
  Requests::Incoming& incoming = requests_->incoming[from];
  if (!incoming.is_coming) {
    int is_there = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(static_cast<int>(from), mail_tag, MPI_COMM_WORLD, &is_there, &message, &status);
    if (!is_there) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    incoming.bytes.resize(static_cast<std::size_t>(size));
    MPI_Imrecv(incoming.bytes.data(), size, MPI_BYTE, &message, &incoming.request);
    incoming.is_coming = true;
  }
  int is_whole = 0;
  MPI_Test(&incoming.request, &is_whole, MPI_STATUS_IGNORE);
  if (!is_whole) return std::nullopt;
  incoming.is_coming = false;
  return std::exchange(incoming.bytes, {});
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
