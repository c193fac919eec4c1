// An RTI of its own for federates of the standard's API, and federates that note what they are
// told.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "rti/federation_directory.h"
#include "rti/standard/standard_headers.h"
#include "rti/standard/wide_text.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/places.h"

namespace rink::standard::testing {

inline std::string model_file() { return test::source_folder() + "/tests/rti/standard/port.xml"; }

/// An RTI over TCP on a thread of its own, at a free port.
class Harbour {
 public:
  /// Federations can be saved where there is a store.
  explicit Harbour(const std::shared_ptr<rti::SaveStore>& store = {})
      : fom_(rti::Fom::load(model_file())), directory_(settings_of(store)), host_(directory_) {
    directory_.offer(fom_);
    port_ = tcp_.listen("127.0.0.1", 0);
    host_.add(tcp_);
    host_.advance_clock(now_s());
    thread_ = std::thread([this] { serve(); });
  }
  ~Harbour() { close(); }
  void close() {
    is_closing_ = true;
    if (thread_.joinable()) thread_.join();
  }
  std::wstring address() const { return L"127.0.0.1:" + std::to_wstring(port_); }
  /// While it sleeps, it answers nobody.
  void sleep(bool is_asleep) {
    is_to_sleep_ = is_asleep;
    while (is_asleep_ != is_asleep) std::this_thread::yield();
  }

 private:
  static rti::DirectorySettings settings_of(const std::shared_ptr<rti::SaveStore>& store) {
    rti::DirectorySettings settings;
    settings.services.save_store = store;
    return settings;
  }
  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  void serve() {
    while (!is_closing_) {
      is_asleep_ = is_to_sleep_.load();
      if (is_asleep_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      host_.poll(std::chrono::milliseconds(1));
      host_.advance_clock(now_s());
      host_.match();
      host_.flush();
    }
    host_.close_all("the harbour closes");
    host_.poll(std::chrono::milliseconds(1));
  }

  rti::Fom fom_;
  rti::FederationDirectory directory_;
  rti::TcpTransport tcp_;
  rti::FederationHost host_;
  std::uint16_t port_ = 0;
  std::atomic<bool> is_closing_ = false, is_to_sleep_ = false, is_asleep_ = false;
  std::thread thread_;
};

inline rti1516e::VariableLengthData data_of(const std::string& text) {
  return rti1516e::VariableLengthData(text.data(), text.size());
}
inline std::string text_of(const rti1516e::VariableLengthData& data) {
  return {static_cast<const char*>(data.data()), data.size()};
}

/// Notes what it is told, a line each.
class Log : public rti1516e::NullFederateAmbassador {
 public:
  bool has(const std::string& line) {
    const std::lock_guard lock(mutex_);
    return std::find(lines_.begin(), lines_.end(), line) != lines_.end();
  }
  std::size_t count(const std::string& line) {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(std::count(lines_.begin(), lines_.end(), line));
  }
  std::string all() {
    const std::lock_guard lock(mutex_);
    std::string text;
    for (const std::string& line : lines_) text += line + "\n";
    return text;
  }
  /// The last object that was discovered.
  rti1516e::ObjectInstanceHandle found() {
    const std::lock_guard lock(mutex_);
    return found_;
  }
  rti1516e::ObjectClassHandle found_class() {
    const std::lock_guard lock(mutex_);
    return found_class_;
  }
  /// Is called within each callback.
  std::function<void()> on_callback = [] {};

 protected:
  void note(const std::string& line) {
    {
      const std::lock_guard lock(mutex_);
      lines_.push_back(line);
    }
    on_callback();
  }
  void note(const std::string& what, const std::wstring& name) { note(what + " " + to_utf8(name)); }

