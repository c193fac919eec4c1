// A federate of a hosted federation: `visitor captain` sails a ship, `visitor` watches for one.
#include <cstdio>
#include <string_view>

#include "rti/fom/fom.h"
#include "rti/transport/tcp_federate.h"
#include "rti/wire/data_elements.h"

using namespace rink::rti;

struct Place {
  std::uint8_t deck;
  double x, y;
};
using PlaceElement = data::FixedRecord<data::Field<&Place::deck, data::Octet>,
                                       data::Field<&Place::x, data::Float64BE>,
                                       data::Field<&Place::y, data::Float64BE>>;

struct Visitor : FederateAmbassador {
  bool has_seen = false;
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values, const Stamp&) override {
    const auto place = data::decode<PlaceElement>(values);
    has_seen = place.has_value();
    if (place) std::printf("a ship at %g, %g\n", place->x, place->y);
  }
  void connection_lost(std::string_view why) override {
    std::printf("lost: %.*s\n", static_cast<int>(why.size()), why.data());
  }
};

int main(int count, char** words) {
  const bool is_captain = count > 1 && std::string_view(words[1]) == "captain";
  const Fom fom = Fom::load(is_captain ? words[2] : words[1]);
  const ObjectClassHandle ship = *fom.object_class("Ship");
  const AttributeSet place{*fom.attribute(ship, "place")};
  Visitor visitor;
  TcpFederate federate(fom, visitor, {.host = "127.0.0.1", .port = 7000});
  Ambassador& rti = federate.ambassador();
  rti.join("harbour", is_captain ? "captain" : "visitor", "example");
  if (!federate.run([&] { return rti.is_joined(); })) return 1;
  if (is_captain) {
    rti.publish_object_class_attributes(ship, place);
    const ObjectHandle pequod = rti.register_object_instance(ship, "Pequod");
    for (double x = 0.0; federate.run_for(0.5); x += 1.0)
      rti.update_attribute_values(pequod, place, data::encode<PlaceElement>({1, x, 7.0}), {});
  } else {
    rti.subscribe_object_class_attributes(ship, place);
    federate.run([&] { return visitor.has_seen; });
  }
  federate.resign();
}
