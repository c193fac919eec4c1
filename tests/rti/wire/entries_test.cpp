// Objects that come into scope with their values: one record each, of what the federate lacks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/wire/entry_block.h"
#include "tests/rti/bare.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;

/// Records its callbacks in their order.
struct Listener final : FederateAmbassador {
  std::vector<std::string> heard;
  Ambassador ambassador{harbour(), *this};
  Listener() {
    ambassador.join("rink", "listener", "tester");
    const auto joined = frame_of(JoinedMessage{4, 2});
    EXPECT_TRUE(ambassador.receive(joined));
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle, std::string_view) override {
    heard.push_back("discover " + std::to_string(object.value - object_block));
  }
  void attributes_in_scope(ObjectHandle object) override {
    heard.push_back("in scope " + std::to_string(object.value - object_block));
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp&) override {
    std::string text = "reflect " + std::to_string(object.value - object_block);
    for (const AttributeHandle each : set) {
      const Bytes value = harbour().value(vessel, set, each, values);
      float first = 0.0f;
      std::memcpy(&first, value.data(), sizeof first);
      text += " " + std::to_string(static_cast<int>(first));
    }
    heard.push_back(text);
  }
};

constexpr std::uint32_t first = object_block;
const AttributeSet both{position, speed};

void append(std::vector<std::byte>& bytes, const std::vector<std::byte>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

/// A frame with a stamp and the blocks that `write` appends to its payload.
template <class Write>
std::vector<std::byte> entries(Write write) {
  std::vector<std::byte> payload;
  StampMessage stamp{{1.0, 0}};
  rti::write(payload, stamp);
  write(payload);
  FrameWriter frame(frame_max_to_federate);
  append(frame.begin_message(payload.size()), payload);
  frame.appended();
  return {frame.bytes().begin(), frame.bytes().end()};
}

EntriesMessage header(AttributeSet attributes, AttributeSet repeated = {},
                      AttributeSet recalled = {}) {
  return {static_cast<std::uint16_t>(vessel.value), attributes.bits, repeated.bits, recalled.bits};
}

TEST(Entries, AreDiscoveredComeIntoScopeAndAreReflectedInThisOrder) {
  Listener listener;
  const auto bytes = entries([](std::vector<std::byte>& payload) {
    EntryHeader last;
    EntriesBlock block(payload, last);
    block.append(header(both), first + 7, EntryForm::discovered,
                 [&] { append(payload, values_of(3.0f, 4.0f, 5.0f)); });
    block.append(header(both), first + 5, EntryForm::discovered,
                 [&] { append(payload, values_of(6.0f, 7.0f, 8.0f)); });
  });
  ASSERT_TRUE(listener.ambassador.receive(bytes));
  EXPECT_THAT(listener.heard, ElementsAre("discover 7", "in scope 7", "reflect 7 3 5", "discover 5",
                                          "in scope 5", "reflect 5 6 8"));
}

TEST(Entries, RepeatTheValueThatAnEntryOfTheClassBroughtLast) {
  Listener listener;
  const auto bytes = entries([](std::vector<std::byte>& payload) {
    EntryHeader last;
    EntriesBlock block(payload, last);
    block.append(header(both), first + 1, EntryForm::discovered,
                 [&] { append(payload, values_of(1.0f, 2.0f, 9.0f)); });
    block.append(header(both, {speed}), first + 2, EntryForm::discovered,
                 [&] { append(payload, values_of(3.0f, 4.0f)); });
    block.append(header(both, {speed}), first + 3, EntryForm::discovered,
                 [&] { append(payload, values_of(5.0f, 6.0f)); });
    block.append(header(both, both), first + 4, EntryForm::discovered, [] {});
  });
  ASSERT_TRUE(listener.ambassador.receive(bytes));
  EXPECT_THAT(listener.heard,
              ElementsAre("discover 1", "in scope 1", "reflect 1 1 9", "discover 2", "in scope 2",
                          "reflect 2 3 9", "discover 3", "in scope 3", "reflect 3 5 9",
                          "discover 4", "in scope 4", "reflect 4 5 9"));
}

/// A record whose speed is the value of that number.
std::vector<std::byte> recalling(float place, std::uint8_t number) {
  return values_of(place, 0.0f, number);
}

TEST(Entries, RecallOneOfTheLastFourValues) {
  Listener listener;
  const auto bytes = entries([](std::vector<std::byte>& payload) {
    EntryHeader last;
    EntriesBlock block(payload, last);
    for (std::uint32_t k = 1; k <= 5; ++k)
      block.append(header(both), first + k, EntryForm::discovered,
                   [&] { append(payload, values_of(0.0f, 0.0f, static_cast<float>(k))); });
    // The order is 5 4 3 2, then 2 5 4 3, then 5 2 4 3, which the last one repeats.
    block.append(header(both, {}, {speed}), first + 6, EntryForm::discovered,
                 [&] { append(payload, recalling(6.0f, 3)); });
    block.append(header(both, {}, {speed}), first + 7, EntryForm::discovered,
                 [&] { append(payload, recalling(7.0f, 1)); });
    block.append(header(both, {}, {speed}), first + 8, EntryForm::discovered,
                 [&] { append(payload, recalling(8.0f, 3)); });
    block.append(header(both, {speed}), first + 9, EntryForm::discovered,
                 [&] { append(payload, values_of(9.0f, 0.0f)); });
  });
  ASSERT_TRUE(listener.ambassador.receive(bytes));
  std::vector<std::string> reflected;
  for (const std::string& each : listener.heard)
    if (each.starts_with("reflect")) reflected.push_back(each);
  EXPECT_THAT(reflected, ElementsAre("reflect 1 0 1", "reflect 2 0 2", "reflect 3 0 3",
                                     "reflect 4 0 4", "reflect 5 0 5", "reflect 6 6 2",
                                     "reflect 7 7 5", "reflect 8 8 3", "reflect 9 9 3"));
}

TEST(Entries, WithTheHeaderOfTheBlockBeforeComeInALaterFrame) {
  Listener listener;
  EntryHeader last;
  std::vector<std::size_t> sizes;
  for (std::uint32_t k = 1; k < 4; ++k) {
    const auto bytes = entries([&](std::vector<std::byte>& payload) {
      EntriesBlock(payload, last).append(header(both), first + k, EntryForm::discovered, [&] {
        append(payload, values_of(1.0f, 2.0f, static_cast<float>(k)));
      });
    });
    ASSERT_TRUE(listener.ambassador.receive(bytes));
    sizes.push_back(bytes.size());
  }
  EXPECT_EQ(listener.heard.back(), "reflect 3 1 3");
  EXPECT_THAT(sizes, ElementsAre(sizes[0], sizes[0] - 3, sizes[0] - 3));
}

TEST(Entries, ThatCannotBeEndTheConnection) {
  const auto value = values_of(1.0f, 2.0f, 3.0f);
  const auto one = [&](const EntriesMessage& of, EntryForm form, bool has_value) {
    return entries([&](std::vector<std::byte>& payload) {
      EntryHeader last;
      EntriesBlock(payload, last).append(of, first + 1, form, [&] {
        if (has_value) append(payload, value);
      });
    });
  };
  EntriesMessage no_class = header(both);
  no_class.object_class = 4000;
  const auto again = entries([](std::vector<std::byte>& payload) {
    EntriesAgainMessage message;
    rti::write(payload, message);
    write_entry(payload, first, {first + 1, EntryForm::discovered});
  });
  const auto form = entries([&](std::vector<std::byte>& payload) {
    EntriesMessage message = header(both);
    rti::write(payload, message);
    write_entry(payload, first, {first + 1, static_cast<EntryForm>(3)});
    append(payload, value);
  });
  const auto unended = entries([&](std::vector<std::byte>& payload) {
    EntriesMessage message = header(both);
    rti::write(payload, message);
    write_entry(payload, first, {first + 1, EntryForm::discovered, false});
    append(payload, value);
  });
  const auto recall = [](const EntriesMessage& of, std::uint8_t number) {
    return entries([&](std::vector<std::byte>& payload) {
      EntryHeader last;
      EntriesBlock block(payload, last);
      for (std::uint32_t k = 1; k <= 2; ++k)
        block.append(header(both), first + k, EntryForm::discovered,
                     [&] { append(payload, values_of(0.0f, 0.0f, static_cast<float>(k))); });
      block.append(of, first + 3, EntryForm::discovered,
                   [&] { append(payload, recalling(0.0f, number)); });
    });
  };
  const auto nothing = entries([&](std::vector<std::byte>& payload) {
    append(payload, values_of(MessageKind::entries, static_cast<std::uint8_t>(2 * vessel.value + 1),
                              static_cast<std::uint8_t>(both.bits), std::uint16_t{0}));
    write_entry(payload, first, {first + 1, EntryForm::discovered});
    append(payload, value);
  });
  const std::pair<const char*, std::vector<std::byte>> all[] = {
      {"of no class", one(no_class, EntryForm::discovered, true)},
      {"without attributes", one(header({}), EntryForm::discovered, true)},
      {"of attributes that the class has not",
       one(header(AttributeSet(AttributeBits{1} << 20)), EntryForm::discovered, true)},
      {"that repeat other attributes", one(header({speed}, both), EntryForm::discovered, true)},
      {"that repeat what none brought", one(header(both, both), EntryForm::discovered, false)},
      {"that recall other attributes", recall(header({position}, {}, {speed}), 1)},
      {"that recall what they repeat", recall(header(both, {speed}, {speed}), 1)},
      {"that recall what they should repeat", recall(header(both, {}, {speed}), 0)},
      {"that recall what is no longer kept", recall(header(both, {}, {speed}), 2)},
      {"that recall nothing", nothing},
      {"of an object that nobody discovered", one(header(both), EntryForm::known, true)},
      {"held by nobody", one(header(both), EntryForm::held, false)},
      {"cut short", one(header(both), EntryForm::discovered, false)},
      {"with the header of no block", again},
      {"of a form that there is not", form},
      {"without an end", unended},
  };
  for (const auto& [what, bytes] : all) {
    Listener listener;
    EXPECT_FALSE(listener.ambassador.receive(bytes)) << what;
  }
}

TEST(Entries, TwiceDiscoveredEndTheConnection) {
  Listener listener;
  const auto bytes = entries([](std::vector<std::byte>& payload) {
    EntryHeader last;
    EntriesBlock block(payload, last);
    for (int i = 0; i < 2; ++i)
      block.append(header(both), first + 1, EntryForm::discovered,
                   [&] { append(payload, values_of(1.0f, 2.0f, 3.0f)); });
  });
  EXPECT_FALSE(listener.ambassador.receive(bytes));
}

/// Hands what goes to connection 0 and 1 to two ambassadors.
struct Pair final : Outlet {
  FederationExecution execution;
  Ambassador first, second;
  Pair(const Fom& fom, FederateAmbassador& first_heard, FederateAmbassador& second_heard)
      : execution(fom, {}), first(fom, first_heard), second(fom, second_heard) {
    execution.connect(0);
    execution.connect(1);
    first.join("rink", "first", "tester");
    second.join("rink", "second", "tester");
    tick();
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) ASSERT_TRUE((connection == 0 ? first : second).receive(part));
  }
  void drop(ConnectionId, std::string_view why) override { ADD_FAILURE() << why; }
  void tick() {
    for (int i = 0; i < 3; ++i) {
      for (ConnectionId id = 0; id < 2; ++id) {
        Ambassador& each = id == 0 ? first : second;
        execution.receive(id, each.outgoing());
        each.clear_outgoing();
      }
      execution.match();
      execution.flush(*this);
    }
  }
};