  void connectionLost(std::wstring const& why) override { note("lost", why); }
  void reportFederationExecutions(
      rti1516e::FederationExecutionInformationVector const& list) override {
    for (const auto& each : list) note("execution", each.federationExecutionName);
    note("executions");
  }
  void synchronizationPointRegistrationSucceeded(std::wstring const& label) override {
    note("registered", label);
  }
  void synchronizationPointRegistrationFailed(
      std::wstring const& label, rti1516e::SynchronizationPointFailureReason reason) override {
    note("failed", label + L" " + std::to_wstring(reason));
  }
  void announceSynchronizationPoint(std::wstring const& label,
                                    rti1516e::VariableLengthData const& tag) override {
    note("announced", label + L" " + to_wide(text_of(tag)));
  }
  void federationSynchronized(std::wstring const& label,
                              rti1516e::FederateHandleSet const& failed) override {
    note("synchronized", label + L" " + std::to_wstring(failed.size()));
  }
  void startRegistrationForObjectClass(rti1516e::ObjectClassHandle) override { note("wanted"); }
  void turnInteractionsOn(rti1516e::InteractionClassHandle) override { note("listened to"); }
  void objectInstanceNameReservationSucceeded(std::wstring const& name) override {
    note("reserved", name);
  }
  void objectInstanceNameReservationFailed(std::wstring const& name) override {
    note("not reserved", name);
  }
  void multipleObjectInstanceNameReservationSucceeded(
      std::set<std::wstring> const& names) override {
    note("reserved " + std::to_string(names.size()));
  }
  void discoverObjectInstance(rti1516e::ObjectInstanceHandle object,
                              rti1516e::ObjectClassHandle object_class,
                              std::wstring const& name) override {
    {
      const std::lock_guard lock(mutex_);
      found_ = object;
      found_class_ = object_class;
    }
    note("discovered", name);
  }
  static std::string values(rti1516e::AttributeHandleValueMap const& map) {
    std::string text;
    for (const auto& [handle, value] : map) text += " " + text_of(value);
    return text;
  }
  void reflectAttributeValues(rti1516e::ObjectInstanceHandle,
                              rti1516e::AttributeHandleValueMap const& map,
                              rti1516e::VariableLengthData const& tag, rti1516e::OrderType,
                              rti1516e::TransportationType,
                              rti1516e::SupplementalReflectInfo) override {
    note("reflected" + values(map) + " tag " + text_of(tag));
  }
  void reflectAttributeValues(rti1516e::ObjectInstanceHandle,
                              rti1516e::AttributeHandleValueMap const& map,
                              rti1516e::VariableLengthData const& tag, rti1516e::OrderType,
                              rti1516e::TransportationType, rti1516e::LogicalTime const& time,
                              rti1516e::OrderType, rti1516e::SupplementalReflectInfo) override {
    note("stamped" + values(map) + " tag " + text_of(tag) + " at " + to_utf8(time.toString()));
  }
  void reflectAttributeValues(rti1516e::ObjectInstanceHandle,
                              rti1516e::AttributeHandleValueMap const& map,
                              rti1516e::VariableLengthData const& tag, rti1516e::OrderType,
                              rti1516e::TransportationType, rti1516e::LogicalTime const& time,
                              rti1516e::OrderType received, rti1516e::MessageRetractionHandle,
                              rti1516e::SupplementalReflectInfo) override {
    note((received == rti1516e::TIMESTAMP ? "ordered" : "early") + values(map) + " tag " +
         text_of(tag) + " at " + to_utf8(time.toString()));
  }
  static std::string values(rti1516e::ParameterHandleValueMap const& map) {
    std::string text;
    for (const auto& [handle, value] : map) text += " " + text_of(value);
    return text;
  }
  void receiveInteraction(rti1516e::InteractionClassHandle handle,
                          rti1516e::ParameterHandleValueMap const& map,
                          rti1516e::VariableLengthData const& tag, rti1516e::OrderType,
                          rti1516e::TransportationType,
                          rti1516e::SupplementalReceiveInfo) override {
    note("received " + to_utf8(handle.toString()) + values(map) + " tag " + text_of(tag));
  }
  void receiveInteraction(rti1516e::InteractionClassHandle handle,
                          rti1516e::ParameterHandleValueMap const& map,
                          rti1516e::VariableLengthData const& tag, rti1516e::OrderType,
                          rti1516e::TransportationType, rti1516e::LogicalTime const& time,
                          rti1516e::OrderType, rti1516e::MessageRetractionHandle,
                          rti1516e::SupplementalReceiveInfo) override {
    note("received " + to_utf8(handle.toString()) + values(map) + " tag " + text_of(tag) + " at " +
         to_utf8(time.toString()));
  }
  void removeObjectInstance(rti1516e::ObjectInstanceHandle, rti1516e::VariableLengthData const&,
                            rti1516e::OrderType, rti1516e::SupplementalRemoveInfo) override {
    note("removed");
  }
  void removeObjectInstance(rti1516e::ObjectInstanceHandle, rti1516e::VariableLengthData const& tag,
                            rti1516e::OrderType, rti1516e::LogicalTime const& time,
                            rti1516e::OrderType, rti1516e::MessageRetractionHandle,
                            rti1516e::SupplementalRemoveInfo) override {
    note("removed tag " + text_of(tag) + " at " + to_utf8(time.toString()));
  }
  void attributesInScope(rti1516e::ObjectInstanceHandle,
                         rti1516e::AttributeHandleSet const& set) override {
    note("in scope " + std::to_string(set.size()));
  }
  void attributesOutOfScope(rti1516e::ObjectInstanceHandle,
                            rti1516e::AttributeHandleSet const& set) override {
    note("out of scope " + std::to_string(set.size()));
  }
  void provideAttributeValueUpdate(rti1516e::ObjectInstanceHandle,
                                   rti1516e::AttributeHandleSet const& set,
                                   rti1516e::VariableLengthData const& tag) override {
    note("asked for " + std::to_string(set.size()) + " tag " + text_of(tag));
  }
  void reportAttributeTransportationType(rti1516e::ObjectInstanceHandle, rti1516e::AttributeHandle,
                                         rti1516e::TransportationType type) override {
    note("transportation " + std::to_string(type));
  }
  void requestAttributeOwnershipAssumption(rti1516e::ObjectInstanceHandle,
                                           rti1516e::AttributeHandleSet const& set,
                                           rti1516e::VariableLengthData const& tag) override {
    note("offered " + std::to_string(set.size()) + " tag " + text_of(tag));
  }
  void requestDivestitureConfirmation(rti1516e::ObjectInstanceHandle,
                                      rti1516e::AttributeHandleSet const& set) override {
    note("may confirm " + std::to_string(set.size()));
  }
  void attributeOwnershipAcquisitionNotification(rti1516e::ObjectInstanceHandle,
                                                 rti1516e::AttributeHandleSet const& set,
                                                 rti1516e::VariableLengthData const& tag) override {
    note("acquired " + std::to_string(set.size()) + " tag " + text_of(tag));
  }
  void attributeOwnershipUnavailable(rti1516e::ObjectInstanceHandle,
                                     rti1516e::AttributeHandleSet const& set) override {
    note("unavailable " + std::to_string(set.size()));
  }
  void requestAttributeOwnershipRelease(rti1516e::ObjectInstanceHandle,
                                        rti1516e::AttributeHandleSet const& set,
                                        rti1516e::VariableLengthData const& tag) override {
    note("asked to release " + std::to_string(set.size()) + " tag " + text_of(tag));
  }
  void informAttributeOwnership(rti1516e::ObjectInstanceHandle, rti1516e::AttributeHandle,
                                rti1516e::FederateHandle owner) override {
    note("owner", owner.toString());
  }
  void attributeIsNotOwned(rti1516e::ObjectInstanceHandle, rti1516e::AttributeHandle) override {
    note("no owner");
  }
  void timeRegulationEnabled(rti1516e::LogicalTime const& time) override {
    note("regulating", time.toString());
  }
  void timeConstrainedEnabled(rti1516e::LogicalTime const& time) override {
    note("constrained", time.toString());
  }
  void timeAdvanceGrant(rti1516e::LogicalTime const& time) override {
    note("granted", time.toString());
  }
  void requestRetraction(rti1516e::MessageRetractionHandle) override { note("retracted"); }

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  rti1516e::ObjectInstanceHandle found_;
  rti1516e::ObjectClassHandle found_class_;
};

/// A federate that is connected to a harbour.
class Sailor {
 public:
  explicit Sailor(const Harbour& harbour, rti1516e::CallbackModel model = rti1516e::HLA_EVOKED)
      : rti_(rti1516e::RTIambassadorFactory().createRTIambassador().release()) {
    rti_->connect(log, model, harbour.address());
  }
  /// Joins the execution "port", which it creates if nobody has.
  Sailor(const Harbour& harbour, const std::wstring& name,
         rti1516e::CallbackModel model = rti1516e::HLA_EVOKED, const std::wstring& time = L"")
      : Sailor(harbour, model) {
    try {
      rti_->createFederationExecution(L"port", to_wide(model_file()), time);
    } catch (const rti1516e::FederationExecutionAlreadyExists&) {
    }
    self = rti_->joinFederationExecution(name, L"sailor", L"port");
  }
  rti1516e::RTIambassador* operator->() { return rti_.get(); }
  /// Destroys the ambassador.
  void scuttle() { rti_.reset(); }
  /// Returns once the RTI has answered, so that what it sent before waits for its turn.
  void hear_the_rti() {
    rti1516e::HLAfloat64Time galt;
    for (int answer = 0; answer < 2; ++answer) rti_->queryGALT(galt);
  }

