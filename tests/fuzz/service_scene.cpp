// The RTI's services between strangers who say whatever a fuzzer makes up, and a witness.
#include "tests/fuzz/service_scene.h"

#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rti/time/federate_clock.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/message_shapes.h"
#include "tests/rti/rig.h"

namespace rink::fuzz {
namespace {

using namespace rti;
using rti::testing::harbour;
using rti::testing::Recorder;

const AttributeSet motion{rti::testing::position, rti::testing::speed};

/// The witness, who notes what time and ownership do to it.
struct Witness : Recorder {
  double time = 0.0;
  int discovered_twice = 0;
  void time_advance_grant(LogicalTime now) override {
    require(now.value >= time, "time does not go back");
    time = now.value;
  }
  void receive_interaction_with_time(InteractionClassHandle, Bytes, FederateHandle,
                                     const TimedStamp& timed) override {
    require(!timed.is_in_order || timed.stamp.time >= time,
            "nothing comes in order that is older than one's time");
  }
  void reflect_attribute_values_with_time(ObjectHandle, AttributeSet, Bytes,
                                          const TimedStamp& timed) override {
    require(!timed.is_in_order || timed.stamp.time >= time,
            "no value comes in order that is older than one's time");
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    require(!objects.contains(object.value), "an object is discovered once");
    Recorder::discover_object_instance(object, object_class, name);
  }
};

class Quay final : public Outlet {
 public:
  static constexpr ConnectionId stranger_count = 2;
  Quay()
      : execution_(harbour(), {.federation = "rink",
                               .filter = "region",
                               .filter_settings = {},
                               .federate_max = 4,
                               .object_max = 64,
                               .objects_per_federate_max = 64,
                               .timeouts = {},
                               .update_rate = {}}) {
    execution_.connect(0);
    witness.join("rink", "witness", "tester");
    tick();
    set_up(witness);
    own = witness.register_object_instance(rti::testing::vessel, "own");
    objects_.push_back(own.value);
    tick();
    for (ConnectionId who = 1; who <= stranger_count; ++who) enter(who);
  }
  Witness heard;
  Ambassador witness{harbour(), heard};
  ObjectHandle own;
  FederationExecution& execution() { return execution_; }

  /// Strangers send each message of the group without its last byte, and frames without a message,
  /// and are dropped.
  void refuse(std::span<const Shape> shapes) {
    static const std::vector<std::byte> zeros(frame_max_to_rti + 2 * frame_head_max);
    const auto must_drop = [this](const auto& speak) {
      if (!strangers_[1].is_here) enter(1);
      require(strangers_[1].is_here, "who joins by rule is let in");
      speak();
      tick();
      require(!strangers_[1].is_here, "what is malformed is the last that its sender says");
    };
    must_drop([&] { execution_.receive(1, zeros); });
    for (const Shape& shape : shapes) {
      if (shape.fields.empty()) continue;
      Input none({});
      std::vector<std::byte> message = Scribe(none, objects_).message(shape);
      message.pop_back();
      must_drop([&] { say(1, message); });
    }
  }

  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) {
      if (connection == 0) require(witness.receive(part), "the witness understands what it hears");
      else if (strangers_[connection].entering) strangers_[connection].entering->receive(part);
    }
  }
  void drop(ConnectionId connection, std::string_view) override {
    require(connection != 0, "the witness stays");
    strangers_[connection].is_here = false;
  }
  void tick() {
    now_ += 0.125;
    witness.advance_clock(now_);
    execution_.receive(0, witness.outgoing());
    witness.clear_outgoing();
    for (ConnectionId who = 1; who <= stranger_count; ++who)
      if (strangers_[who].is_here) execution_.receive(who, heartbeat());
    execution_.advance_clock(now_);
    execution_.match();
    execution_.flush(*this);
  }
  void turn(Input& input, std::span<const Shape> shapes) {
    const unsigned first = input.byte();
    if (first >= 224) return tick();
    const ConnectionId who = 1 + first % stranger_count;
    if (!strangers_[who].is_here) return enter(who);
    const unsigned which = first / stranger_count % (static_cast<unsigned>(shapes.size()) + 1);
    if (which == shapes.size()) return say(who, input.part(input.byte() % 48));
    say(who, Scribe(input, objects_).message(shapes[which]));
  }

 private:
  struct Stranger {
    bool is_here = false;
    Recorder heard;
    std::unique_ptr<Ambassador> entering;  ///< speaks for it until it is set up
  };
  static void set_up(Ambassador& ambassador) {
    ambassador.publish_object_class_attributes(rti::testing::vessel, motion);
    ambassador.subscribe_object_class_attributes(rti::testing::vessel, motion);
    ambassador.publish_interaction_class(rti::testing::hail);
    ambassador.subscribe_interaction_class(rti::testing::hail);
  }
  static Bytes heartbeat() {
    static const std::array frame{std::byte{1}, std::byte{},
                                  static_cast<std::byte>(MessageKind::heartbeat)};
    return frame;
  }
  /// Joins by rule, with an object of its own, which no fuzzer would find.
  void enter(ConnectionId who) {
    Stranger& stranger = strangers_[who];
    stranger.is_here = true;
    execution_.connect(who);
    stranger.heard = {};
    stranger.entering = std::make_unique<Ambassador>(harbour(), stranger.heard);
    const auto speak = [&] {
      execution_.receive(who, stranger.entering->outgoing());
      stranger.entering->clear_outgoing();
      tick();
    };
    stranger.entering->join("rink", "stranger " + std::to_string(who), "stranger");
    speak();
    if (!stranger.is_here || !stranger.entering->is_joined())
      return void(stranger.entering.reset());
    set_up(*stranger.entering);
    const ObjectHandle object = stranger.entering->register_object_instance(rti::testing::vessel);
    if (objects_.size() < 64) objects_.push_back(object.value);
    speak();
    stranger.entering.reset();
  }
  void say(ConnectionId who, Bytes message) {
    if (message.empty()) return;
    execution_.receive(who, rti::testing::in_frame(message));
  }

