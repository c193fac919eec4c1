// A DDS domain of this process on the loopback interface alone, with a participant in it and the
// topics of the game.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace rink::loadgen {

/// A handle of Cyclone DDS; what belongs to an entity is deleted with it.
using DdsEntity = std::int32_t;

/// What the library or the machine refused; what() says so in a user's words.
class DdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
/// Somebody serves that domain on this machine already.
class DomainInUse : public DdsError {
 public:
  using DdsError::DdsError;
};

/// The loopback interface is taken by its name: nothing leaves the machine, nothing is multicast.
/// The server has the ports of the domain's first participant, by which bots find it; bots have
/// any, do not look for each other, and each has a domain instance and so sockets of its own, as
/// separate players would: within one instance a sample for several would travel once.
class Domain {
 public:
  static constexpr std::uint32_t number_max = 99;  ///< whose ports are below those for everybody

  /// The server's. Throws DomainInUse, and DdsError.
  static Domain of_server(std::uint32_t number) { return Domain(number, true, 0); }
  /// The server's of a free number, which are tried in turn from one of this process on.
  static Domain of_server();
  /// That of bot `instance`, counted within the process.
  static Domain of_bot(std::uint32_t number, std::uint32_t instance) {
    return Domain(number, false, instance);
  }
  Domain(Domain&& other) noexcept;
  Domain& operator=(Domain&&) = delete;
  ~Domain();

  std::uint32_t number() const { return number_; }
  DdsEntity participant() const { return participant_; }
  DdsEntity states() const { return states_; }
  DdsEntity sessions() const { return sessions_; }
  DdsEntity inputs() const { return inputs_; }

 private:
  Domain(std::uint32_t number, bool is_server, std::uint32_t instance);

  std::uint32_t number_;
  DdsEntity domain_ = 0, participant_ = 0, states_ = 0, sessions_ = 0, inputs_ = 0;
};

/// `result` of a call of the library. Throws DdsError, naming `what`, if it is an error.
DdsEntity require(DdsEntity result, const std::string& what);

/// A writer or reader of `topic` in `partition` (empty: the default one), with a publisher or
/// subscriber of its own, which the answer names with it: to delete one of both.
struct Endpoint {
  DdsEntity group = 0, own = 0;
};
enum class Delivery {
  best_effort,  ///< as fast as may be, for nobody who comes late
  kept,         ///< reliable, the newest is kept for whoever comes late
  all           ///< reliable, each in its order
};
Endpoint make_writer(const Domain& domain, DdsEntity topic, const std::string& partition,
                     Delivery delivery);
/// `player` is told to writers with the reader (`player_of` the matched reader).
Endpoint make_reader(const Domain& domain, DdsEntity topic, const std::string& partition,
                     Delivery delivery, std::uint32_t player);

}  // namespace rink::loadgen
