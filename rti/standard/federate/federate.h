// A federate of the standard's API: its core, the threads that carry bytes and callbacks, and the
// mutex between them.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "rti/standard/errors.h"
#include "rti/standard/federate/connection.h"
#include "rti/standard/federate/federate_state.h"
#include "rti/standard/federate/receiver.h"
#include "rti/standard/settings.h"
#include "rti/transport/readiness.h"

namespace rink::standard {

/// While it is connected, one thread exchanges bytes with the RTI, in either callback model, so
/// that a federate that computes for long stays a member; in the immediate model another one
/// delivers callbacks. Services are called by any thread, also from within callbacks. Held by
/// shared pointers: who destroys the ambassador within a callback leaves the thread that calls back
/// its federate.
class Federate : public std::enable_shared_from_this<Federate> {
 public:
  Federate();
  Federate(const Federate&) = delete;
  Federate& operator=(const Federate&) = delete;

  /// Returns once the RTI is reached; also after the connection was lost. Throws AlreadyConnected,
  /// UnsupportedCallbackModel, InvalidLocalSettingsDesignator and ConnectionFailed.
  void connect(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
               const std::wstring& designator);
  /// Throws FederateIsExecutionMember. A callback that runs has returned when this does.
  void disconnect();
  /// For good, from any thread and in any state.
  void close();

  /// Calls `service(core, state)`, under the mutex. Throws NotConnected,
  /// FederateNotExecutionMember, and what the core refuses by the standard's exceptions.
  template <class Service>
  auto call(const Service& service);
  /// The same for what others wait for: it is sent before this returns.
  template <class Service>
  void call_at_once(const Service& service);
  /// The same, then waits until `is_answered(answers)`. One thread asks at a time, so that each
  /// gets its own answer.
  template <class Service, class Answered>
  void ask(const Service& service, const Answered& is_answered);

  /// Federation management, which needs no membership and is done by one thread at a time.
  void create(const std::string& federation, const std::vector<std::string>& modules,
              const std::wstring& time);
  void destroy(const std::string& federation);
  void list();
  /// The new federate's handle.
  rti::FederateHandle join(std::string name, const std::string& type, const std::string& federation,
                           const std::vector<std::string>& additional);
  void resign(rti::ResignAction action);

  /// Callbacks. Throws CallNotAllowedFromWithinCallback.
  void check_outside_callback();
  /// Waits up to `least_s` for the first, delivers it, and returns whether more wait.
  bool evoke_one(double least_s);
  /// Delivers callbacks for `least_s`, and up to `most_s` while some wait.
  bool evoke_many(double least_s, double most_s);
  void enable_callbacks(bool is_enabled);

 private:
  /// A write and the receiver's waking cost more than ten updates: what follows the last write so
  /// closely is the stream of a federate that computes, and goes by parts; answers come later.
  static constexpr std::chrono::microseconds stream_gap{20}, send_gap{100};
  using Lock = std::unique_lock<std::mutex>;
  /// Holds a flag that one thread has at a time; the others wait for it.
  class Turn;
  class Beside;
  /// Takes the settings of another federate.
  void connect(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
               Settings settings);
  void begin(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model, Settings settings,
             Lock& lock);
  void check_connected() const;
  void check_joined() const;
  template <class Answered>
  void await(Lock& lock, const Answered& is_answered);
  void start_threads();
  void end_threads(Lock& lock);
  void reach(std::shared_ptr<const rti::Fom> model, Lock& lock);
  void drop_connection();
  /// A connection before the join, for questions to the host.
  void ensure_connection(Lock& lock);
  void list_beside(Lock& lock);
  /// Has the bytes of a service carried: at once, or with those of the next instant, if some were
  /// sent just before.
  void send_soon(Lock& lock);
  /// Sends, and holds its caller up while too many bytes wait.
  void send_now(Lock& lock);
  void wake();
  template <class Enough>
  bool deliver_until(Lock& lock, double until, const Enough& is_enough);
  void carry();
  void exchange();
  void lose(const std::string& why);
  void deliver();

  Settings settings_;
  bool is_immediate_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;  ///< an answer, a callback, a turn, or the end of anything
  FederateState state_;
  Receiver receiver_{state_, mutex_};
  std::unique_ptr<Connection> connection_;
  std::uint64_t connection_count_ = 0;     ///< made and dropped ones: who waits knows its own
  std::vector<std::string> modules_;       ///< of the execution that it has created last
  std::shared_ptr<const rti::Fom> model_;  ///< of these
  bool is_connected_ = false, is_joined_ = false, is_ending_ = false, is_woken_ = false;
  struct {
    std::chrono::steady_clock::time_point at{};  ///< of the last
    bool is_due = false;                         ///< the thread that carries sends soon
  } sending_;
  bool is_managing_ = false, is_asking_ = false;  ///< a thread has the turn
  rti::File alarm_;                               ///< wakes the thread that carries
  std::thread carrier_, deliverer_;
};

class Federate::Turn {
 public:
  /// Waits for `flag`, whose mutex `lock` holds. Throws NotConnected if the connection ends.
  Turn(Federate& federate, bool& flag, Lock& lock);
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Federate& federate_;
  bool& flag_;
  Lock& lock_;
};

template <class Answered>
void Federate::await(Lock& lock, const Answered& is_answered) {
  const std::uint64_t mine = connection_count_;
  const auto is_over = [&] {
    return is_ending_ || connection_count_ != mine || state_.lost_because.has_value();
  };
  translated([&] { connection_->flush(); });
  changed_.wait(lock, [&] { return is_over() || is_answered(); });
  // An answer that came with the end counts; those of another connection are not this thread's.
  if (connection_count_ == mine && is_answered()) return;
  check_connected();
  throw rti1516e::FederateNotExecutionMember(L"the federate has resigned meanwhile");
}

template <class Service>
auto Federate::call(const Service& service) {
  Lock lock(mutex_);
  check_joined();
  const auto serve = [&] { return service(connection_->core(), state_); };
  if constexpr (std::is_void_v<decltype(serve())>) {
    translated([&] {
      serve();
      send_soon(lock);
    });
  } else {
    return translated([&] {
      auto result = serve();
      send_soon(lock);
      return result;
    });
  }
}

template <class Service>
void Federate::call_at_once(const Service& service) {
  Lock lock(mutex_);
  check_joined();
  translated([&] {
    service(connection_->core(), state_);
    send_now(lock);
  });
}

template <class Service, class Answered>
void Federate::ask(const Service& service, const Answered& is_answered) {
  Lock lock(mutex_);
  check_joined();
  const Turn turn(*this, is_asking_, lock);
  check_joined();
  translated([&] { service(connection_->core(), state_); });
  await(lock, [&] { return is_answered(state_.answers); });
}

}  // namespace rink::standard
