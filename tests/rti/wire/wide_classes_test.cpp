// Classes of more attributes than a word of 32 bits has room for: every service that takes a set of
// attributes does with them what it does with few.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "rti/wire/declaration_messages.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// A sensor of `count` readings: by turns a number, an octet and a text; each fifth is best-effort,
/// and each seventh has a dimension.
std::string sensor_xml(std::uint32_t count) {
  constexpr std::array types = {"HLAfloat64BE", "HLAoctet", "HLAASCIIstring"};
  std::string attributes;
  for (std::uint32_t i = 0; i < count; ++i)
    attributes += "<attribute><name>reading" + std::to_string(i) + "</name><dataType>" +
                  types[i % 3] + "</dataType>" +
                  (i % 7 == 0 ? "<dimensions><dimension>Depth</dimension></dimensions>" : "") +
                  (i % 5 == 0 ? "<transportation>HLAbestEffort</transportation>" : "") +
                  "</attribute>\n";
  return "<objectModel><objects><objectClass><name>HLAobjectRoot</name>"
         "<objectClass><name>Sensor</name>\n" +
         attributes +
         "<objectClass><name>Buoy</name><attribute><name>colour</name><dataType>HLAoctet</dataType>"
         "</attribute></objectClass></objectClass></objectClass></objects>"
         "<dimensions><dimension><name>Depth</name><upperBound>100</upperBound></dimension>"
         "</dimensions></objectModel>";
}

struct Sea {
  Fom fom;
  ObjectClassHandle sensor = *fom.object_class("Sensor");
  AttributeSet all = fom.attributes(sensor);
  FederationExecution execution{fom, FederationSettings{}};
  FederationHost host{execution};
  InProcessNetwork network;
  InProcessEndpoint hub{network}, shore{network};
  FederateLinks links;
  std::deque<Station> stations;

  explicit Sea(std::uint32_t count) : fom(Fom::parse(sensor_xml(count), "sensors.xml")) {
    hub.listen("rti");
    host.add(hub);
  }
  Station& join(const std::string& name) {
    Station& station = stations.emplace_back(fom);
    station.link = std::make_unique<FederateLink>(station.ambassador, shore, shore.connect("rti"));
    links.add(*station.link);
    station.ambassador.join("rink", name, "station");
    settle();
    return station;
  }
  void settle() {
    for (int round = 0; round < 6; ++round) {
      links.flush(0.0);
      host.poll({});
      host.match();
      host.flush();
      shore.poll({}, links);
    }
  }
};

using Values = std::map<std::uint32_t, std::vector<std::byte>>;

std::vector<std::byte> joined(const Values& values, AttributeSet set) {
  std::vector<std::byte> all;
  for (const AttributeHandle each : set)
    all.insert(all.end(), values.at(each.value).begin(), values.at(each.value).end());
  return all;
}

struct Readings {
  std::mt19937_64 random;
  explicit Readings(unsigned seed) : random(seed) {}
  AttributeSet some(AttributeSet of) {
    const AttributeBits bits = AttributeBits{random()} << 64 | random();
    return AttributeSet(bits) & of;
  }
  std::vector<std::byte> value(const Attribute& attribute) {
    if (attribute.size == 8u) return values_of(random());
    if (attribute.size == 1u) return values_of(static_cast<std::uint8_t>(random()));
    return varying(std::string(random() % 20, 'a'));
  }
};

class WideClasses : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(WideClasses, HandlesAreIndicesAndLeaveOutThatOfThePrivilegeToDelete) {
  const std::uint32_t count = GetParam();
  const Fom fom = Fom::parse(sensor_xml(count), "sensors.xml");
  const ObjectClassHandle sensor = *fom.object_class("Sensor"), buoy = *fom.object_class("Buoy");
  EXPECT_EQ(fom.attributes(sensor).count(), count);
  EXPECT_EQ(fom.attributes(buoy).count(), count + 1);
  EXPECT_FALSE(fom.attributes(buoy).contains(privilege_to_delete_object));
  EXPECT_EQ(fom.attribute(buoy, "HLAprivilegeToDeleteObject"), privilege_to_delete_object);
  for (std::uint32_t i = 0; i < count; ++i) {
    const AttributeHandle handle = *fom.attribute(sensor, "reading" + std::to_string(i));
    EXPECT_EQ(handle.value, i < 31 ? i : i + 1);
    EXPECT_EQ(fom.attribute(buoy, "reading" + std::to_string(i)), handle);
    EXPECT_EQ(fom.at(sensor).attributes[handle.value].name, "reading" + std::to_string(i));
  }
  EXPECT_EQ(fom.at(buoy).attributes[fom.attribute(buoy, "colour")->value].name, "colour");
}