  /// Takes callbacks until `is_so()`, for 5 s at most.
  template <class Condition>
  bool until(const Condition& is_so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (!is_so() && std::chrono::steady_clock::now() < end)
      rti_->evokeMultipleCallbacks(0.005, 0.05);
    return is_so();
  }
  ::testing::AssertionResult hears(const std::string& line, std::size_t times = 1) {
    if (until([&] { return log.count(line) >= times; })) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "no '" << line << "' in:\n" << log.all();
  }

  rti1516e::ObjectClassHandle vessel() { return rti_->getObjectClassHandle(L"Vessel"); }
  rti1516e::ObjectClassHandle ship() {
    return rti_->getObjectClassHandle(L"HLAobjectRoot.Vessel.Ship");
  }
  rti1516e::AttributeHandle x() { return rti_->getAttributeHandle(ship(), L"x"); }
  rti1516e::AttributeHandle flag() { return rti_->getAttributeHandle(ship(), L"flag"); }
  rti1516e::AttributeHandleSet both() { return {x(), flag()}; }
  rti1516e::InteractionClassHandle signal() { return rti_->getInteractionClassHandle(L"Signal"); }
  rti1516e::InteractionClassHandle hail() {
    return rti_->getInteractionClassHandle(L"Signal.Hail");
  }
  void update(rti1516e::ObjectInstanceHandle object, const std::string& at,
              const std::string& colour, const std::string& tag = {}) {
    rti_->updateAttributeValues(object, {{x(), data_of(at)}, {flag(), data_of(colour)}},
                                data_of(tag));
  }

  Log log;
  rti1516e::FederateHandle self;

 private:
  std::unique_ptr<rti1516e::RTIambassador> rti_;
};

}  // namespace rink::standard::testing
