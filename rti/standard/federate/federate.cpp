// Connection, membership and services of a federate.
#include "rti/standard/federate/federate.h"

#include <sys/eventfd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>
#include <utility>

#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

/// Unsent bytes from which a service sends itself, and from which it waits: half a socket's buffer,
/// and a few of them.
constexpr std::size_t send_from = 64u << 10, wait_from = 1u << 20;

/// Before the join only the host is asked, which takes no notice of the model.
std::shared_ptr<const rti::Fom> no_model() {
  static const auto model = std::make_shared<const rti::Fom>(rti::Fom::parse(
      "<objectModel><modelIdentification><name>none</name></modelIdentification></objectModel>",
      "no model"));
  return model;
}

/// A name that no other federate has chosen.
std::string made_up_name(const std::string& type) {
  std::random_device random;
  return type + "-" + std::to_string(random());
}

}  // namespace

Federate::Federate() : alarm_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

Federate::Turn::Turn(Federate& federate, bool& flag, Lock& lock)
    : federate_(federate), flag_(flag), lock_(lock) {
  federate.changed_.wait(lock, [&] { return !flag || federate.is_ending_; });
  federate.check_connected();
  flag = true;
}

Federate::Turn::~Turn() {
  if (!lock_.owns_lock()) lock_.lock();
  flag_ = false;
  federate_.changed_.notify_all();
}

void Federate::connect(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
                       const std::wstring& designator) {
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return !is_ending_; });
  if (is_connected_ && !state_.lost_because) throw rti1516e::AlreadyConnected(L"disconnect first");
  if (state_.deliveries.is_delivering_here())
    throw rti1516e::CallNotAllowedFromWithinCallback(L"call it once the callback has returned");
  if (model != rti1516e::HLA_IMMEDIATE && model != rti1516e::HLA_EVOKED)
    throw rti1516e::UnsupportedCallbackModel(L"it is neither HLA_IMMEDIATE nor HLA_EVOKED");
  begin(user, model, read_settings(designator), lock);
}

void Federate::connect(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
                       Settings settings) {
  Lock lock(mutex_);
  begin(user, model, std::move(settings), lock);
}

void Federate::begin(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
                     Settings settings, Lock& lock) {
  if (is_connected_) end_threads(lock);
  if (!alarm_) throw rti1516e::ConnectionFailed(L"no file is left for the connection");
  settings_ = std::move(settings);
  is_immediate_ = model == rti1516e::HLA_IMMEDIATE;
  state_.begin(user);
  modules_.clear();
  model_.reset();
  is_connected_ = true;
  try {
    const Turn turn(*this, is_managing_, lock);
    start_threads();
    ensure_connection(lock);
  } catch (const std::system_error& error) {
    end_threads(lock);
    throw rti1516e::ConnectionFailed(to_wide(error.what()));
  } catch (...) {
    end_threads(lock);
    throw;
  }
}

void Federate::disconnect() {
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return !is_ending_; });
  if (!is_connected_) return;
  if (state_.deliveries.is_delivering_here())
    throw rti1516e::CallNotAllowedFromWithinCallback(L"call it once the callback has returned");
  if (is_joined_ && !state_.lost_because)
    throw rti1516e::FederateIsExecutionMember(L"resign from the federation execution first");
  end_threads(lock);
}

void Federate::close() {
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return !is_ending_; });
  if (is_connected_) end_threads(lock);
}

void Federate::check_connected() const {
  if (state_.lost_because)
    throw rti1516e::NotConnected(L"the connection was lost: " + to_wide(*state_.lost_because));
  if (!is_connected_ || is_ending_) throw rti1516e::NotConnected(L"connect first");
}

void Federate::check_joined() const {
  check_connected();
  if (!is_joined_) throw rti1516e::FederateNotExecutionMember(L"join a federation execution first");
}

void Federate::drop_connection() {
  state_.core = nullptr;
  state_.model.reset();
  connection_.reset();
  ++connection_count_;
  changed_.notify_all();
}

/// Connects with the RTI for a core of `model`.
void Federate::reach(std::shared_ptr<const rti::Fom> model, Lock& lock) {
  const std::string place = settings_.host + ":" + std::to_string(settings_.port);
  drop_connection();
  try {
    connection_ = std::make_unique<Connection>(model, receiver_, settings_);
  } catch (const std::runtime_error& error) {
    throw rti1516e::ConnectionFailed(to_wide(error.what()));
  }
  state_.core = &connection_->core();
  state_.model = std::move(model);
  state_.answers = {};
  wake();
  changed_.wait(lock, [&] {
    return is_ending_ || !connection_ || connection_->is_open() || connection_->is_finished() ||
           state_.lost_because;
  });
  if (connection_ && connection_->is_open() && !is_ending_) return;
  std::string why = "the federate disconnects";
  if (!is_ending_) why = connection_ ? connection_->end() : state_.lost_because.value_or("");
  drop_connection();
  throw rti1516e::ConnectionFailed(to_wide("no RTI at " + place + ": " + why));
}

void Federate::ensure_connection(Lock& lock) {
  check_connected();
  // Who has asked nothing yet is not told that the connection has ended.
  if (!connection_ || connection_->is_finished()) reach(no_model(), lock);
}

/// The host answers only who has not joined: a member asks by a connection of its own, without the
/// mutex.
class Federate::Beside {
 public:
  Beside(rti1516e::FederateAmbassador& user, Settings settings, Lock& lock)
      : other_(std::make_shared<Federate>()) {
    lock.unlock();
    other_->connect(user, rti1516e::HLA_EVOKED, std::move(settings));
  }
  ~Beside() { other_->close(); }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  Federate* operator->() const { return other_.get(); }

 private:
  const std::shared_ptr<Federate> other_;
};

