// Datagrams that the air loses, doubles, delays, changes and makes up, and who must not suffer from
// them.
#include <algorithm>
#include <deque>
#include <vector>

#include "rti/wire/datagram.h"
#include "tests/fuzz/federation_scene.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/suspicious_federate.h"
#include "tests/rti/rig.h"

namespace rink::fuzz {
namespace {

using namespace rti;
using rti::testing::harbour;

/// A gauge that tells its level by datagrams, and one who watches it; the air between them does
/// what it is told.
class Air final : public Outlet {
 public:
  Air() {
    for (ConnectionId who = 0; who < 2; ++who) {
      execution_.connect(who);
      ambassadors_[who].join("rink", who == 0 ? "gauge" : "watcher", "tester");
    }
    tick();
    ambassadors_[0].publish_object_class_attributes(tide_, level_);
    ambassadors_[1].subscribe_object_class_attributes(tide_, level_);
    object_ = ambassadors_[0].register_object_instance(tide_);
    for (int i = 0; i < 3; ++i) tick();
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts)
      require(ambassadors_[connection].receive(part), "the stream is understood");
  }
  void drop(ConnectionId, std::string_view) override {
    require(false, "datagrams cost nobody the connection");
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return connection == 1 ? 300 : 0;
  }
  void send_datagrams(ConnectionId, std::span<const Datagram> datagrams) override {
    for (const Datagram& each : datagrams) {
      std::vector<std::byte>& whole = flying_.emplace_back(each.head.begin(), each.head.end());
      require(each.head.size() + each.body.size() <= 300,
              "no datagram is longer than its way carries");
      whole.insert(whole.end(), each.body.begin(), each.body.end());
    }
  }
  void tick() {
    now_ += 0.05;
    for (ConnectionId who = 0; who < 2; ++who) {
      Ambassador& ambassador = ambassadors_[who];
      ambassador.advance_clock(now_);
      execution_.receive(who, ambassador.outgoing());
      ambassador.clear_outgoing();
      ambassador.expect_datagrams(1191);
      for (const Datagram& each : ambassador.outgoing_datagrams())
        execution_.receive_datagram(who, each.head);
      ambassador.clear_outgoing_datagrams();
    }
    execution_.advance_clock(now_);
    execution_.match();
    execution_.flush(*this);
  }
  void turn(Input& input) {
    const unsigned what = input.byte();
    switch (what % 8) {
      case 0:
        ambassadors_[0].update_attribute_values(object_, level_, rti::testing::values_of(now_),
                                                {now_, 0});
        return;
      case 1:
        return tick();
      case 2:
        return arrive(what / 8, true);
      case 3:
        return arrive(what / 8, false);
      case 4:
        if (!flying_.empty()) flying_.pop_front();
        return;
      case 5:
        if (std::byte* at = somewhere(input.byte()); at != nullptr)
          *at ^= static_cast<std::byte>(input.byte());
        return;
      case 6:
        return ambassadors_[1].receive_datagram(input.part(input.byte()));
      default:
        return execution_.receive_datagram(what / 8 % 4, input.part(input.byte()));
    }
  }
  /// The first bytes of a datagram are none, and neither is noise.
  void refuse() {
    flying_.clear();
    ambassadors_[0].update_attribute_values(object_, level_, rti::testing::values_of(now_),
                                            {now_, 0});
    tick();
    if (flying_.empty()) return;  // as long as none of the lost ones are acknowledged
    // A head of no number and after no frame, so that what follows is judged at once and each time.
    std::vector<std::byte> whole = flying_.back(), noise(40, std::byte{255});
    std::ranges::fill(std::span(whole).first(DatagramHead::size), std::byte{0});
    std::ranges::fill(std::span(noise).first(DatagramHead::size), std::byte{0});
    const auto hear = [this](Bytes datagram) {
      const auto before = ambassadors_[1].counters();
      ambassadors_[1].receive_datagram(datagram);
      const auto after = ambassadors_[1].counters();
      require(after.updates_reflected == before.updates_reflected,
              "nothing is reflected of what is malformed");
      return after.datagrams_ignored - before.datagrams_ignored;
    };
    require(hear(noise) == 1, "noise is ignored and counted");
    for (std::size_t size = 0; size < DatagramHead::size; ++size)
      require(hear(Bytes(whole).first(size)) == 1, "half a head is ignored and counted");
    require(hear(Bytes(whole).first(DatagramHead::size + 1)) == 1,
            "a message without its content is ignored and counted");
    // A cut behind a whole message leaves a shorter datagram in order.
    for (std::size_t size = DatagramHead::size + 2; size < whole.size(); ++size)
      hear(Bytes(whole).first(size));
  }
  void end() {
    tick();
    require(execution_.federate_count() == 2, "both are there at the end");
  }

 private:
  void arrive(unsigned number, bool is_once) {
    if (flying_.empty()) return;
    const std::size_t at = number % flying_.size();
    ambassadors_[1].receive_datagram(flying_[at]);
    if (is_once) flying_.erase(flying_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::byte* somewhere(unsigned at) {
    return flying_.empty() || flying_.front().empty()
               ? nullptr
               : &flying_.front()[at % flying_.front().size()];
  }

  const ObjectClassHandle tide_ = *harbour().object_class("Tide");
  const AttributeSet level_ = harbour().attributes(tide_);
  FederationExecution execution_{harbour(), {}};
  Suspicious heard_[2];
  Ambassador ambassadors_[2]{{harbour(), heard_[0]}, {harbour(), heard_[1]}};
  ObjectHandle object_;
  std::deque<std::vector<std::byte>> flying_;
  double now_ = 0.0;
};

}  // namespace

void drive_datagrams(Bytes bytes) {
  Input input(bytes);
  Air air;
  while (!input.is_empty()) air.turn(input);
  air.end();
}

void refuse_datagrams(Bytes bytes) {
  Input input(bytes);
  Air air;
  while (!input.is_empty()) air.turn(input);
  air.refuse();
  air.end();
}

}  // namespace rink::fuzz