/// The value of each object's one attribute.
struct Titles final : FederateAmbassador {
  std::map<std::uint32_t, std::string> of;
  void reflect_attribute_values(ObjectHandle object, AttributeSet, Bytes values,
                                const Stamp&) override {
    of[object.value] = text_of(values.subspan(4));
  }
};

TEST(Entries, BringAStaticValueOnceThoughObjectsHaveItByTurns) {
  const Fom fom = Fom::parse(
      R"(<objectModel><modelIdentification><name>Library</name></modelIdentification><objects>
<objectClass><name>HLAobjectRoot</name><objectClass><name>Book</name>
<attribute><name>title</name><dataType>HLAASCIIstring</dataType><updateType>Static</updateType></attribute>
</objectClass></objectClass></objects></objectModel>)",
      "library.xml");
  const ObjectClassHandle book = *fom.object_class("Book");
  FederateAmbassador author;
  Titles reader;
  Pair pair(fom, author, reader);
  pair.first.publish_object_class_attributes(book, fom.attributes(book));
  pair.second.subscribe_object_class_attributes(book, fom.attributes(book));
  pair.tick();
  const std::array<std::string, 3> titles{std::string(100, 'a'), std::string(100, 'b'),
                                          std::string(100, 'c')};
  std::map<std::uint32_t, std::string> truth;
  for (std::size_t k = 0; k < 60; ++k) {
    const ObjectHandle object = pair.first.register_object_instance(book);
    truth[object.value] = titles[k * k % 7 % 3];
    pair.first.update_attribute_values(object, fom.attributes(book), varying(truth[object.value]),
                                       {1.0, 0});
    if (k % 2 == 0) pair.tick();
  }
  pair.tick();
  EXPECT_EQ(reader.of, truth);
  EXPECT_LT(pair.execution.counters().entry_bytes_sent, 3u * 104u + 60u * 12u);
}

