// Strangers against a witness, and the RTI's voice against a federate.
#include "tests/fuzz/federation_scene.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "rti/wire/datagram.h"
#include "rti/wire/frame.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/suspicious_federate.h"
#include "tests/rti/rig.h"

namespace rink::fuzz {
namespace {

using namespace rti;
using rti::testing::harbour;
using rti::testing::Recorder;

constexpr ConnectionId strangers = 3;
const AttributeSet all{rti::testing::position, rti::testing::speed};

void frame(std::vector<std::byte>& into, Bytes payload) {
  const std::vector<std::byte> framed = rti::testing::in_frame(payload);
  into.insert(into.end(), framed.begin(), framed.end());
}

class Scene final : public Outlet {
 public:
  Scene()
      : execution_(harbour(), {.federation = "rink",
                               .filter = "region",
                               .filter_settings = {},
                               .federate_max = 8,
                               .object_max = 64,
                               .objects_per_federate_max = 16,
                               .timeouts = {},
                               .update_rate = {}}) {
    execution_.connect(0);
    witness_.join("rink", "witness", "tester");
    tick();
    witness_.watch_federates();
    for (const ObjectClassHandle each : {rti::testing::vessel, rti::testing::ferry}) {
      witness_.publish_object_class_attributes(each, all);
      witness_.subscribe_object_class_attributes(
          each,
          each == rti::testing::ferry
              ? AttributeSet{rti::testing::position, rti::testing::speed, rti::testing::destination}
              : all);
    }
    witness_.subscribe_interaction_class(rti::testing::hail);
    own_ = witness_.register_object_instance(rti::testing::vessel, "own");
    tick();
    require(witness_.is_joined(), "the witness is joined");
  }

  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts)
      if (connection == 0) require(witness_.receive(part), "the witness understands what it hears");
  }
  void drop(ConnectionId connection, std::string_view) override {
    require(connection != 0, "the witness stays");
    is_connected_[connection] = false;
  }

  void tick() {
    witness_.advance_clock(now_);
    execution_.receive(0, witness_.outgoing());
    witness_.clear_outgoing();
    execution_.advance_clock(now_);
    execution_.match();
    execution_.flush(*this);
  }

  void turn(Input& input) {
    const unsigned first = input.byte();
    const ConnectionId who = 1 + first % strangers;
    switch (first / strangers % 8) {
      case 0:
      case 1:
      case 2:
      case 3:
        return say_frame(who, input);
      case 4:
        return say(who, input.part(input.byte()));
      case 5:
        return enter(who, input.byte());
      case 6:
        return leave(who);
      default:
        return pass(input.byte());
    }
  }

  /// Strangers in whatever state they are, and then in each state that there is, send what is
  /// malformed.
  void refuse() {
    static const std::vector<std::byte> zeros(frame_max_to_rti + 2 * frame_head_max);
    for (ConnectionId who = 1; who <= strangers; ++who)
      if (has(who)) must_drop(who, zeros);
    const auto bytes = [](std::initializer_list<unsigned> values) {
      std::vector<std::byte> all;
      for (const unsigned value : values) all.push_back(static_cast<std::byte>(value));
      return all;
    };
    const std::array malformed{bytes({0, 0, 0, 0}),
                               bytes({1, 0, 0, 0, 255}),
                               bytes({255, 255, 255, 255, 3}),
                               bytes({2, 0, 0, 0, 1, 0x52}),
                               bytes({0, 0}),
                               bytes({1, 0, 255}),
                               bytes({2, 0, 1, 0x52}),
                               bytes({1, 0, 0, 1})};
    for (const bool is_joined : {false, true})
      for (const std::vector<std::byte>& each : malformed) {
        if (is_joined) enter(1, 0);
        else execution_.connect(1), is_connected_[1] = true;
        tick();
        require(is_connected_[1], "who joins by rule is let in");
        must_drop(1, each);
      }
  }

  void end() {
    for (ConnectionId who = 1; who <= strangers; ++who) leave(who);
    tick();
    tick();
    require(execution_.federate_count() == 1, "the strangers are gone");
    require(may_leave_objects_ || execution_.object_count() <= 1, "so are their objects");
    for (const auto& [handle, known] : heard_.objects)
      require(may_leave_objects_ || handle == own_.value, "of which the witness has been told");
    require(heard_.out_of_scope_updates == 0, "updates come in scope");
  }

