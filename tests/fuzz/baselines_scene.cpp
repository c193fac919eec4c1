// Acknowledgements that go astray, and frames that are changed on their way to somebody else.
#include <array>
#include <deque>
#include <map>
#include <memory>

#include "rti/federation_execution.h"
#include "rti/fom/quantised_codec.h"
#include "rti/wire/baseline_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/service_scene.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/fjord.h"

namespace rink::fuzz {

using namespace rti;

namespace {

/// Keeps what it was told of tracks, and when.
struct Lookout : FederateAmbassador {
  struct Seen {
    std::vector<std::byte> track;
    double time = -1.0;
  };
  std::map<std::uint32_t, Seen> seen;
  bool is_lost = false;
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    if (!set.contains(rti::testing::track)) return;
    const Bytes value =
        rti::testing::fjord().value(rti::testing::boat, set, rti::testing::track, values);
    seen[object.value] = {{value.begin(), value.end()}, stamp.time};
  }
  void connection_lost(std::string_view) override { is_lost = true; }
};

/// An owner of boats (0), who watches them (1), and one who hears what the watch hears, changed on
/// its way.
class Sound final : public Outlet {
 public:
  Sound() {
    for (ConnectionId who = 0; who < 2; ++who) execution_.connect(who);
    owner.join("rink", "owner", "tester"), watch.join("rink", "watch", "tester");
    tick();
    owner.publish_object_class_attributes(rti::testing::boat, {rti::testing::track});
    watch.subscribe_object_class_attributes(rti::testing::boat, {rti::testing::track});
    for (ObjectHandle& each : boats) each = owner.register_object_instance(rti::testing::boat);
    tick();
    tick();
  }
  Lookout owner_heard, heard, victim_heard;
  Ambassador owner{rti::testing::fjord(), owner_heard}, watch{rti::testing::fjord(), heard};
  std::array<ObjectHandle, 3> boats;
  std::deque<std::vector<std::byte>> said;  ///< by the watch, on its way
  bool rest_contacts = false;
  unsigned changes = 0, change_at = 0;  ///< of the frame that the third one hears

  void tick() {
    execution_.receive(0, owner.outgoing());
    owner.clear_outgoing();
    if (const Bytes bytes = watch.outgoing(); !bytes.empty())
      said.emplace_back(bytes.begin(), bytes.end());
    watch.clear_outgoing();
    for (; !rest_contacts && !said.empty(); said.pop_front()) execution_.receive(1, said.front());
    execution_.match();
    execution_.flush(*this);
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    std::vector<std::byte> frame;
    for (const Bytes part : parts) frame.insert(frame.end(), part.begin(), part.end());
    require((connection == 0 ? owner : watch).receive(frame), "what the RTI says is understood");
    if (connection == 1 && boats[2]) hear(frame);
  }
  void drop(ConnectionId connection, std::string_view) override {
    require(is_malformed && connection == 1, "acknowledgements cost nobody the connection");
    is_dropped = true;
  }
  bool is_malformed = false, is_dropped = false;  ///< what the watch says; the watch

 private:
  void hear(std::vector<std::byte> frame) {
    if (!victim_ || !victim_->is_joined()) {
      victim_ = std::make_unique<Ambassador>(rti::testing::fjord(), victim_heard);
      victim_->join("rink", "victim", "tester");
      victim_->receive(framed(JoinedMessage{7, 99}));
      for (const ObjectHandle each : boats) {
        victim_->receive(framed(DiscoverObjectMessage{
            each.value, static_cast<std::uint16_t>(rti::testing::boat.value), "boat"}));
        victim_->receive(framed(rti::testing::OneObject<MessageKind::in_scope>{each.value}));
      }
    }
    const std::size_t head = frame_head_size(0);
    if (changes != 0 && frame.size() > head)
      frame[head + change_at % (frame.size() - head)] ^= static_cast<std::byte>(changes);
    victim_->receive(frame);
    victim_->clear_outgoing();
  }

