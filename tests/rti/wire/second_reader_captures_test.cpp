// What the second reader makes of sessions with an admission, with baselines and with datagrams:
// captured as they travelled, read by docs/wire.md alone.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "rti/admission/handshake.h"
#include "tests/places.h"
#include "tests/rti/python.h"
#include "tests/rti/scenes/fjord_traffic.h"
#include "tests/rti/scenes/tides.h"
#include "tests/rti/seeded.h"
#include "tests/rti/transport/udp_relay.h"
#include "tests/rti/wire/second_reader_session.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

/// The lines that the second reader prints.
std::vector<std::string> read_by_python(const std::string& model, const std::string& record,
                                        std::string_view key = {}) {
  const test::TemporaryFolder folder("second-reader");
  const std::string base = std::filesystem::path(folder).string();
  std::ofstream(base + "/model.xml") << model;
  std::ofstream(base + "/session", std::ios::binary) << record;
  std::ofstream(base + "/key", std::ios::binary) << key;
  const std::string reader = test::source_folder() + "/tests/rti/wire/second_reader.py";
  std::istringstream text(output_of("python3 -B '" + reader + "' '" + base + "/model.xml' '" +
                                    base + "/session' " +
                                    (key.empty() ? "" : "'" + base + "/key'") + " 2>&1"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Those that begin so, without their beginning.
std::vector<std::string> after(const std::vector<std::string>& lines,
                               const std::string& beginning) {
  std::vector<std::string> found;
  for (const std::string& line : lines)
    if (line.starts_with(beginning)) found.push_back(line.substr(beginning.size()));
  return found;
}

void keep(std::string& record, char direction, std::uint32_t connection, Bytes bytes) {
  record += direction;
  record += text_of(values_of(connection, static_cast<std::uint32_t>(bytes.size())));
  record += text_of(bytes);
}

/// What both ends said: the admission, then, if it succeeds, that one joins, sealed.
std::string admission_with(const SharedKey& federates, const SharedKey& rtis) {
  Handshake federate(federates, Role::federate, "rink", nonce_of(1)),
      rti(rtis, Role::rti, "rink", nonce_of(2));
  std::string record;
  const auto carry = [&record](Handshake& from, Handshake& to, char direction) {
    keep(record, direction, 0, from.outgoing());
    Bytes left = from.outgoing();
    to.receive(left);
    from.clear_outgoing();
  };
  for (int i = 0; i < 2; ++i) carry(federate, rti, 'u'), carry(rti, federate, 'd');
  Recorder heard;
  Ambassador ambassador(harbour(), heard);
  ambassador.join("rink", "pilot", "clerk");
  if (federate.state() != Handshake::State::proven) return record;
  Seal seal(federate.session_key(Role::federate));
  const Bytes said = ambassador.outgoing();
  FrameWriter sealed(seal_record_max);
  seal.seal(std::span(&said, 1), sealed);
  keep(record, 'u', 0, sealed.bytes());
  return record;
}

TEST(SecondReaderCaptures, OpensAndVerifiesWhatBothEndsOfAnAdmissionProve) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  constexpr std::string_view secret = "the harbour's own secret",
                             other = "a secret of somebody else";
  const SharedKey key(std::as_bytes(std::span(secret))), wrong(std::as_bytes(std::span(other)));
  const std::string joins = "0u join version " + std::to_string(protocol_version) + " model " +
                            hex(harbour().hash()) + " rink pilot clerk";
  const std::string hello = "0u hello version " + std::to_string(protocol_version) + " rink";
  const std::vector<std::string> proven{"0d challenge", "0d admitted good", hello, "0u proof good",
                                        joins};
  EXPECT_EQ(read_by_python(harbour_xml, admission_with(key, key), std::string(secret) + " \n"),
            proven)
      << "white space at the key file's end is none of the key";
  const std::vector<std::string> refused{"0d challenge", "0d refused 7 wrong key", hello,
                                         "0u proof bad"};
  EXPECT_EQ(read_by_python(harbour_xml, admission_with(wrong, key), secret), refused);
}

/// Writes down what it is told of boats and beacons.
struct FjordClerk final : FederateAmbassador {
  Ambassador ambassador{fjord(), *this};
  std::vector<std::string> heard;
  std::map<std::uint32_t, ObjectClassHandle> classes;
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view) override {
    classes[object.value] = object_class;
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    const ObjectClass& known = fjord().at(classes.at(object.value));
    std::string names;
    set.for_each([&](AttributeHandle each) {
      names += (names.empty() ? "" : "+") + known.attributes[each.value].name;
    });
    heard.push_back(line_of(object.value, known.name, names, stamp_text(stamp), hex(values)));
  }
};

TEST(SecondReaderCaptures, FollowsDifferencesToAcknowledgedBaselines) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  struct Shores final : Outlet {
    FederationExecution execution{fjord(), {}};
    FjordClerk clerks[2];
    std::string record;
    bool loses_answers = false;
    void send(ConnectionId connection, std::span<const Bytes> parts) override {
      for (const Bytes part : parts) {
        keep(record, 'd', connection, part);
        EXPECT_TRUE(clerks[connection].ambassador.receive(part));
      }
    }
    void drop(ConnectionId, std::string_view) override { ADD_FAILURE(); }
    void tick() {
      for (ConnectionId id = 0; id < 2; ++id) {
        const Bytes bytes = clerks[id].ambassador.outgoing();
        if (id == 1 && loses_answers) continue;  // they wait for better days
        keep(record, 'u', id, bytes);
        execution.receive(id, bytes);
        clerks[id].ambassador.clear_outgoing();
      }
      execution.match();
      execution.flush(*this);
    }
  } shores;
  Ambassador &pilot = shores.clerks[0].ambassador, &watch = shores.clerks[1].ambassador;
  shores.execution.connect(0), shores.execution.connect(1);
  pilot.join("rink", "pilot", "clerk"), watch.join("rink", "watch", "clerk");
  shores.tick();
  pilot.publish_object_class_attributes(boat, AttributeSet{track, cargo});
  pilot.publish_object_class_attributes(beacon, AttributeSet{light, depth});
  watch.subscribe_object_class_attributes(boat, AttributeSet{track, cargo});
  watch.subscribe_object_class_attributes(beacon, AttributeSet{light, depth});
  shores.tick();
  std::vector<ObjectHandle> fleet;
  const ObjectHandle lamp = pilot.register_object_instance(beacon);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> push(-0.5f, 0.5f);
  std::vector<std::array<double, 4>> states;
  for (int step = 0; step < 60; ++step) {
    const double now = step / 16.0;
    if (step % 5 == 0 && fleet.size() < 9)
      fleet.push_back(pilot.register_object_instance(boat)),
          states.push_back({10.0 * step, 300.0, 5.0, -3.0});
    for (std::size_t i = 0; i < fleet.size(); ++i) {
      auto& [x, y, u, v] = states[i];
      u += push(random);
      v += push(random);
      x += u / 16.0, y += v / 16.0;
      const double out = i == 3 && step % 7 == 0 ? 1e6 : 0.0;  // of its range: it travels in full
      pilot.update_attribute_values(
          fleet[i], AttributeSet{track},
          track_of(x + out, y, static_cast<float>(u), static_cast<float>(v)), {now, 0});
    }
    if (step % 9 == 0)
      pilot.update_attribute_values(lamp, AttributeSet{depth},
                                    values_of(static_cast<std::int16_t>(-step)), {now, 1});
    if (step == 30)
      pilot.delete_object_instance(fleet[1]), fleet.erase(fleet.begin() + 1),
          states.erase(states.begin() + 1);
    shores.loses_answers = step > 40 && step < 47;
    shores.tick();
  }
  const std::vector<std::string> lines = read_by_python(fjord_xml, shores.record);
  EXPECT_EQ(after(lines, "1d reflect "), shores.clerks[1].heard);
  EXPECT_GT(shores.clerks[1].heard.size(), 350u);
  EXPECT_GT(shores.execution.baseline_counters().differences_sent, 200u);
  EXPECT_EQ(after(lines, "1u acknowledge_keyframe ").size(),
            shores.execution.baseline_counters().acknowledged +
                shores.execution.baseline_counters().acknowledgements_ignored);
  EXPECT_TRUE(after(lines, "failed").empty() && after(lines, "Traceback").empty()) << lines.back();
}

