// A federation whose federates do by chance all that they may, a hash of every byte that each of
// them is sent, and one of what each ambassador sends and calls back.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/hla_error.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/callback_hash.h"

namespace rink::rti::testing::at_the_regatta {

/// Everything that travels in a way of its own: reliable and best-effort attributes, of fixed and
/// of varying size, in the order of time stamps, over two dimensions, and periodic state.
inline constexpr const char* regatta_xml = R"(<?xml version="1.0"?>
<objectModel>
  <modelIdentification><name>Regatta</name></modelIdentification>
  <objects>
    <objectClass><name>HLAobjectRoot</name>
      <objectClass><name>Yacht</name>
        <attribute><name>place</name><dataType>HLAfloat64LE</dataType><dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions></attribute>
        <attribute><name>speed</name><dataType>HLAfloat32LE</dataType><transportation>HLAbestEffort</transportation></attribute>
        <objectClass><name>Cruiser</name>
          <attribute><name>destination</name><dataType>HLAASCIIstring</dataType><order>TimeStamp</order></attribute>
        </objectClass>
      </objectClass>
      <objectClass><name>Buoy</name>
        <attribute><name>drift</name><dataType>Drift</dataType><updateType>Periodic</updateType></attribute>
      </objectClass>
    </objectClass>
  </objects>
  <interactions>
    <interactionClass><name>HLAinteractionRoot</name>
      <interactionClass><name>Hail</name><dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions><parameter><name>words</name><dataType>HLAASCIIstring</dataType></parameter>
        <interactionClass><name>Mayday</name><dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions></interactionClass>
      </interactionClass>
    </interactionClass>
  </interactions>
  <dimensions><dimension><name>X</name></dimension><dimension><name>Y</name></dimension></dimensions>
  <dataTypes>
    <simpleDataTypes>
      <simpleData notes="ofTheSea"><name>Metres</name><representation>HLAfloat64LE</representation><units>m</units><resolution>0.001</resolution></simpleData>
    </simpleDataTypes>
    <fixedRecordDataTypes>
      <fixedRecordData><name>Drift</name>
        <field><name>x</name><dataType>Metres</dataType></field>
        <field><name>y</name><dataType>Metres</dataType></field>
      </fixedRecordData>
    </fixedRecordDataTypes>
  </dataTypes>
  <notes><note><label>ofTheSea</label><semantics>range -500 2500</semantics></note></notes>
</objectModel>
)";

inline const Fom& regatta() {
  static const Fom fom = Fom::parse(regatta_xml, "regatta.xml");
  return fom;
}

/// A federate that knows what it may name: what it made, and what it was told of.
struct Sailor final : CallbackHash {
  explicit Sailor(ByteHash& hash, CallbackModel model)
      : CallbackHash(hash), ambassador(regatta(), *this, {}, model) {}

  Ambassador ambassador;
  ConnectionId connection = 0;
  bool is_lost = false;
  std::map<std::uint32_t, std::uint32_t> objects;  ///< their classes
  std::vector<RegionHandle> regions;
  std::vector<RetractionHandle> sent;
  std::vector<std::string> labels, names;
  double lookahead = 0.5;
  std::function<void()> meanwhile;  ///< what it does within each callback that tells it values

  void connection_lost(std::string_view why) override {
    CallbackHash::connection_lost(why);
    is_lost = true;
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    CallbackHash::discover_object_instance(object, object_class, name);
    objects[object.value] = object_class.value;
  }
  /// The values are noted last: what is done meanwhile must leave them as they are.
  void reflect_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                const Stamp& stamp) override {
    if (meanwhile) meanwhile();
    CallbackHash::reflect_attribute_values(object, attributes, values, stamp);
  }
  void remove_object_instance(ObjectHandle object) override {
    CallbackHash::remove_object_instance(object);
    objects.erase(object.value);
  }
  void announce_synchronization_point(std::string_view label, Bytes tag) override {
    CallbackHash::announce_synchronization_point(label, tag);
    labels.emplace_back(label);
  }
};