/// Values of random sets from random owners arrive as they were sent, whole and at once, at those
/// who subscribe to random sets; who joins late receives the newest.
TEST_P(WideClasses, EachFederateReceivesWhatItSubscribesTo) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Readings dice(seed);
    Sea sea(GetParam());
    Station &owner = sea.join("owner"), &heir = sea.join("heir");
    for (Station* each : {&owner, &heir})
      each->ambassador.publish_object_class_attributes(sea.sensor, sea.all);
    std::vector<std::pair<Station*, AttributeSet>> listeners;
    const auto listen = [&](const std::string& name) {
      Station& station = sea.join(name);
      const AttributeSet wanted = dice.some(sea.all) | AttributeSet{AttributeHandle{0}};
      station.ambassador.subscribe_object_class_attributes(sea.sensor, wanted);
      listeners.emplace_back(&station, wanted);
    };
    listen("first"), listen("second");
    heir.ambassador.subscribe_object_class_attributes(sea.sensor, sea.all);
    const ObjectHandle object = owner.ambassador.register_object_instance(sea.sensor, "deep");
    sea.settle();
    AttributeSet owned = sea.all;
    Values newest;
    for (int step = 0; step < 30; ++step) {
      if (step == 15) listen("late");
      if (step % 4 == 3) {
        const AttributeSet given = dice.some(owned), taken = dice.some(given);
        owner.ambassador.unconditional_attribute_ownership_divestiture(object, given);
        sea.settle();
        if (!taken.is_empty())
          heir.ambassador.attribute_ownership_acquisition_if_available(object, taken);
        owned = owned.without(given);
        sea.settle();
        for (const AttributeHandle each : sea.all)
          EXPECT_EQ(owner.ambassador.is_attribute_owned_by_federate(object, each),
                    owned.contains(each));
        for (const AttributeHandle each : taken)
          EXPECT_TRUE(heir.ambassador.is_attribute_owned_by_federate(object, each));
      }
      const AttributeSet set = dice.some(owned);
      for (const AttributeHandle each : set)
        newest[each.value] = dice.value(sea.fom.at(sea.sensor).attributes[each.value]);
      owner.ambassador.update_attribute_values(object, set, joined(newest, set),
                                               {.time = 0.5 * step, .tag = 0});
      sea.settle();
      for (const auto& [station, wanted] : listeners) {
        const auto& known = station->heard.objects.at(object.value).values;
        for (const auto& [attribute, value] : newest) {
          if (!wanted.contains({attribute})) EXPECT_FALSE(known.contains(attribute));
          else EXPECT_EQ(known.at(attribute), value) << step << ", attribute " << attribute;
        }
      }
    }
    for (const Station& each : sea.stations) EXPECT_EQ(each.heard.lost, "");
  }
}

