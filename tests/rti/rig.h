// A federation on either transport, pumped step by step, whose federates write down what they are
// told.
#pragma once

#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/modelled/network_model.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/wire/object_block.h"
#include "rti/wire/update_block.h"

namespace rink::rti::testing {

/// A block of one object.
template <MessageKind k>
struct OneObject {
  static constexpr MessageKind kind = k;
  std::uint32_t object = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, OneObject<k>& message) {
  std::uint64_t step = handle_step(before_first<OneObject<k>>(), message.object), end = 0;
  return stream.varint(step) && stream.varint(end);
}

/// A harbour: nothing to do with the game. Vessel has 8 + 4 bytes of fixed size, Ferry inherits and
/// adds a text.
inline constexpr const char* harbour_xml = R"(<?xml version="1.0"?>
<objectModel>
  <modelIdentification><name>Harbour</name></modelIdentification>
  <objects>
    <objectClass><name>HLAobjectRoot</name>
      <objectClass><name>Vessel</name>
        <attribute><name>position</name><dataType>Position</dataType><dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions></attribute>
        <attribute><name>speed</name><dataType>HLAfloat32LE</dataType></attribute>
        <objectClass><name>Ferry</name>
          <attribute><name>destination</name><dataType>HLAASCIIstring</dataType><order>TimeStamp</order></attribute>
        </objectClass>
      </objectClass>
      <objectClass><name>Tide</name>
        <attribute><name>level</name><dataType>HLAfloat64LE</dataType><transportation>HLAbestEffort</transportation></attribute>
      </objectClass>
    </objectClass>
  </objects>
  <interactions>
    <interactionClass><name>HLAinteractionRoot</name>
      <interactionClass><name>Hail</name><parameter><name>words</name><dataType>HLAASCIIstring</dataType></parameter>
        <interactionClass><name>Mayday</name></interactionClass>
      </interactionClass>
    </interactionClass>
  </interactions>
  <dimensions><dimension><name>X</name></dimension><dimension><name>Y</name></dimension></dimensions>
  <dataTypes>
    <fixedRecordDataTypes>
      <fixedRecordData><name>Position</name>
        <field><name>x</name><dataType>HLAfloat32LE</dataType></field>
        <field><name>y</name><dataType>HLAfloat32LE</dataType></field>
      </fixedRecordData>
    </fixedRecordDataTypes>
  </dataTypes>
</objectModel>
)";

inline const Fom& harbour() {
  static const Fom fom = Fom::parse(harbour_xml, "harbour.xml");
  return fom;
}
inline const ObjectClassHandle vessel = *harbour().object_class("Vessel"),
                               ferry = *harbour().object_class("Ferry");
inline const AttributeHandle position = *harbour().attribute(ferry, "position"),
                             speed = *harbour().attribute(ferry, "speed"),
                             destination = *harbour().attribute(ferry, "destination");
inline const AttributeSet motion{position, speed},
    whole_vessel{position, speed, privilege_to_delete_object};
inline const InteractionClassHandle hail = *harbour().interaction_class("Hail"),
                                    mayday = *harbour().interaction_class("Mayday");

inline std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}
inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
template <class... Numbers>
std::vector<std::byte> values_of(const Numbers&... numbers) {
  std::vector<std::byte> bytes((sizeof(Numbers) + ... + 0));
  std::size_t at = 0;
  ((std::memcpy(bytes.data() + at, &numbers, sizeof numbers), at += sizeof numbers), ...);
  return bytes;
}
/// `payload` in a frame of its own, also if it is empty, which no writer makes.
inline std::vector<std::byte> in_frame(Bytes payload) {
  std::vector<std::byte> bytes(frame_head_size(payload.size()));
  if (!payload.empty()) write_frame_head(bytes.data(), payload.size());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}
