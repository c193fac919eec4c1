// An object model whose positions state range and resolution: what the quantised codec and the
// baselines are tested on.
#pragma once

#include "rti/fom/fom.h"

namespace rink::rti::testing {

/// Boat.track is periodic state that is quantised throughout; Beacon.light mixes quantised fields
/// with some of which every bit travels.
inline constexpr const char* fjord_xml = R"(<?xml version="1.0"?>
<objectModel>
  <modelIdentification><name>Fjord</name></modelIdentification>
  <objects>
    <objectClass><name>HLAobjectRoot</name>
      <objectClass><name>Boat</name>
        <attribute><name>track</name><dataType>Track</dataType><updateType>Periodic</updateType><dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions></attribute>
        <attribute><name>cargo</name><dataType>HLAfloat64LE</dataType></attribute>
      </objectClass>
      <objectClass><name>Beacon</name>
        <attribute><name>light</name><dataType>Light</dataType><updateType>Periodic</updateType></attribute>
        <attribute><name>depth</name><dataType>Depth</dataType></attribute>
      </objectClass>
    </objectClass>
  </objects>
  <dimensions><dimension><name>X</name></dimension><dimension><name>Y</name></dimension></dimensions>
  <dataTypes>
    <simpleDataTypes>
      <simpleData notes="ofTheFjord"><name>Place</name><representation>HLAfloat64LE</representation><units>m</units><resolution>0.001</resolution></simpleData>
      <simpleData notes="ofBoats"><name>Speed</name><representation>HLAfloat32BE</representation><units>m/s</units><resolution>0.01</resolution></simpleData>
      <simpleData notes="ofTheSea"><name>Depth</name><representation>HLAinteger16LE</representation><units>m</units><resolution>1</resolution></simpleData>
      <simpleData><name>Mass</name><representation>HLAfloat64LE</representation><units>kg</units><resolution>0.5</resolution></simpleData>
    </simpleDataTypes>
    <enumeratedDataTypes><enumeratedData><name>Colour</name><representation>HLAinteger32BE</representation></enumeratedData></enumeratedDataTypes>
    <fixedRecordDataTypes>
      <fixedRecordData><name>Point</name>
        <field><name>x</name><dataType>Place</dataType></field>
        <field><name>y</name><dataType>Place</dataType></field>
      </fixedRecordData>
      <fixedRecordData><name>Track</name>
        <field><name>x</name><dataType>Place</dataType></field>
        <field><name>y</name><dataType>Place</dataType></field>
        <field notes="alongX"><name>speedX</name><dataType>Speed</dataType></field>
        <field notes="alongY"><name>speedY</name><dataType>Speed</dataType></field>
      </fixedRecordData>
      <fixedRecordData><name>Light</name>
        <field><name>at</name><dataType>Point</dataType></field>
        <field><name>energy</name><dataType>HLAfloat64LE</dataType></field>
        <field><name>colour</name><dataType>Colour</dataType></field>
        <field><name>below</name><dataType>Depth</dataType></field>
      </fixedRecordData>
    </fixedRecordDataTypes>
  </dataTypes>
  <notes>
    <note><label>ofTheFjord</label><semantics>range -500 2500</semantics></note>
    <note><label>ofBoats</label><semantics>range -30 30</semantics></note>
    <note><label>ofTheSea</label><semantics>range -11000 0</semantics></note>
    <note><label>alongX</label><semantics>rate of x</semantics></note>
    <note><label>alongY</label><semantics>rate of y</semantics></note>
  </notes>
</objectModel>
)";

inline const Fom& fjord() {
  static const Fom fom = Fom::parse(fjord_xml, "fjord.xml");
  return fom;
}
inline const ObjectClassHandle boat = *fjord().object_class("Boat"),
                               beacon = *fjord().object_class("Beacon");
inline const AttributeHandle track = *fjord().attribute(boat, "track"),
                             cargo = *fjord().attribute(boat, "cargo");
inline const AttributeHandle light = *fjord().attribute(beacon, "light"),
                             depth = *fjord().attribute(beacon, "depth");

}  // namespace rink::rti::testing