TEST_P(WideClasses, ServicesOfRequestsTransportationAndRegionsTakeAnyOfThem) {
  Sea sea(GetParam());
  Station &owner = sea.join("owner"), &watcher = sea.join("watcher");
  const AttributeHandle last{GetParam() > 31 ? GetParam() : GetParam() - 1};
  owner.ambassador.publish_object_class_attributes(sea.sensor, sea.all);
  const ObjectHandle object = owner.ambassador.register_object_instance(sea.sensor, "deep");
  watcher.ambassador.subscribe_object_class_attributes(sea.sensor, sea.all);
  sea.settle();
  watcher.ambassador.query_attribute_ownership(object, last);
  watcher.ambassador.query_attribute_ownership(object, privilege_to_delete_object);
  owner.ambassador.request_attribute_transportation_type_change(object, AttributeSet{last},
                                                                Transportation::best_effort);
  sea.settle();
  EXPECT_EQ((watcher.heard.owners[{object.value, last.value}]), owner.ambassador.federate().value);
  EXPECT_EQ((watcher.heard.owners[{object.value, privilege_to_delete_object.value}]),
            owner.ambassador.federate().value);

  // The attributes with a dimension arrive by region, each for itself.
  AttributeSet regional;
  for (const AttributeHandle each : sea.all)
    if (!sea.fom.at(sea.sensor).attributes[each.value].dimensions.is_empty()) regional.insert(each);
  const DimensionHandle depth = *sea.fom.dimension("Depth");
  const auto region = [&](Station& station, double low, double high) {
    const RegionHandle made = station.ambassador.create_region(DimensionSet{depth});
    station.ambassador.set_range_bounds(made, depth, {low, high});
    station.ambassador.commit_region_modifications(made);
    return made;
  };
  const RegionHandle shallow = region(owner, 0, 10), deep = region(owner, 50, 60);
  AttributeSet upper, lower;
  for (const AttributeHandle each : regional) (each.value % 2 != 0 ? upper : lower).insert(each);
  owner.ambassador.associate_regions_for_updates(
      object, std::array{AttributeRegions{upper, {shallow}}, AttributeRegions{lower, {deep}}});
  Station& diver = sea.join("diver");
  diver.ambassador.subscribe_object_class_attributes_with_regions(
      sea.sensor, std::array{AttributeRegions{regional, {region(diver, 55, 70)}}});
  sea.settle();
  Readings dice(1);
  Values newest;
  for (const AttributeHandle each : sea.all)
    newest[each.value] = dice.value(sea.fom.at(sea.sensor).attributes[each.value]);
  owner.ambassador.update_attribute_values(object, sea.all, joined(newest, sea.all), {});
  sea.settle();
  AttributeSet reflected;
  for (const auto& [attribute, value] : diver.heard.objects.at(object.value).values)
    reflected.insert({attribute});
  EXPECT_EQ(reflected, lower);
  EXPECT_EQ(watcher.heard.objects.at(object.value).values.size(), sea.all.count());
}

INSTANTIATE_TEST_SUITE_P(Widths, WideClasses, ::testing::Values(8u, 31u, 32u, 88u, 125u));

TEST(WideClass, OneAttributeMoreThanASetHoldsIsRefused) {
  try {
    Fom::parse(sensor_xml(named_attribute_max), "sensors.xml");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(),
                 "sensors.xml:128: <objectClass> 'Buoy' has more than 126 attributes "
                 "(IEEE 1516.2-2010, 4.4)");
  }
}

/// Bytes by hand: sets within 31 attributes as ever, wider ones by the rule of docs/wire.md.
TEST(WideClass, SetsTravelAsTheWirePageSays) {
  const auto bytes_of_set = [](AttributeBits set) {
    std::vector<std::byte> bytes;
    Writer writer(bytes);
    PublishObjectClassMessage message{0x0201, set};
    exchange(writer, message);
    ObjectRelevanceMessage relevance{5, set};
    exchange(writer, relevance);
    Reader reader(bytes);
    PublishObjectClassMessage read;
    ObjectRelevanceMessage relevance_read;
    EXPECT_TRUE(exchange(reader, read) && exchange(reader, relevance_read) && reader.is_at_end());
    EXPECT_EQ(read.attributes, set);
    EXPECT_EQ(relevance_read.attributes, set);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      Reader part(Bytes(bytes).first(size));
      EXPECT_FALSE(exchange(part, read) && exchange(part, relevance_read));
    }
    std::string text;
    for (const std::byte each : bytes) {
      char digits[4];
      std::snprintf(digits, sizeof digits, "%02x ", static_cast<unsigned>(each));
      text += digits;
    }
    return text;
  };
  EXPECT_EQ(bytes_of_set(0x40000001u), "01 02 01 00 00 40 05 81 80 80 80 04 ");
  // Attributes 0 and 32: bit 31 set, then 1 << 0 of those from 32 on.
  EXPECT_EQ(bytes_of_set(AttributeBits{1} << 32 | 1u), "01 02 01 00 00 80 01 05 81 80 80 80 10 ");
  // Attribute 100: number 68 of those from 32 on, which is 5 from 63 on, and 37 = 5 * 7 + 2 of
  // those from 63 on. Ten bytes say nothing but that others follow: 63 = 9 * 7.
  EXPECT_EQ(bytes_of_set(AttributeBits{1} << 100),
            "01 02 00 00 00 80 80 80 80 80 80 80 80 80 80 01 20 "
            "05 80 80 80 80 80 80 80 80 80 01 80 80 80 80 80 04 ");
}

}  // namespace
}  // namespace rink::rti::testing
