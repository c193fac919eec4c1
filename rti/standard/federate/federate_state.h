// What a federate of the standard's API has beside its core; all of it is used under one mutex.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rti/ambassador.h"
#include "rti/standard/federate/declarations.h"
#include "rti/standard/federate/deliveries.h"
#include "rti/standard/times.h"
#include "rti/standard/values.h"
#include "rti/wire/state_stream.h"

namespace rink::standard {

/// An object that the federate has registered, or discovered.
struct KnownObject {
  rti::ObjectClassHandle object_class;  ///< as the federate knows it
  std::string name;
  rti::ObjectClassHandle registered;  ///< as its owner has registered it

  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, object_class, name, registered);
  }
};

/// An object that the federate deletes at the time of the handle.
struct TimedDeletion {
  rti::RetractionHandle handle;
  rti::ObjectHandle object;
  KnownObject known;

  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, handle.sender, handle.number, handle.time, object, known);
  }
};

/// Time as the federate has been told it: the core may be a few callbacks ahead.
struct ToldTime {
  double now = 0.0;
  bool is_advancing = false, is_regulation_pending = false, is_constrained_pending = false;

  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, now, is_advancing, is_regulation_pending, is_constrained_pending);
  }
};

/// Answers of the RTI that a service waits for.
struct Answers {
  struct Divestiture {
    rti::ObjectHandle object;
    rti::AttributeSet asked, divested, kept;
  };
  std::optional<rti::HlaError> created{}, destroyed{};
  bool is_joined = false, is_self_known = false;
  std::optional<std::pair<rti::HlaError, std::string>> join_refused{};
  std::optional<std::pair<double, double>> bounds{};  ///< GALT and LITS
  std::optional<Divestiture> divestiture{};
};

struct FederateState {
  /// As it is at a new connection.
  void begin(rti1516e::FederateAmbassador& user);
  /// Forgets an object that the federate has deleted, and what of it waits.
  void forget(rti::ObjectHandle object) {
    objects.erase(object);
    deliveries.drop(object);
  }
  /// The same for a deletion at `handle.time`, until `retract`.
  void forget(rti::ObjectHandle object, const rti::RetractionHandle& handle);
  void retract(const rti::RetractionHandle& handle);
  /// Forgets an execution.
  void leave();
  /// What belongs to a saved federation.
  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, declarations, objects, deletions, reserved_names, time,
                         resign_directive);
  }

  Deliveries deliveries{};
  Times times{};
  ToldTime time{};
  Declarations declarations{};
  std::unordered_map<rti::ObjectHandle, KnownObject> objects{};
  std::vector<TimedDeletion> deletions{};  ///< that may still be retracted
  std::set<std::string> reserved_names{};
  rti::ResignAction resign_directive = rti::ResignAction::cancel_then_delete_then_divest;
  Answers answers{};
  Update sent{};                              ///< the last update, whose memory the next one uses
  rti::Ambassador* core = nullptr;            ///< null while there is no connection
  std::shared_ptr<const rti::Fom> model{};    ///< the core's
  std::optional<std::string> lost_because{};  ///< the connection has ended by itself
};

}  // namespace rink::standard