/// Seats are filled anew when whoever has one leaves. The tap notes per seat what it is sent.
class Regatta final : public Outlet {
 public:
  explicit Regatta(std::uint64_t seed, std::size_t seats, const FederationSettings& settings = {},
                   CallbackModel model = CallbackModel::immediate)
      : execution(regatta(), settings),
        model_(model),
        hashes_(seats),
        ambassador_hashes_(seats),
        random_(seed) {
    for (std::size_t i = 0; i < seats; ++i) {
      sailors_.emplace_back();
      enter(i);
    }
    tick();
  }
  FederationExecution execution;
  std::size_t datagram_size = 0, queued_bytes = 0;  ///< of what each connection carries, or keeps
  double tick_s = 0.05;

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  bool one_in(std::uint64_t count) { return below(count) == 0; }
  Sailor& sailor(std::size_t seat) { return *sailors_[seat]; }
  std::size_t seat_count() const { return sailors_.size(); }

  /// Services refuse what makes no sense just now.
  template <class Service>
  static bool attempt(Service service) {
    try {
      service();
      return true;
    } catch (const RtiException&) {
      return false;
    }
  }
  void enter(std::size_t seat) {
    if (sailors_[seat]) note_counts(seat);
    sailors_[seat] = std::make_unique<Sailor>(ambassador_hashes_[seat], model_);
    sailors_[seat]->connection = next_connection_++;
    seats_.push_back(seat);
    execution.connect(sailors_[seat]->connection);
    sailors_[seat]->ambassador.join("rink", "sailor " + std::to_string(seats_.size()), "tester");
  }
  /// A connection without a sailor; the tap notes what it is sent as that seat's.
  ConnectionId admit_stranger(std::size_t seat) {
    seats_.push_back(seat);
    execution.connect(next_connection_);
    return next_connection_++;
  }
  void speak(std::size_t seat) {
    Sailor& from = *sailors_[seat];
    if (from.is_lost) return;
    from.ambassador.expect_datagrams(datagram_size);
    const std::vector<std::byte> bytes = copy_of(from.ambassador.outgoing());
    std::vector<std::vector<std::byte>> datagrams;
    for (const Datagram& each : from.ambassador.outgoing_datagrams()) {
      datagrams.push_back(copy_of(each.head));
      datagrams.back().insert(datagrams.back().end(), each.body.begin(), each.body.end());
    }
    ambassador_hashes_[seat].add(Bytes(bytes));
    for (const std::vector<std::byte>& each : datagrams) ambassador_hashes_[seat].add(Bytes(each));
    from.ambassador.clear_outgoing();
    from.ambassador.clear_outgoing_datagrams();
    const bool is_datagram_first = one_in(2);
    const auto arrive = [&] {
      for (const std::vector<std::byte>& each : datagrams)
        if (!one_in(4)) execution.receive_datagram(from.connection, each);
    };
    if (is_datagram_first) arrive();
    const std::size_t cut = bytes.empty() ? 0 : below(bytes.size());
    execution.receive(from.connection, Bytes(bytes).first(cut));
    execution.receive(from.connection, Bytes(bytes).subspan(cut));
    if (!is_datagram_first) arrive();
  }
  void tick() {
    now_ += tick_s;
    for (std::size_t seat = 0; seat < sailors_.size(); ++seat) {
      if (!sailors_[seat]->is_lost) sailors_[seat]->ambassador.advance_clock(now_);
      speak(seat);
    }
    execution.advance_clock(now_);
    execution.match();
    execution.flush(*this);
  }
  void kill(std::size_t seat) {
    execution.disconnect(sailors_[seat]->connection, "killed");
    sailors_[seat]->is_lost = true;
  }
  /// By seat; the last one is of what the execution counted.
  std::vector<std::uint64_t> hashes() const {
    std::vector<std::uint64_t> all;
    for (const ByteHash& each : hashes_) all.push_back(each.value());
    all.push_back(count_hash());
    return all;
  }
  /// Of what the ambassadors of all seats sent, called back and counted.
  std::uint64_t ambassador_hash() {
    ByteHash all;
    for (std::size_t seat = 0; seat < sailors_.size(); ++seat) {
      note_counts(seat);
      all.add(ambassador_hashes_[seat].value());
    }
    return all.value();
  }