  FederationExecution execution_{rti::testing::fjord(), {}};
  std::unique_ptr<Ambassador> victim_;
};

std::vector<std::byte> track_of(double x, double y, float speed_x, float speed_y) {
  std::vector<std::byte> bytes = rti::testing::values_of(x, y);
  for (const float each : {speed_x, speed_y}) {
    const std::vector<std::byte> one = rti::testing::values_of(each);
    for (std::size_t i = one.size(); i-- > 0;) bytes.push_back(one[i]);  // big-endian
  }
  return bytes;
}

std::vector<std::byte> rounded(const std::vector<std::byte>& value) {
  const AttributeCodec& codec =
      *rti::testing::fjord().at(rti::testing::boat).attributes[rti::testing::track.value].codec;
  std::vector<std::byte> coded, decoded;
  codec.encode(value, 0.0, coded);
  require(codec.decode(coded, 0.0, decoded), "what was coded is decoded");
  return decoded;
}

}  // namespace

/// Acknowledgements that break off or carry too much, from a watch that hears periodic state.
void refuse_baselines(Bytes bytes) {
  for (const bool is_cut : {true, false}) {
    Sound sound;
    Input input(bytes);
    for (int i = 0; i < 3; ++i) {
      sound.owner.update_attribute_values(sound.boats[0], AttributeSet{rti::testing::track},
                                          track_of(input.byte(), input.byte(), 1.0f, 2.0f),
                                          {0.1 * i, 0});
      sound.tick();
    }
    std::vector<std::byte> said;
    AcknowledgeKeyframeMessage message{static_cast<std::uint16_t>(input.byte())};
    write(said, message);
    if (is_cut) said.pop_back();
    else said.push_back(std::byte{255});
    sound.said.push_back(rti::testing::in_frame(said));
    sound.is_malformed = true;
    sound.tick();
    require(sound.is_dropped, "an acknowledgement that is none is the last that its sender says");
  }
}

void drive_baselines(Bytes bytes) {
  Input input(bytes);
  Sound sound;
  double now = 0.0;
  while (!input.is_empty()) {
    const unsigned what = input.byte(), fate = what / 8 % 8;
    now += 0.0625 * (1 + what % 4);
    std::array<std::vector<std::byte>, 3> said;
    for (std::size_t i = 0; i < said.size(); ++i) {
      if ((what >> i & 1u) == 0) continue;
      const double x = 4.0 * input.byte(),
                   y = 0.5 * input.byte() - 600.0;  // out of the range at times
      const float speed = static_cast<float>(input.byte()) / 4.0f - 31.0f;
      said[i] = track_of(x, y, speed, -speed);
      sound.owner.update_attribute_values(sound.boats[i], AttributeSet{rti::testing::track},
                                          said[i], {now, 0});
    }
    if (fate == 1) {  // made up
      const auto number = static_cast<std::uint16_t>(input.byte());
      std::vector<std::byte> made_up;
      AcknowledgeKeyframeMessage acknowledgement{number};
      RefuseKeyframeMessage refusal{number};
      if (input.byte() % 2 == 0) write(made_up, acknowledgement);
      else write(made_up, refusal);
      sound.said.push_back(rti::testing::in_frame(made_up));
    }
    sound.rest_contacts = fate == 2;
    if (fate == 3) sound.watch.clear_outgoing();  // forgotten
    if (fate == 4 && !sound.said.empty()) sound.said.push_back(sound.said.back());
    sound.changes = fate > 5 ? input.byte() : 0;
    sound.change_at = sound.changes != 0 ? input.byte() : 0;
    sound.tick();
    require(!sound.heard.is_lost, "nobody is lost by acknowledgements");
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said[i].empty()) continue;
      const auto seen = sound.heard.seen.find(sound.boats[i].value);
      require(seen != sound.heard.seen.end() && seen->second.time == now &&
                  seen->second.track == rounded(said[i]),
              "what is heard is the quantised truth");
    }
  }
}

}  // namespace rink::fuzz
