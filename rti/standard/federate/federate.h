// A federate of the standard's API: its core, the threads that carry bytes and callbacks, and the
// mutex between them.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rti/standard/errors.h"
#include "rti/standard/federate/connection.h"
#include "rti/standard/federate/federate_state.h"
#include "rti/standard/federate/receiver.h"
#include "rti/standard/settings.h"
#include "rti/transport/readiness.h"

namespace rink::standard {

/// Connected for life. One thread exchanges bytes with the RTI, in either callback model, so that a
/// federate that computes for long stays a member; in the immediate model another one delivers
/// callbacks. Services are called by any thread, also from within callbacks.
class Federate {
 public:
  /// Returns once the RTI is reached. Throws ConnectionFailed.
  Federate(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model, Settings settings);
  ~Federate();
  Federate(const Federate&) = delete;
  Federate& operator=(const Federate&) = delete;

  /// Calls `service(core, state)`, under the mutex. Throws NotConnected if the connection was lost,
  /// FederateNotExecutionMember, and what the core refuses by the standard's exceptions.
  template <class Service>
  decltype(auto) call(const Service& service);
  /// The same, then waits until `is_answered(answers)`.
  template <class Service, class Answered>
  void ask(const Service& service, const Answered& is_answered);

  /// Federation management, which needs no membership.
  void create(const std::string& federation, const std::vector<std::string>& modules,
              const std::wstring& time);
  void destroy(const std::string& federation);
  void list();
  /// The new federate's handle.
  rti::FederateHandle join(std::string name, const std::string& type, const std::string& federation,
                           const std::vector<std::string>& additional);
  void resign(rti::ResignAction action);
  bool is_joined();

  /// Callbacks. Throws CallNotAllowedFromWithinCallback.
  void check_outside_callback();
  /// Waits up to `least_s` for the first, delivers it, and returns whether more wait.
  bool evoke_one(double least_s);
  /// Delivers callbacks for `least_s`, and up to `most_s` while some wait.
  bool evoke_many(double least_s, double most_s);
  void enable_callbacks(bool is_enabled);

 private:
  using Lock = std::unique_lock<std::mutex>;
  template <class Answered>
  void await(Lock& lock, const Answered& is_answered);
  void check_connected() const;
  void check_joined() const;
  void connect(std::shared_ptr<const rti::Fom> model, Lock& lock);
  /// A connection before the join, for questions to the host.
  void ensure_connection(Lock& lock);
  void list_beside();
  void close_connection();
  /// Has the bytes of a service carried, and holds its caller up while too many wait.
  void send_later(Lock& lock);
  void wake();
  bool deliver_until(Lock& lock, double until);
  void carry();
  void deliver();

  const Settings settings_;
  const bool is_immediate_;
  std::mutex mutex_;
  std::condition_variable changed_;  ///< an answer, a callback, or the end of the connection
  FederateState state_;
  Receiver receiver_{state_, mutex_};
  std::unique_ptr<Connection> connection_;
  std::vector<std::string> modules_;       ///< of the execution that it has created last
  std::shared_ptr<const rti::Fom> model_;  ///< of these
  bool is_joined_ = false, is_ending_ = false, is_woken_ = false;
  rti::File alarm_;  ///< wakes the thread that carries
  std::thread carrier_, deliverer_;
};

template <class Answered>
void Federate::await(Lock& lock, const Answered& is_answered) {
  wake();
  changed_.wait(lock, [&] { return is_answered() || state_.lost_because.has_value(); });
  if (!is_answered()) check_connected();
}

template <class Service>
decltype(auto) Federate::call(const Service& service) {
  Lock lock(mutex_);
  check_joined();
  struct Sending {
    Federate& federate;
    Lock& lock;
    ~Sending() { federate.send_later(lock); }
  } sending{*this, lock};
  return translated([&]() -> decltype(auto) { return service(connection_->core(), state_); });
}

template <class Service, class Answered>
void Federate::ask(const Service& service, const Answered& is_answered) {
  Lock lock(mutex_);
  check_joined();
  translated([&] { service(connection_->core(), state_); });
  await(lock, [&] { return is_answered(state_.answers); });
}

}  // namespace rink::standard