void Federate::create(const std::string& federation, const std::vector<std::string>& modules,
                      const std::wstring& time) {
  Lock lock(mutex_);
  check_connected();
  const Times times(time);
  const Turn turn(*this, is_managing_, lock);
  if (is_joined_) {
    rti1516e::NullFederateAmbassador nobody;
    return Beside(nobody, settings_, lock)->create(federation, modules, time);
  }
  std::shared_ptr<const rti::Fom> model =
      load_model(settings_.fom.empty() ? modules : settings_.fom);
  ensure_connection(lock);
  state_.times = times;
  modules_ = modules;
  model_ = model;
  state_.answers.created.reset();
  translated([&] { connection_->core().create_federation_execution(federation, *model); });
  await(lock, [&] { return state_.answers.created.has_value(); });
  if (*state_.answers.created != rti::HlaError::none)
    throw_standard(*state_.answers.created, "federation execution '" + federation + "'");
}

void Federate::destroy(const std::string& federation) {
  Lock lock(mutex_);
  check_connected();
  const Turn turn(*this, is_managing_, lock);
  if (is_joined_) {
    rti1516e::NullFederateAmbassador nobody;
    return Beside(nobody, settings_, lock)->destroy(federation);
  }
  ensure_connection(lock);
  state_.answers.destroyed.reset();
  translated([&] { connection_->core().destroy_federation_execution(federation); });
  await(lock, [&] { return state_.answers.destroyed.has_value(); });
  if (*state_.answers.destroyed != rti::HlaError::none)
    throw_standard(*state_.answers.destroyed, "federation execution '" + federation + "'");
}

void Federate::list() {
  Lock lock(mutex_);
  check_connected();
  const Turn turn(*this, is_managing_, lock);
  if (is_joined_) return list_beside(lock);
  ensure_connection(lock);
  translated([&] {
    connection_->core().list_federation_executions();
    connection_->flush();
  });
}

void Federate::list_beside(Lock& lock) {
  struct Listing final : rti1516e::NullFederateAmbassador {
    void reportFederationExecutions(
        rti1516e::FederationExecutionInformationVector const& list) override {
      found = list;
      has_found = true;
    }
    rti1516e::FederationExecutionInformationVector found;
    bool has_found = false;
  } listing;
  {
    const Beside asking(listing, settings_, lock);
    asking->list();
    for (int tries = 0; !listing.has_found && tries < 50; ++tries) asking->evoke_one(0.1);
  }
  if (!listing.has_found) throw rti1516e::RTIinternalError(L"the host does not answer");
  lock.lock();
  state_.deliveries.put([found = listing.found](rti1516e::FederateAmbassador& user) {
    user.reportFederationExecutions(found);
  });
  changed_.notify_all();
}

rti::FederateHandle Federate::join(std::string name, const std::string& type,
                                   const std::string& federation,
                                   const std::vector<std::string>& additional) {
  Lock lock(mutex_);
  check_connected();
  const Turn turn(*this, is_managing_, lock);
  if (is_joined_)
    throw rti1516e::FederateAlreadyExecutionMember(L"resign before joining another execution");
  std::shared_ptr<const rti::Fom> model = model_;
  std::vector<std::string> modules = modules_;
  for (const std::string& each : additional)
    if (std::find(modules.begin(), modules.end(), each) == modules.end()) modules.push_back(each);
  if (!model || (settings_.fom.empty() && modules != modules_))
    model = load_model(settings_.fom.empty() ? modules : settings_.fom);
  if (modules_.empty() && !settings_.time.empty()) state_.times = Times(to_wide(settings_.time));
  if (name.empty()) name = made_up_name(type);
  try {
    reach(std::move(model), lock);
  } catch (const rti1516e::ConnectionFailed& failure) {
    throw rti1516e::NotConnected(failure.what());
  }
  try {
    translated([&] { connection_->core().join(federation, name, type); });
    await(lock, [&] { return state_.answers.is_joined || state_.answers.join_refused; });
    if (state_.answers.join_refused) {
      const auto [error, why] = *state_.answers.join_refused;
      throw_standard(error, why);
    }
  } catch (...) {
    drop_connection();
    throw;
  }
  is_joined_ = true;
  // Names of federates are known from now on.
  connection_->core().watch_federates();
  await(lock, [&] { return state_.answers.is_self_known; });
  return connection_->core().federate();
}

void Federate::resign(rti::ResignAction action) {
  Lock lock(mutex_);
  check_joined();
  const Turn turn(*this, is_managing_, lock);
  check_joined();
  translated([&] {
    connection_->core().resign(action);
    connection_->flush();
  });
  is_joined_ = false;
  // The RTI closes the connection once the federate has left, so that it may destroy the execution.
  changed_.wait_for(lock, std::chrono::seconds(2),
                    [&] { return !connection_ || connection_->is_finished() || is_ending_; });
  drop_connection();
  state_.leave();
}

void Federate::send_soon(Lock& lock) {
  if (connection_->core().outgoing().size() >= send_from) return send_now(lock);
  if (sending_.is_due || connection_->core().outgoing().empty()) return;
  // Bytes by themselves go at once, without another thread; a stream of them goes by parts.
  if (std::chrono::steady_clock::now() >= sending_.at + stream_gap) return send_now(lock);
  sending_.is_due = true;
  wake();
}

void Federate::send_now(Lock& lock) {
  connection_->flush();
  sending_.at = std::chrono::steady_clock::now();
  if (connection_->unsent_bytes() < wait_from) return;
  wake();
  const std::uint64_t mine = connection_count_;
  changed_.wait(lock, [&] {
    return is_ending_ || connection_count_ != mine || connection_->unsent_bytes() < wait_from ||
           state_.lost_because;
  });
}

}  // namespace rink::standard
