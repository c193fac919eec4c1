// What a reader in another language, written from docs/wire.md, makes of the shipped model: its
// hash, its digest, and every value of a recorded session.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "game/replication/attributes.h"
#include "game/replication/object_model.h"
#include "game/replication/trajectory.h"
#include "game/replication/trajectory_codec.h"
#include "game/replication/trajectory_residual.h"
#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/fom/fom_digest.h"
#include "rti/wire/message.h"
#include "tests/places.h"
#include "tests/rti/python.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

std::string model_path() { return test::source_folder() + "/game/net/rink.fom.xml"; }

const rti::Fom& model() {
  static const rti::Fom fom = load_rink_fom(model_path());
  return fom;
}

std::string hex(rti::Bytes bytes) {
  std::string text;
  for (const std::byte each : bytes)
    for (const unsigned half :
         {std::to_integer<unsigned>(each) >> 4, std::to_integer<unsigned>(each) & 15u})
      text += "0123456789abcdef"[half];
  return text.empty() ? "-" : text;
}

std::string hex(std::uint64_t number) {
  std::array<std::byte, 8> bytes;
  for (unsigned k = 0; k < 8; ++k) bytes[k] = static_cast<std::byte>(number >> (56 - 8 * k));
  return hex(rti::Bytes(bytes));
}

/// A federate that writes down each value that it is told, in the second reader's words.
struct Scribe final : rti::FederateAmbassador {
  explicit Scribe(const rti::Fom& fom) : ambassador(fom, *this) {}
  rti::Ambassador ambassador;
  std::vector<std::string> reflected;
  std::map<std::uint32_t, rti::ObjectClassHandle> classes;
  void discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                std::string_view) override {
    classes[object.value] = object_class;
  }
  void reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet set, rti::Bytes values,
                                const rti::Stamp& stamp) override {
    const rti::ObjectClass& known = model().at(classes.at(object.value));
    std::ostringstream line;
    line << "1d reflect " << object.value << " " << known.name << " ";
    bool is_first = true;
    set.for_each([&](rti::AttributeHandle each) {
      line << (std::exchange(is_first, false) ? "" : "+") << known.attributes[each.value].name;
    });
    line << " " << hex(std::bit_cast<std::uint64_t>(stamp.time)) << " " << stamp.tag << " "
         << hex(values);
    reflected.push_back(line.str());
  }
};