  FederationExecution execution_;
  std::array<Stranger, stranger_count + 1> strangers_;
  std::vector<std::uint32_t> objects_;
  double now_ = 0.0;
};

constexpr std::array time_shapes{
    Shape{MessageKind::enable_time_regulation, "d"}, Shape{MessageKind::time_switch, "b"},
    Shape{MessageKind::modify_lookahead, "d"},       Shape{MessageKind::advance_request, "bd"},
    Shape{MessageKind::timed_send, "vsc"},           Shape{MessageKind::retract, "v"},
    Shape{MessageKind::query_time_bounds, ""},       Shape{MessageKind::timed_send, "vsc"}};

constexpr std::array ownership_shapes{
    Shape{MessageKind::ownership_request, "bAtO"}, Shape{MessageKind::query_ownership, "ob"},
    Shape{MessageKind::resign_directive, "b"},     Shape{MessageKind::publish_object_class, "wa"},
    Shape{MessageKind::delete_object, "o"},        Shape{MessageKind::ownership_request, "bAtO"},
    Shape{MessageKind::local_delete, "o"}};

constexpr std::array regions_shapes{Shape{MessageKind::create_region, "r"},
                                    Shape{MessageKind::create_region_over, "rq"},
                                    Shape{MessageKind::modify_ranges, "rg"},
                                    Shape{MessageKind::regional_class, "wbp"},
                                    Shape{MessageKind::regional_interaction, "wbl"},
                                    Shape{MessageKind::associate_regions, "ubp"},
                                    Shape{MessageKind::interaction_within, "wslt"},
                                    Shape{MessageKind::associate_region, "ur"},
                                    Shape{MessageKind::delete_region, "r"},
                                    Shape{MessageKind::subscribe_object_class, "war"}};

}  // namespace

void drive_time(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  quay.witness.enable_time_constrained();
  quay.tick();
  double asked = 0.0;
  bool is_asking = false;
  while (!input.is_empty()) {
    quay.turn(input, time_shapes);
    is_asking = is_asking && quay.heard.time < asked;
    if (is_asking || !quay.witness.clock().is_constrained()) continue;
    is_asking = true;
    quay.witness.time_advance_request(LogicalTime(asked = quay.heard.time + 1.0));
  }
  quay.tick();
  require(quay.witness.is_joined(), "the witness is there at the end");
}

void refuse_time(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  while (!input.is_empty()) quay.turn(input, time_shapes);
  quay.refuse(time_shapes);
}

void drive_ownership(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  while (!input.is_empty()) {
    quay.turn(input, ownership_shapes);
    for (const AttributeHandle each : {rti::testing::position, rti::testing::speed})
      require(quay.witness.is_attribute_owned_by_federate(quay.own, each),
              "what one owns is lost by one's own word only");
  }
  quay.tick();
  quay.witness.query_attribute_ownership(quay.own, rti::testing::speed);
  quay.tick();
  quay.tick();
  const auto owner = quay.heard.owners.find({quay.own.value, rti::testing::speed.value});
  require(owner != quay.heard.owners.end() && owner->second == quay.witness.federate().value,
          "and the RTI knows it");
}

void refuse_ownership(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  while (!input.is_empty()) quay.turn(input, ownership_shapes);
  quay.refuse(ownership_shapes);
}

void drive_regions(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  const RegionHandle view = quay.witness.create_region();
  quay.witness.unsubscribe_object_class(rti::testing::vessel);
  quay.witness.subscribe_object_class_attributes(rti::testing::vessel, motion, view);
  for (int i = 0; !input.is_empty(); ++i) {
    if (i % 4 == 0) {
      quay.witness.set_region(view, {-2.0, -2.0, 0.25 * (i % 64), 8.0});
      quay.witness.commit_region_modifications(view);
    }
    quay.turn(input, regions_shapes);
  }
  quay.tick();
  quay.tick();
  for (const auto& [object, known] : quay.heard.objects)
    if (object != quay.own.value)
      require(known.is_in_scope == quay.execution().is_in_scope(quay.witness.federate(), {object}),
              "the witness knows its scope");
}

void refuse_regions(Bytes bytes) {
  Input input(bytes);
  Quay quay;
  while (!input.is_empty()) quay.turn(input, regions_shapes);
  quay.refuse(regions_shapes);
}

}  // namespace rink::fuzz