 private:
  void note_counts(std::size_t seat) {
    const AmbassadorCounters& counted = sailors_[seat]->ambassador.counters();
    for (const std::uint64_t each : {counted.bytes_received,      counted.bytes_sent,
                                     counted.frames_received,     counted.frames_sent,
                                     counted.updates_sent,        counted.updates_reflected,
                                     counted.interactions_sent,   counted.interactions_received,
                                     counted.updates_spared,      counted.interactions_spared,
                                     counted.objects_discovered,  counted.objects_removed,
                                     counted.scope_changes,       counted.keyframes_acknowledged,
                                     counted.differences_refused, counted.timed_sent,
                                     counted.timed_received,      counted.time_advance_grants,
                                     counted.datagrams_received,  counted.datagrams_ignored,
                                     counted.updates_outdated,    counted.datagrams_sent,
                                     counted.updates_repaired,    counted.datagram_fallbacks,
                                     counted.datagram_recoveries})
      ambassador_hashes_[seat].add(each);
  }
  static std::vector<std::byte> copy_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }
  std::uint64_t count_hash() const {
    const FederationCounters& counted = execution.counters();
    ByteHash hash;
    for (const std::uint64_t each : {counted.bytes_received,
                                     counted.bytes_sent,
                                     counted.scope_bytes_sent,
                                     counted.entry_bytes_sent,
                                     counted.update_bytes_sent,
                                     counted.interaction_bytes_sent,
                                     counted.frames_received,
                                     counted.frames_sent,
                                     counted.updates_received,
                                     counted.updates_sent,
                                     counted.updates_put_off,
                                     counted.updates_caught_up,
                                     counted.updates_held_back,
                                     counted.interactions_received,
                                     counted.interactions_sent,
                                     counted.scope_entries,
                                     counted.scope_exits,
                                     counted.entries_postponed,
                                     counted.late_requests,
                                     counted.ownership_notices_sent,
                                     counted.joins,
                                     counted.resigns,
                                     counted.timed_received,
                                     counted.timed_sent,
                                     counted.retractions,
                                     counted.time_advance_grants,
                                     counted.management_updates,
                                     counted.datagrams_received,
                                     counted.updates_outdated,
                                     counted.datagrams_sent,
                                     counted.datagrams_ignored,
                                     counted.updates_repaired,
                                     counted.datagram_fallbacks,
                                     counted.datagram_recoveries})
      hash.add(each);
    for (const std::uint64_t each : counted.drops) hash.add(each);
    return hash.value();
  }
  std::size_t waiting_bytes(ConnectionId) const override { return queued_bytes; }
  std::size_t datagram_max(ConnectionId connection) const override {
    return connection % 3 == 2 ? 0 : datagram_size;
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) {
      hash_of(connection).add(part);
      if (Sailor* to = at(connection); to != nullptr) to->ambassador.receive(part);
    }
  }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    for (const Datagram& each : datagrams) {
      std::vector<std::byte> whole = copy_of(each.head);
      whole.insert(whole.end(), each.body.begin(), each.body.end());
      hash_of(connection).add(whole);
      if (Sailor* to = at(connection); to != nullptr && !one_in(4))
        to->ambassador.receive_datagram(whole);
    }
  }
  void drop(ConnectionId connection, std::string_view why) override {
    hash_of(connection).add(why);
    if (Sailor* to = at(connection); to != nullptr) to->is_lost = true;
  }
  ByteHash& hash_of(ConnectionId connection) { return hashes_[seats_[connection]]; }
  Sailor* at(ConnectionId connection) {
    Sailor* sailor = sailors_[seats_[connection]].get();
    return sailor->connection == connection && !sailor->is_lost ? sailor : nullptr;
  }

  std::vector<std::unique_ptr<Sailor>> sailors_;  ///< by seat
  std::vector<std::size_t> seats_;                ///< by connection
  CallbackModel model_;
  std::vector<ByteHash> hashes_, ambassador_hashes_;  ///< by seat: what is sent to it, and by it
  std::mt19937_64 random_;
  ConnectionId next_connection_ = 0;
  double now_ = 0.0;
};

}  // namespace rink::rti::testing::at_the_regatta