/// Federates of the shipped model or another one, their RTI, and every byte between them.
struct RecordedSession final : rti::Outlet {
  rti::FederationExecution execution{model(), {}};
  std::deque<Scribe> scribes;
  std::string record;
  Scribe& enter(const rti::Fom& fom) {
    const auto number = static_cast<rti::ConnectionId>(scribes.size());
    Scribe& scribe = scribes.emplace_back(fom);
    execution.connect(number);
    scribe.ambassador.join("rink", "scribe " + std::to_string(number), "");
    return scribe;
  }
  void keep(char direction, rti::ConnectionId connection, rti::Bytes bytes) {
    std::vector<std::byte> head;
    rti::Writer writer(head);
    auto size = static_cast<std::uint32_t>(bytes.size());
    writer.number(connection), writer.number(size);
    record += direction;
    for (const rti::Bytes part : {rti::Bytes(head), bytes})
      record.append(reinterpret_cast<const char*>(part.data()), part.size());
  }
  void send(rti::ConnectionId connection, std::span<const rti::Bytes> parts) override {
    for (const rti::Bytes part : parts)
      keep('d', connection, part), scribes[connection].ambassador.receive(part);
  }
  void drop(rti::ConnectionId, std::string_view) override {}
  void tick() {
    for (rti::ConnectionId id = 0; id < scribes.size(); ++id) {
      const rti::Bytes bytes = scribes[id].ambassador.outgoing();
      keep('u', id, bytes);
      execution.receive(id, bytes);
      scribes[id].ambassador.clear_outgoing();
    }
    execution.match();
    execution.flush(*this);
  }
  /// The lines that the second reader prints.
  std::vector<std::string> read_by_python() const {
    const test::TemporaryFolder folder("second-reader-of-rink");
    const std::string session = (std::filesystem::path(folder) / "session").string();
    std::ofstream(session, std::ios::binary) << record;
    std::istringstream text(rti::testing::output_of("python3 -B '" + test::source_folder() +
                                                    "/tests/rti/wire/second_reader.py' '" +
                                                    model_path() + "' '" + session + "' 2>&1"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

std::vector<std::string> beginning_with(const std::vector<std::string>& lines,
                                        const std::string& beginning) {
  std::vector<std::string> found;
  std::ranges::copy_if(lines, std::back_inserter(found),
                       [&](const std::string& line) { return line.starts_with(beginning); });
  return found;
}

/// Of form `kind`: at rest, near, wide, driven with half a float and a whole one, with drags of its
/// own, in full.
Trajectory trajectory_of(int kind, double now, std::mt19937_64& random) {
  const auto on_grid = [&](double low, double high) {
    return std::floor(std::uniform_real_distribution<double>(low, high)(random) * 2048.0) / 2048.0;
  };
  Trajectory t{.time = std::floor(now * 16.0) / 16.0,
               .position = {on_grid(-1.0, 62.0), on_grid(-1.0, 62.0)},
               .velocity = {on_grid(-3.9, 3.9), on_grid(-3.9, 3.9)}};
  if (kind == 0) return {.position = t.position};
  if (kind == 2 || kind >= 5)
    t.position = {on_grid(-4000.0, 4000.0), on_grid(-4000.0, 4000.0)},
    t.velocity = {on_grid(-250.0, 250.0), on_grid(-250.0, 250.0)};
  if (kind == 3) t.acceleration = {2.5, -2.5};
  if (kind == 4) t.acceleration = {0.0, static_cast<double>(-1.2345f)};
  if (kind == 5)
    t.acceleration = {static_cast<double>(0.1f), 3.0}, t.drag = {0.1, Trajectory::of_its_kind};
  if (kind == 6) t.acceleration = {0.1, 1e-9}, t.drag = {0.25, 1.0 / 3.0};
  return t;
}

/// One that stays near its place, so that it travels as a residual to the one before.
Trajectory lingering(int kind, double now, std::mt19937_64& random) {
  const auto step = [&random] { return static_cast<double>(random() % 512) / 2048.0 - 0.125; };
  const double time = std::floor(now * 1024.0 - static_cast<double>(random() % 16)) / 1024.0;
  Trajectory t{
      .time = std::max(time, 0.0), .position = {5.0 + step(), 6.0}, .velocity = {step(), step()}};
  if (kind == 0) return {.position = t.position};
  if (kind >= 3) t.acceleration = {kind >= 5 ? 2.5 : 0.0, -2.5};
  return t;
}

/// Two bodies that hit each other before every tick.
struct Collisions {
  Trajectory one{.position = {1.0, 2.0}, .velocity = {0.5, 0.0}},
      other{.position = {1.2, 2.0}, .velocity = {-0.25, 0.0}};
  static Shape shape(float mass) {
    return {.half_length = 0.1f, .half_width = 0.1f, .drag = 0.25f, .mass = mass};
  }
  void next(double now, std::mt19937_64& random) {
    const double instant = std::floor(now * 1024.0 - static_cast<double>(random() % 16)) / 1024.0;
    const auto rounded = [](const physics::Vector2& value) {
      return physics::Vector2(std::nearbyint(value.x() * 2048.0) / 2048.0 + 0.0,
                              std::nearbyint(value.y() * 2048.0) / 2048.0 + 0.0);
    };
    const Lead led = lead_of(one, shape(0.5f), instant),
               lead = lead_of(other, shape(0.2f), instant);
    const physics::Vector2 gain{static_cast<double>(random() % 1024) / 2048.0 - 0.25, 0.125};
    const double ratio = static_cast<double>(0.5f) / static_cast<double>(0.2f);
    one = {.time = instant,
           .position = rounded(led.position),
           .velocity = rounded(led.velocity + gain)};
    other = {.time = instant,
             .position = rounded(lead.position),
             .velocity = rounded(lead.velocity + ratio * (led.velocity - one.velocity))};
  }
};

TEST(SecondReaderOfTheShippedModel, DecodesTrajectoriesInputsAndAllElseOfAnEntityByTheWirePage) {
  if (!rti::testing::has_python()) GTEST_SKIP() << "there is no python3";
  const ObjectModel names(model());
  const rti::AttributeSet on_event{names.input, names.trajectory}, periodic{names.position},
      snapshot{names.snapshot}, first{names.shape, names.input, names.trajectory};
  RecordedSession session;
  rti::Ambassador &rink = session.enter(model()).ambassador,
                  &bats = session.enter(model()).ambassador;
  session.tick();
  rti::AttributeSet all = first;
  all.insert(names.position), all.insert(names.snapshot);
  rink.publish_object_class_attributes(names.entity, all);
  bats.subscribe_object_class_attributes(names.entity, all);
  rink.publish_object_class_attributes(names.match, {names.match_state});
  bats.subscribe_object_class_attributes(names.match, {names.match_state});
  session.tick();
  std::mt19937_64 random(11);
  std::vector<rti::ObjectHandle> entities;
  std::vector<std::byte> buffer;
  std::uint32_t count = 0;
  const auto input_of = [&](std::uint32_t k) {
    return Input{.count = k % 3 == 0 ? k : count, .held = static_cast<std::uint8_t>(k % 16)};
  };
  const rti::ObjectHandle match = rink.register_object_instance(names.match),
                          one = rink.register_object_instance(names.entity),
                          other = rink.register_object_instance(names.entity);
  Collisions collisions;
  for (std::uint32_t tick = 0; tick < 64; ++tick) {
    const rti::Stamp stamp{0.3 * tick, tick};
    const int kind = static_cast<int>(tick % 7);
    count = tick % 5 == 0 ? 0xffffffffu : count * 7 + 11;
    if (tick < 14) {
      entities.push_back(rink.register_object_instance(names.entity));
      rink.update_attribute_values(entities.back(), first,
                                   encode(buffer,
                                          Shape{.kind = 1,
                                                .team = 2,
                                                .half_length = 0.1f,
                                                .half_width = 0.2f,
                                                .drag = tick % 2 == 0 ? 0.25f : 0.0f,
                                                .friction = tick % 4 < 2 ? 0.0f : 0.4f,
                                                .thrust = 2.5f,
                                                .mass = tick % 3 == 0 ? 0.5f : 0.2f},
                                          input_of(tick), trajectory_of(kind, stamp.time, random)),
                                   stamp);
    }
    for (const rti::ObjectHandle each : entities) {
      if (each.value % 2 == 0)
        rink.update_attribute_values(
            each, on_event, encode(buffer, input_of(tick), trajectory_of(kind, stamp.time, random)),
            stamp);
      else
        rink.update_attribute_values(each, {names.trajectory},
                                     encode(buffer, lingering(kind, stamp.time, random)), stamp);
      rink.update_attribute_values(
          each, periodic, encode(buffer, Position{0.5f * static_cast<float>(tick), 3.0f}), stamp);
      const double x = each.value == entities.front().value
                           ? 5000.0
                           : 0.1 * tick;  // of its range: it travels in full
      rink.update_attribute_values(
          each, snapshot,
          encode(buffer, Snapshot{.position = {x, 2.0}, .velocity = {0.3, -0.001 * tick}}), stamp);
    }
    if (tick == 0) {
      for (const auto& [each, mass] : {std::pair(one, 0.5f), std::pair(other, 0.2f)})
        rink.update_attribute_values(each, first,
                                     encode(buffer, Collisions::shape(mass), Input{},
                                            each == one ? collisions.one : collisions.other),
                                     stamp);
    } else {
      collisions.next(stamp.time, random);
      rink.update_attribute_values(one, {names.trajectory}, encode(buffer, collisions.one), stamp);
      rink.update_attribute_values(other, {names.trajectory}, encode(buffer, collisions.other),
                                   stamp);
    }
    MatchState state;
    state.number = tick, state.until_s = 0.7 * tick;
    rink.update_attribute_values(match, {names.match_state}, encode(buffer, state), stamp);
    session.tick();
  }
  const std::vector<std::string> lines = session.read_by_python();
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(beginning_with(lines, "1d reflect "), session.scribes[1].reflected) << lines.back();
  EXPECT_GT(session.scribes[1].reflected.size(), 64u * 14);
  EXPECT_GT(session.execution.baseline_counters().differences_sent, 100u);
  EXPECT_GT(session.execution.counters().residuals_sent, 300u);
  EXPECT_GT(session.execution.counters().companions_sent, 50u);
}

TEST(SecondReaderOfTheShippedModel, FindsItsHashByTheWirePage) {
  if (!rti::testing::has_python()) GTEST_SKIP() << "there is no python3";
  RecordedSession session;
  session.enter(model());
  session.tick();
  const std::string joins = "0u join version " + std::to_string(rti::protocol_version) + " model " +
                            hex(model().hash()) + " rink scribe 0 -";
  EXPECT_EQ(beginning_with(session.read_by_python(), "0u "), std::vector{joins});
}

TEST(SecondReaderOfTheShippedModel, FindsTheDigestThatARefusedFederateIsSent) {
  if (!rti::testing::has_python()) GTEST_SKIP() << "there is no python3";
  const rti::Fom without_codecs = rti::Fom::load(model_path());
  RecordedSession session;
  session.enter(without_codecs);
  session.tick();
  const std::vector<std::string> lines = session.read_by_python();
  EXPECT_EQ(beginning_with(lines, "0d digest of "),
            std::vector{"0d digest of " + std::to_string(rti::digest(model()).size()) +
                        " elements of this model"})
      << lines.back();
  EXPECT_EQ(beginning_with(lines, "0d refused 2 ").size(), 1u);
}

/// The number that the page itself names, and the one in the text of the line of its snapshots.
TEST(SecondReaderOfTheShippedModel, PageNamesTheHashAndTheCodecs) {
  std::ostringstream page;
  page << std::ifstream(test::source_folder() + "/docs/wire.md").rdbuf();
  const ObjectModel names(model());
  const auto& attributes = model().at(names.entity).attributes;
  for (const std::string& words :
       {hex(model().hash()) + " in hexadecimal",
        "codec Snapshot " + attributes[names.snapshot.value].codec->name(),
        "codec Trajectory " + attributes[names.trajectory.value].codec->name(),
        "codec Input " + attributes[names.input.value].codec->name()})
    EXPECT_NE(page.str().find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace rink::game