/// A gauge's owner and who reads it, each behind a relay that loses every fifth datagram of values.
TEST(SecondReaderCaptures, ReadsEveryDatagramAndItsAcknowledgement) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  Tides tides;
  std::string record;
  int data = 0, lost = 0;
  const auto is_lost = [&](bool, Bytes datagram) {
    const bool is_data = datagram[8] == std::byte{0} && datagram.size() > 40;
    const bool is_unlucky = is_data && ++data % 5 == 0;
    lost += is_unlucky ? 1 : 0;
    return is_unlucky;
  };
  UdpRelay relays[2] = {{tides.port, 0, record, is_lost}, {tides.port, 1, record, is_lost}};
  const auto start = std::chrono::steady_clock::now();
  const auto pump = [&] {
    for (UdpRelay& relay : relays) relay.pump();
  };
  const auto round = [&] {
    tides.now = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    tides.links.flush(tides.now);
    pump();
    tides.serve();
    pump();
    tides.clients.poll(200us, tides.links);
  };
  const auto pass = [&](std::chrono::milliseconds time) {
    for (const auto from = std::chrono::steady_clock::now();
         std::chrono::steady_clock::now() - from < time;)
      round();
  };
  for (const UdpRelay& relay : relays) tides.join(relay.port());
  ASSERT_NO_FATAL_FAILURE(tides.open_ways(round));
  pass(20ms);
  std::vector<ObjectHandle> gauges;
  for (int i = 0; i < 12; ++i)
    gauges.push_back(tides.stations[0].ambassador.register_object_instance(tides.tide));
  for (int tick = 0; tick < 40; ++tick) {
    for (const ObjectHandle gauge : gauges)
      tides.set(gauge, tick + 0.001 * gauge.value, 0.125 * tick);
    pass(5ms);
  }
  pass(700ms);  // repaired and acknowledged
  EXPECT_GE(lost, 5);
  const std::vector<std::string> lines = read_by_python(harbour_xml, record);
  ASSERT_FALSE(lines.empty());
  // Whatever was heard, the second reader has read too; and all have the last value in the end.
  for (const ObjectHandle gauge : gauges) {
    ASSERT_TRUE(tides.stations[1].heard.objects.contains(gauge.value));
    EXPECT_EQ(tides.stations[1].heard.objects.at(gauge.value).values.at(0),
              values_of(39 + 0.001 * gauge.value));
    const std::string last = line_of(gauge.value, "Tide", "level", stamp_text({0.125 * 39, 0}),
                                     hex(values_of(39 + 0.001 * gauge.value)));
    const auto read = after(lines, "1D reflect "), streamed = after(lines, "1d reflect ");
    EXPECT_TRUE(std::ranges::count(read, last) + std::ranges::count(streamed, last) > 0)
        << last << "\n"
        << lines.back();
    EXPECT_GT(std::ranges::count(after(lines, "0U update "), last), 0) << last;
  }
  EXPECT_EQ(after(lines, "1d greets back").size(), 1u);
  // The owner's own on their way up, and what its reader is told on their way down.
  for (const auto& [beginning, lost_lines] :
       {std::pair{"0 up: ", "0X lost"}, std::pair{"1 down: ", "1Y lost"}}) {
    const auto summary = after(lines, beginning);
    ASSERT_EQ(summary.size(), 1u) << lines.back();
    int numbered = 0, arrived = 0, acknowledged = 0;
    ASSERT_EQ(std::sscanf(summary[0].c_str(), "%d numbered, %d arrived, %d acknowledged", &numbered,
                          &arrived, &acknowledged),
              3);
    EXPECT_GT(numbered, 20) << beginning;
    EXPECT_EQ(arrived, acknowledged) << beginning;
    EXPECT_EQ(static_cast<int>(after(lines, lost_lines).size()), numbered - arrived) << beginning;
  }
}

}  // namespace
}  // namespace rink::rti::testing
