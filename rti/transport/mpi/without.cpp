// Ranks of a build that was configured without MPI: an error that names what to install.
#include "rti/transport/mpi/ranks.h"
#include "rti/transport/transport.h"

#include <cstdlib>

namespace rink::rti {

struct Ranks::Requests {};

bool Ranks::is_built_in() { return false; }

Ranks::Ranks() {
  throw TransportError(TransportError::Kind::failed,
                       "this build has no MPI: install libopenmpi-dev and openmpi-bin (./rink "
                       "setup does), then configure and build again");
}
Ranks::~Ranks() = default;
void Ranks::send(std::uint32_t, RankMessage) {}
std::optional<RankMessage> Ranks::receive(std::uint32_t) { return std::nullopt; }
void Ranks::put_back(std::uint32_t, RankMessage) {}
void Ranks::begin_gathering(std::span<const std::uint8_t>) {}
std::optional<std::span<const std::uint8_t>> Ranks::gathered() { return std::nullopt; }
bool Ranks::is_gathering() const { return false; }
std::size_t Ranks::unsent() { return 0; }
void Ranks::finish() {}
void Ranks::abort(int status) { std::_Exit(status); }

}  // namespace rink::rti
