// Membership and services of a federate.
#include "rti/standard/federate/federate.h"

#include <sys/eventfd.h>

#include <chrono>
#include <random>
#include <stdexcept>

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

Federate::Federate(rti1516e::FederateAmbassador& user, rti1516e::CallbackModel model,
                   Settings settings)
    : settings_(std::move(settings)),
      is_immediate_(model == rti1516e::HLA_IMMEDIATE),
      state_(user),
      alarm_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!alarm_) throw rti1516e::ConnectionFailed(L"no file is left for the connection");
  carrier_ = std::thread([this] { carry(); });
  if (is_immediate_) deliverer_ = std::thread([this] { deliver(); });
  try {
    Lock lock(mutex_);
    ensure_connection(lock);
  } catch (...) {
    close_connection();
    throw;
  }
}

Federate::~Federate() { close_connection(); }

/// For good.
void Federate::close_connection() {
  {
    const Lock lock(mutex_);
    is_ending_ = true;
    is_woken_ = false;
    wake();
  }
  changed_.notify_all();
  if (carrier_.joinable()) carrier_.join();
  if (deliverer_.joinable()) deliverer_.join();
}

void Federate::check_connected() const {
  if (state_.lost_because)
    throw rti1516e::NotConnected(L"the connection was lost: " + to_wide(*state_.lost_because));
}

void Federate::check_joined() const {
  check_connected();
  if (!is_joined_) throw rti1516e::FederateNotExecutionMember(L"join a federation execution first");
}

void Federate::connect(std::shared_ptr<const rti::Fom> model, Lock& lock) {
  const std::string place = settings_.host + ":" + std::to_string(settings_.port);
  try {
    connection_ = std::make_unique<Connection>(std::move(model), receiver_, settings_);
  } catch (const std::runtime_error& error) {
    throw rti1516e::ConnectionFailed(to_wide(error.what()));
  }
  state_.core = &connection_->core();
  state_.answers = {};
  wake();
  changed_.wait(lock, [&] {
    return state_.lost_because || connection_->is_open() || connection_->is_finished();
  });
  if (connection_ && connection_->is_open()) return;
  const std::string why = connection_ ? connection_->end() : *state_.lost_because;
  connection_.reset();
  throw rti1516e::ConnectionFailed(to_wide("no RTI at " + place + ": " + why));
}

void Federate::ensure_connection(Lock& lock) {
  check_connected();
  // Who has asked nothing yet is not told that the connection has ended.
  if (!connection_ || connection_->is_finished()) connect(no_model(), lock);
}

void Federate::create(const std::string& federation, const std::vector<std::string>& modules,
                      const std::wstring& time) {
  const Times times(time);
  if (is_joined()) {
    rti1516e::NullFederateAmbassador nobody;
    return Federate(nobody, rti1516e::HLA_EVOKED, settings_).create(federation, modules, time);
  }
  std::shared_ptr<const rti::Fom> model =
      load_model(settings_.fom.empty() ? modules : settings_.fom);
  Lock lock(mutex_);
  check_connected();
  state_.times = times;
  modules_ = modules;
  model_ = model;
  ensure_connection(lock);
  state_.answers.created.reset();
  translated([&] { connection_->core().create_federation_execution(federation, *model); });
  await(lock, [&] { return state_.answers.created.has_value(); });
  if (*state_.answers.created != rti::HlaError::none)
    throw_standard(*state_.answers.created, "federation execution '" + federation + "'");
}

void Federate::destroy(const std::string& federation) {
  if (is_joined()) {
    rti1516e::NullFederateAmbassador nobody;
    return Federate(nobody, rti1516e::HLA_EVOKED, settings_).destroy(federation);
  }
  Lock lock(mutex_);
  ensure_connection(lock);
  state_.answers.destroyed.reset();
  translated([&] { connection_->core().destroy_federation_execution(federation); });
  await(lock, [&] { return state_.answers.destroyed.has_value(); });
  if (*state_.answers.destroyed != rti::HlaError::none)
    throw_standard(*state_.answers.destroyed, "federation execution '" + federation + "'");
}

void Federate::list() {
  if (is_joined()) return list_beside();
  Lock lock(mutex_);
  ensure_connection(lock);
  translated([&] { connection_->core().list_federation_executions(); });
  wake();
}

/// The host answers only who has not joined: a member asks by a connection of its own.
void Federate::list_beside() {
  struct Listing final : rti1516e::NullFederateAmbassador {
    void reportFederationExecutions(
        rti1516e::FederationExecutionInformationVector const& list) override {
      found = list;
      has_found = true;
    }
    rti1516e::FederationExecutionInformationVector found;
    bool has_found = false;
  } listing;
  Federate asking(listing, rti1516e::HLA_EVOKED, settings_);
  asking.list();
  for (int tries = 0; !listing.has_found && tries < 50; ++tries) asking.evoke_one(0.1);
  if (!listing.has_found) throw rti1516e::RTIinternalError(L"the host does not answer");
  {
    const Lock lock(mutex_);
    state_.deliveries.put([found = listing.found](rti1516e::FederateAmbassador& user) {
      user.reportFederationExecutions(found);
    });
  }
  changed_.notify_all();
}

rti::FederateHandle Federate::join(std::string name, const std::string& type,
                                   const std::string& federation,
                                   const std::vector<std::string>& additional) {
  Lock lock(mutex_);
  check_connected();
  if (is_joined_)
    throw rti1516e::FederateAlreadyExecutionMember(L"resign before joining another execution");
  std::shared_ptr<const rti::Fom> model = model_;
  if (!model || (settings_.fom.empty() && !additional.empty())) {
    std::vector<std::string> modules = modules_;
    modules.insert(modules.end(), additional.begin(), additional.end());
    model = load_model(settings_.fom.empty() ? modules : settings_.fom);
  }
  if (modules_.empty() && !settings_.time.empty()) state_.times = Times(to_wide(settings_.time));
  if (name.empty()) name = made_up_name(type);
  try {
    connect(std::move(model), lock);
  } catch (const rti1516e::ConnectionFailed& failure) {
    throw rti1516e::NotConnected(failure.what());
  }
  translated([&] { connection_->core().join(federation, name, type); });
  try {
    await(lock, [&] { return state_.answers.is_joined || state_.answers.join_refused; });
    if (state_.answers.join_refused) {
      const auto [error, why] = *state_.answers.join_refused;
      throw_standard(error, why);
    }
  } catch (...) {
    connection_.reset();
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
  translated([&] { connection_->core().resign(action); });
  is_joined_ = false;
  wake();
  // The RTI closes the connection once the federate has left, so that it may destroy the execution.
  changed_.wait_for(lock, std::chrono::seconds(2),
                    [&] { return !connection_ || connection_->is_finished(); });
  connection_.reset();
  state_.core = nullptr;
  state_.deliveries.clear();
  state_.declarations = {};
  state_.objects.clear();
  state_.reserved_names.clear();
  state_.time = {};
}

bool Federate::is_joined() {
  const Lock lock(mutex_);
  return is_joined_ && !state_.lost_because;
}

void Federate::send_later(Lock& lock) {
  if (connection_->core().outgoing().size() >= send_from) connection_->flush();
  wake();
  if (connection_->unsent_bytes() >= wait_from)
    changed_.wait(lock, [&] {
      return !connection_ || connection_->unsent_bytes() < wait_from || state_.lost_because;
    });
}

}  // namespace rink::standard