/// The size of each value of the one object that it knows.
struct Sizes final : FederateAmbassador {
  explicit Sizes(const Fom& fom) : fom(fom) {}
  const Fom& fom;
  std::map<std::uint32_t, std::size_t> of;
  void reflect_attribute_values(ObjectHandle, AttributeSet set, Bytes values,
                                const Stamp&) override {
    for (const AttributeHandle each : set)
      of[each.value] = fom.value(ObjectClassHandle{1}, set, each, values).size();
  }
};

TEST(Entries, LongerThanARecordAreSentAsOneAndUpdates) {
  const Fom fom = Fom::parse(
      R"(<objectModel><modelIdentification><name>Library</name></modelIdentification><objects>
<objectClass><name>HLAobjectRoot</name><objectClass><name>Book</name>
<attribute><name>first</name><dataType>HLAASCIIstring</dataType></attribute>
<attribute><name>second</name><dataType>HLAASCIIstring</dataType></attribute>
<attribute><name>third</name><dataType>HLAASCIIstring</dataType></attribute>
</objectClass></objectClass></objects></objectModel>)",
      "library.xml");
  const ObjectClassHandle book = *fom.object_class("Book");
  FederateAmbassador author;
  Sizes reader(fom);
  Pair pair(fom, author, reader);
  pair.first.publish_object_class_attributes(book, fom.attributes(book));
  const ObjectHandle object = pair.first.register_object_instance(book);
  for (const AttributeHandle each : fom.attributes(book)) {
    const std::uint32_t length = 20000;
    std::vector<std::byte> text(sizeof length + length, std::byte{'a'});
    const std::byte size[] = {std::byte{length & 0xff}, std::byte{length >> 8}, std::byte{0},
                              std::byte{0}};
    std::ranges::copy(size, text.begin());
    pair.first.update_attribute_values(object, AttributeSet{each}, text, {1.0, 0});
    pair.tick();
  }
  pair.second.subscribe_object_class_attributes(book, fom.attributes(book));
  pair.tick();
  EXPECT_EQ(reader.of.size(), 3u);
  for (const auto& [attribute, size] : reader.of) EXPECT_EQ(size, 20004u);
}

}  // namespace
}  // namespace rink::rti::testing