/// A value of varying size as it travels.
inline std::vector<std::byte> varying(std::string_view text) {
  std::vector<std::byte> bytes = values_of(static_cast<std::uint32_t>(text.size()));
  const std::vector<std::byte> content = bytes_of(text);
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

/// Writes down everything, and what the state is by what it was told.
class Recorder : public FederateAmbassador {
 public:
  struct Known {
    ObjectClassHandle object_class;
    std::string name;
    bool is_in_scope = false;
    std::map<std::uint32_t, std::vector<std::byte>> values;  ///< by attribute
    int updates = 0;
    Stamp stamp;
  };
  const Fom* model = &harbour();  ///< of its ambassador
  std::vector<std::string> log;
  std::map<std::uint32_t, Known> objects;
  std::map<std::uint32_t, int> discoveries;
  std::map<std::uint32_t, std::string> federates;
  std::vector<std::pair<std::uint32_t, std::string>> interactions;  ///< class, parameters
  std::string lost;
  std::optional<Refusal> refusal;

  void joined(FederateHandle) override { log.push_back("joined"); }
  void join_refused(Refusal why, std::string_view text) override {
    refusal = why;
    log.push_back("refused: " + std::string(text));
  }
  void connection_lost(std::string_view why) override { lost = why; }
  void announce_synchronization_point(std::string_view label, Bytes tag) override {
    log.push_back("announced " + std::string(label) + (tag.empty() ? "" : " with " + text_of(tag)));
  }
  void federation_synchronized(std::string_view label,
                               std::span<const FederateHandle> failed) override {
    log.push_back("synchronized " + std::string(label));
    for (const FederateHandle each : failed) log.back() += " without " + std::to_string(each.value);
  }
  void synchronization_point_registration_succeeded(std::string_view label) override {
    log.push_back("registered " + std::string(label));
  }
  void synchronization_point_registration_failed(std::string_view label,
                                                 SynchronizationFailure failure) override {
    log.push_back("not registered " + std::string(label) + ": " + to_string(failure));
  }
  void federation_execution_created(std::string_view federation, HlaError error) override {
    log.push_back("created " + std::string(federation) + to_string(error));
  }
  void federation_execution_destroyed(std::string_view federation, HlaError error) override {
    log.push_back("destroyed " + std::string(federation) + to_string(error));
  }
  void report_federation_executions(
      const std::vector<FederationExecutionInformation>& all) override {
    log.push_back("listed");
    for (const FederationExecutionInformation& each : all)
      log.back() += " " + each.federation + ":" + std::to_string(each.federates);
  }
  void federate_joined(FederateHandle handle, std::string_view name, std::string_view) override {
    federates[handle.value] = name;
  }
  void federate_resigned(FederateHandle handle, std::string_view name, std::string_view,
                         ResignReason reason) override {
    federates.erase(handle.value);
    log.push_back(std::string(name) + " " + to_string(reason));
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    ++discoveries[object.value];
    objects[object.value] = {object_class, std::string(name), false, {}, 0, {}};
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    Known& known = objects.at(object.value);
    if (!known.is_in_scope) ++out_of_scope_updates;
    ++known.updates;
    known.stamp = stamp;
    for (std::uint32_t i = 0; i < attribute_max; ++i) {
      if (!set.contains({i})) continue;
      const Bytes value = model->value(known.object_class, set, {i}, values);
      known.values[i] = {value.begin(), value.end()};
    }
  }
  /// What it registered itself and gave away was never discovered.
  /// One's own that was given up is never discovered: a vessel or a ferry, whose attributes begin
  /// with a vessel's.
  void attributes_in_scope(ObjectHandle object) override {
    objects.try_emplace(object.value, Known{ferry, "", false, {}, 0, {}})
        .first->second.is_in_scope = true;
  }
  void attributes_out_of_scope(ObjectHandle object) override {
    objects.at(object.value).is_in_scope = false;
  }
  void remove_object_instance(ObjectHandle object) override {
    objects.erase(object.value);
    std::erase_if(pending, [object](const auto& each) { return each.first == object.value; });
  }
  void receive_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                           FederateHandle, const Stamp&) override {
    interactions.emplace_back(interaction_class.value, text_of(parameters));
  }
  int out_of_scope_updates = 0;

  // Ownership: what, object, attributes as bits, tag.
  void request_attribute_ownership_assumption(ObjectHandle object, AttributeSet set,
                                              Bytes tag) override {
    note("assume", object, set, tag);
  }
  void request_divestiture_confirmation(ObjectHandle object, AttributeSet set) override {
    note("confirm", object, set);
  }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet set,
                                                    Bytes tag) override {
    note("acquired", object, set, tag);
  }
  void attribute_ownership_unavailable(ObjectHandle object, AttributeSet set) override {
    note("unavailable", object, set);
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet set,
                                           Bytes tag) override {
    note("release", object, set, tag);
  }
  void confirm_attribute_ownership_acquisition_cancellation(ObjectHandle object,
                                                            AttributeSet set) override {
    note("cancelled", object, set);
  }
  void inform_attribute_ownership(ObjectHandle object, AttributeHandle attribute,
                                  FederateHandle owner) override {
    owners[{object.value, attribute.value}] = owner.value;
  }
  void attribute_is_not_owned(ObjectHandle object, AttributeHandle attribute) override {
    owners[{object.value, attribute.value}] = FederateHandle::none;
  }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet set) override {
    note("divested", object, set);
  }
  void attribute_ownership_kept(ObjectHandle object, AttributeSet set) override {
    note("kept", object, set);
  }
  void note(const char* what, ObjectHandle object, AttributeSet set, Bytes tag = {}) {
    ownership.push_back({what, object.value, set.bits, text_of(tag)});
    for (std::uint32_t i = 0; i < attribute_max; ++i) {
      if (!set.contains({i}) || what == std::string_view("kept")) continue;
      if (what == std::string_view("acquired") || what == std::string_view("unavailable") ||
          what == std::string_view("cancelled"))
        pending.erase({object.value, i});
    }
  }
  struct OwnershipNote {
    std::string what;
    std::uint32_t object;
    AttributeBits attributes;
    std::string tag;
    friend bool operator==(const OwnershipNote&, const OwnershipNote&) = default;
  };
  std::vector<OwnershipNote> ownership;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
      owners;  ///< as answered to queries, by object and attribute
  std::set<std::pair<std::uint32_t, std::uint32_t>>
      pending;  ///< what the test noted as being acquired, until its end was told
};