 private:
  bool has(ConnectionId who) {
    if (!is_connected_[who]) return false;
    return true;
  }
  void must_drop(ConnectionId who, Bytes malformed) {
    execution_.receive(who, malformed);
    tick();
    require(!is_connected_[who], "what is malformed is the last that its sender says");
  }
  void say(ConnectionId who, Bytes bytes) {
    may_leave_objects_ |=
        std::ranges::find(bytes, static_cast<std::byte>(MessageKind::resign_directive)) !=
        bytes.end();
    if (has(who)) execution_.receive(who, bytes);
  }
  void say_frame(ConnectionId who, Input& input) {
    const unsigned size = input.byte();
    spoken_.clear();
    frame(spoken_, input.part(size));
    if (spoken_.size() > frame_head_size(0)) say(who, spoken_);
  }
  /// A join as it should be, which no fuzzer would find.
  void enter(ConnectionId who, unsigned name) {
    if (is_connected_[who]) return;
    is_connected_[who] = true;
    execution_.connect(who);
    const std::string names = "federate " + std::to_string(name % 4);
    JoinMessage join;
    join.fom_hash = harbour().hash();
    join.federation = "rink";
    join.name = names;
    join.type = "stranger";
    std::vector<std::byte> payload;
    write(payload, join);
    spoken_.clear();
    frame(spoken_, payload);
    execution_.receive(who, spoken_);
  }
  void leave(ConnectionId who) {
    if (is_connected_[who]) execution_.disconnect(who, "left");
    is_connected_[who] = false;
  }
  void pass(unsigned eighths) {
    now_ += 0.125 * std::min(eighths, 8u);  // the witness speaks in time
    tick();
  }

  FederationExecution execution_;
  Recorder heard_;
  Ambassador witness_{harbour(), heard_};
  ObjectHandle own_;
  std::array<bool, strangers + 1> is_connected_{};
  bool may_leave_objects_ =
      false;  ///< somebody may have said that his objects outlive him, owned by nobody
  std::vector<std::byte> spoken_;
  double now_ = 0.0;
};

void act(Ambassador& ambassador, unsigned what, std::vector<ObjectHandle>& own) {
  if (!ambassador.is_joined()) return;
  if (what % 4 == 0) {
    ambassador.publish_object_class_attributes(rti::testing::vessel, all);
    own.push_back(ambassador.register_object_instance(rti::testing::vessel));
  } else if (what % 4 == 1 && !own.empty() && own.back()) {
    ambassador.update_attribute_values(own.back(), all, rti::testing::values_of(1.0f, 2.0f, 3.0f),
                                       {0.5, 0});
  } else if (what % 4 == 2 && !own.empty() && own.back()) {
    ambassador.delete_object_instance(own.back());
    own.pop_back();
  } else {
    ambassador.subscribe_object_class_attributes(rti::testing::vessel, all);
  }
}

}  // namespace

void drive_federation(Bytes bytes) {
  Input input(bytes);
  Scene scene;
  while (!input.is_empty()) scene.turn(input);
  scene.end();
}

void refuse_federation(Bytes bytes) {
  Input input(bytes);
  Scene scene;
  while (!input.is_empty()) scene.turn(input);
  scene.refuse();
  scene.end();
}

void refuse_federate(Bytes bytes) {
  const std::vector<std::byte> unknown{std::byte{255}},
      cut{static_cast<std::byte>(MessageKind::discover_object), std::byte{7}};
  std::vector<std::byte> empty, of_nothing, broken, oversized(frame_head_max, std::byte{255});
  frame(empty, {});
  frame(of_nothing, unknown);
  frame(broken, cut);
  for (const std::vector<std::byte>& each : {empty, of_nothing, broken, oversized}) {
    Suspicious heard;
    Ambassador ambassador(harbour(), heard);
    ambassador.join("rink", "fuzzed", "tester");
    std::vector<std::byte> spoken, payload;
    JoinedMessage joined{.federate = 1,
                         .object_block = bytes.empty() ? 0u : static_cast<unsigned>(bytes.front())};
    write(payload, joined);
    frame(spoken, payload);
    require(ambassador.receive(spoken), "a join is understood");
    require(!ambassador.receive(each) && !heard.lost.empty(),
            "a federate does not go on after what the RTI cannot have sent, and says why");
  }
}

void drive_federate(Bytes bytes) {
  Input input(bytes);
  Suspicious heard;
  Ambassador ambassador(harbour(), heard);
  ambassador.join("rink", "fuzzed", "tester");
  std::vector<std::byte> spoken, payload;
  JoinedMessage joined{.federate = 1, .object_block = input.byte()};
  write(payload, joined);
  frame(spoken, payload);
  require(ambassador.receive(spoken), "a join is understood");
  std::vector<ObjectHandle> own;
  while (!input.is_empty()) {
    const unsigned what = input.byte();
    if (what >= 240) {
      act(ambassador, what, own);
      continue;
    }
    spoken.clear();
    if (what >= 200) {
      const Bytes bare = input.part(input.byte());
      spoken.assign(bare.begin(), bare.end());
    } else {
      frame(spoken, input.part(what + 1));
    }
    if (!ambassador.receive(spoken))
      return require(!heard.lost.empty(), "who does not understand says why");
    ambassador.clear_outgoing();
  }
}

}  // namespace rink::fuzz
