// A federation under time management whose bytes take as long as the test wants, and whose
// federates write down what reaches them when.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/rti/rig.h"

#include "rti/time/federate_clock.h"

namespace rink::rti::testing {

/// The name of the error that `service` throws, "" if it throws none.
template <class Service>
std::string error_of(Service service) {
  try {
    service();
  } catch (const RtiException& exception) {
    return to_string(exception.error());
  }
  return "";
}

/// One federate. Everything that it heard, in order, with the state of its clock at that moment.
struct TimedFederate : FederateAmbassador {
  struct Heard {
    enum class What : std::uint8_t {
      message,
      receive_order,
      grant,
      regulation,
      constrained,
      retraction,
      removal
    } what;
    double time = 0.0;  ///< of the message, or the time granted
    RetractionHandle handle;
    std::string text;
    double clock = 0.0;  ///< its logical time just before
    bool is_advancing = false;
    bool is_in_order = false;
  };
  Ambassador ambassador{harbour(), *this};
  ConnectionId connection = 0;
  std::vector<Heard> heard;
  std::vector<std::byte> up, down;  ///< bytes on their way
  std::string lost;
  bool is_gone = false;
  double galt = -1.0, lits = -1.0;
  std::function<void(const Heard&)> on_heard;

  void note(Heard::What what, double time, const RetractionHandle& handle = {},
            std::string text = {}, bool is_in_order = false) {
    heard.push_back({what, time, handle, std::move(text), ambassador.clock().time(),
                     ambassador.clock().is_advancing(), is_in_order});
    if (on_heard) on_heard(heard.back());
  }
  void connection_lost(std::string_view why) override { lost = why; }
  void receive_interaction(InteractionClassHandle, Bytes parameters, FederateHandle,
                           const Stamp& stamp) override {
    note(Heard::What::receive_order, stamp.time, {}, text_of(parameters));
  }
  void receive_interaction_with_time(InteractionClassHandle, Bytes parameters, FederateHandle,
                                     const TimedStamp& timed) override {
    note(Heard::What::message, timed.stamp.time, timed.handle, text_of(parameters),
         timed.is_in_order);
  }
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values,
                                const Stamp& stamp) override {
    note(Heard::What::receive_order, stamp.time, {}, text_of(values));
  }
  void reflect_attribute_values_with_time(ObjectHandle, AttributeSet, Bytes values,
                                          const TimedStamp& timed) override {
    note(Heard::What::message, timed.stamp.time, timed.handle, text_of(values), timed.is_in_order);
  }
  void remove_object_instance(ObjectHandle) override { note(Heard::What::removal, -1.0); }
  void remove_object_instance_with_time(ObjectHandle, const TimedStamp& timed) override {
    note(Heard::What::removal, timed.stamp.time, timed.handle, {}, timed.is_in_order);
  }
  void time_advance_grant(LogicalTime time) override { note(Heard::What::grant, time.value); }
  void time_regulation_enabled(LogicalTime time) override {
    note(Heard::What::regulation, time.value);
  }
  void time_constrained_enabled(LogicalTime time) override {
    note(Heard::What::constrained, time.value);
  }
  void request_retraction(const RetractionHandle& handle) override {
    note(Heard::What::retraction, handle.time, handle);
  }
  void time_bounds(double new_galt, double new_lits) override { galt = new_galt, lits = new_lits; }

  const FederateClock& clock() const { return ambassador.clock(); }
  std::vector<double> grants() const { return times(Heard::What::grant); }
  std::vector<double> times(Heard::What what) const {
    std::vector<double> times;
    for (const Heard& each : heard)
      if (each.what == what) times.push_back(each.time);
    return times;
  }
};

/// What is discovered in one flush ends at so many bytes and one object.
inline FederationSettings with_entry_room(std::size_t bytes) {
  FederationSettings settings;
  settings.entry_bytes_per_flush_max = bytes;
  return settings;
}

/// No transport: bytes lie between federate and RTI until the test carries them.
class TimedFederation : public Outlet {
 public:
  explicit TimedFederation(const FederationServices& services = {},
                           const FederationSettings& settings = {})
      : execution_(harbour(), settings, services) {}

  /// Joined, and sends and hears hails in time-stamp order.
  TimedFederate& join() {
    TimedFederate& federate = *federates_.emplace_back(std::make_unique<TimedFederate>());
    federate.connection = next_connection_++;
    execution_.connect(federate.connection);
    federate.ambassador.join("rink", "federate " + std::to_string(federate.connection), "tester");
    carry();
    federate.ambassador.publish_interaction_class(hail);
    federate.ambassador.subscribe_interaction_class(hail);
    federate.ambassador.change_interaction_order_type(hail, Order::timestamp);
    carry();
    return federate;
  }
  /// The same, regulating with that lookahead (unless it is negative) and constrained.
  TimedFederate& join_timed(double lookahead, bool is_constrained = true) {
    TimedFederate& federate = join();
    if (lookahead >= 0.0) federate.ambassador.enable_time_regulation(lookahead);
    if (is_constrained) federate.ambassador.enable_time_constrained();
    carry();
    return federate;
  }
  static RetractionHandle say(TimedFederate& from, double time, const std::string& words = "") {
    return from.ambassador.send_interaction(hail, bytes_of(words), LogicalTime(time));
  }
  /// The process dies: what it had not sent is lost.
  void kill(TimedFederate& federate) {
    federate.is_gone = true;
    execution_.disconnect(federate.connection, "killed");
  }
  void resign(TimedFederate& federate) {
    federate.ambassador.resign();
    carry_up(federate);
    federate.is_gone = true;
  }
  void carry_up(TimedFederate& federate) {
    if (federate.is_gone) return;
    const Bytes bytes = federate.ambassador.outgoing();
    federate.up.insert(federate.up.end(), bytes.begin(), bytes.end());
    federate.ambassador.clear_outgoing();
    const std::vector<std::byte> up = std::exchange(federate.up, {});
    execution_.receive(federate.connection, up);
  }
  void tick() {
    execution_.match();
    execution_.flush(*this);
  }
  void carry_down(TimedFederate& federate) {
    const std::vector<std::byte> down = std::exchange(federate.down, {});
    if (!federate.is_gone) federate.ambassador.receive(down);
  }
  /// Until nothing is on its way any more.
  void carry() {
    for (bool is_busy = true; is_busy;) {
      for (const auto& federate : federates_) carry_up(*federate);
      tick();
      is_busy = false;
      for (const auto& federate : federates_) {
        is_busy |= !federate->down.empty();
        carry_down(*federate);
        is_busy |= !federate->is_gone && !federate->ambassador.outgoing().empty();
      }
    }
  }
  FederationExecution& execution() { return execution_; }
  const std::vector<std::unique_ptr<TimedFederate>>& federates() const { return federates_; }
  std::uint64_t drops(Violation violation) const {
    return execution_.counters().drops[static_cast<std::size_t>(violation)];
  }

  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts)
      federates_[connection]->down.insert(federates_[connection]->down.end(), part.begin(),
                                          part.end());
  }
  void drop(ConnectionId connection, std::string_view) override {
    if (!federates_[connection]->is_gone)
      federates_[connection]->ambassador.disconnected("dropped");
    federates_[connection]->is_gone = true;
  }

 private:
  FederationExecution execution_;
  std::vector<std::unique_ptr<TimedFederate>> federates_;  ///< by connection
  ConnectionId next_connection_ = 0;
};

}  // namespace rink::rti::testing