enum class Carrier { in_process, tcp, virtual_network };
inline std::string name_of(Carrier carrier) {
  return carrier == Carrier::tcp               ? "tcp"
         : carrier == Carrier::virtual_network ? "virtual_network"
                                               : "in_process";
}

/// A federate with its record.
struct Station {
  Recorder heard;
  Ambassador ambassador;
  std::unique_ptr<FederateLink> link;
  explicit Station(const Fom& fom) : ambassador(fom, heard) { heard.model = &fom; }
};

/// One federation execution and its federates. `settle` carries everything to its end.
class Rig {
 public:
  explicit Rig(Carrier carrier, FederationSettings settings = {}, TcpSettings tcp_settings = {},
               const FederationServices& services = {})
      : carrier_(carrier),
        execution_(harbour(), settings, services),
        host_(execution_),
        server_tcp_(tcp_settings),
        server_local_(network_),
        clients_local_(network_) {
    if (carrier == Carrier::tcp) port_ = server_tcp_.listen("127.0.0.1", 0);
    else if (carrier == Carrier::virtual_network) server_virtual_.listen("rti");
    else server_local_.listen("rti");
    host_.add(server_transport());
  }
  Transport& server_transport() { return chosen(server_tcp_, server_local_, server_virtual_); }
  Transport& client_transport() { return chosen(clients_tcp_, clients_local_, clients_virtual_); }
  std::uint16_t port() const { return port_; }
  FederationExecution& execution() { return execution_; }
  FederationHost& host() { return host_; }
  double now = 0.0;

  /// A connected federate that has not asked to join.
  Station& connect(const Fom& fom = harbour()) {
    Station& station = stations_.emplace_back(fom);
    const ConnectionId id = carrier_ == Carrier::tcp ? clients_tcp_.connect("127.0.0.1", port_)
                            : carrier_ == Carrier::virtual_network ? clients_virtual_.connect("rti")
                                                                   : clients_local_.connect("rti");
    station.link = std::make_unique<FederateLink>(station.ambassador, client_transport(), id);
    links_.add(*station.link);
    return station;
  }
  Station& join(const std::string& name) {
    Station& station = connect();
    station.ambassador.join("rink", name, "tester");
    settle();
    return station;
  }
  /// Federates speak, the RTI listens and answers, federates listen.
  void round() {
    const auto wait =
        carrier_ == Carrier::tcp ? std::chrono::microseconds(300) : std::chrono::microseconds(0);
    links_.flush(now);
    let_arrive();
    client_transport().poll(std::chrono::nanoseconds(0), links_);
    host_.poll(wait);
    host_.advance_clock(now);
    host_.match();
    host_.flush();
    let_arrive();
    client_transport().poll(wait, links_);
  }
  void settle(int quiet_rounds = 3) {
    for (int quiet = 0, rounds = 0; quiet < quiet_rounds && rounds < 2000; ++rounds) {
      const auto before = traffic();
      round();
      quiet = traffic() == before ? quiet + 1 : 0;
    }
  }

 private:
  std::uint64_t traffic() const {
    std::uint64_t sum = execution_.counters().bytes_sent + execution_.counters().bytes_received +
                        execution_.counters().resigns;
    for (const Station& station : stations_)
      sum +=
          station.ambassador.counters().bytes_received + station.ambassador.counters().bytes_sent;
    return sum;
  }
  Transport& chosen(Transport& tcp, Transport& local, Transport& modelled) {
    return carrier_ == Carrier::tcp ? tcp : carrier_ == Carrier::virtual_network ? modelled : local;
  }
  /// Whatever the perfect virtual network carries is there at the instant of sending.
  void let_arrive() { virtual_.advance_to(virtual_.now_ns()); }
  Carrier carrier_;
  FederationExecution execution_;
  FederationHost host_;
  InProcessNetwork network_;
  TcpTransport server_tcp_, clients_tcp_;
  InProcessEndpoint server_local_, clients_local_;
  NetworkModel perfect_{NetworkConditions{}};
  VirtualNetwork virtual_{perfect_};
  VirtualEndpoint server_virtual_{virtual_}, clients_virtual_{virtual_};
  std::uint16_t port_ = 0;
  FederateLinks links_;
  std::deque<Station> stations_;
};

}  // namespace rink::rti::testing
