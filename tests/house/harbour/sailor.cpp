// docs/hla.md, "The standard's API": a federate as it is written for any RTI of IEEE 1516.1-2010.
// The captain sails a ship; everybody else sees it.
#include <RTI/NullFederateAmbassador.h>
#include <RTI/RTI1516.h>
#include <RTI/encoding/BasicDataElements.h>
#include <RTI/encoding/HLAfixedRecord.h>

#include <iostream>
#include <memory>
#include <string>

using namespace rti1516e;

/// The model's record: deck, x, y.
HLAfixedRecord place_record(double x, double y) {
  HLAfixedRecord record;
  record.appendElement(HLAoctet(1));
  record.appendElement(HLAfloat64BE(x));
  record.appendElement(HLAfloat64BE(y));
  return record;
}

struct Visitor : NullFederateAmbassador {
  void reflectAttributeValues(ObjectInstanceHandle, AttributeHandleValueMap const& values,
                              VariableLengthData const&, OrderType, TransportationType,
                              SupplementalReflectInfo) override {
    HLAfixedRecord place = place_record(0.0, 0.0);
    place.decode(values.begin()->second);
    std::cout << "a ship at " << dynamic_cast<HLAfloat64BE const&>(place[1]).get() << ", "
              << dynamic_cast<HLAfloat64BE const&>(place[2]).get() << std::endl;
    has_seen = true;
  }
  bool has_seen = false;
};

int main(int count, char** words) try {
  if (count < 2) return std::cerr << "usage: sailor MODEL [captain]\n", 2;
  const bool is_captain = count > 2;
  const std::string model(words[1]);
  Visitor visitor;
  std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  rti->connect(visitor, HLA_EVOKED);
  try {
    rti->createFederationExecution(L"harbour", std::wstring(model.begin(), model.end()));
  } catch (FederationExecutionAlreadyExists const&) {
  }
  rti->joinFederationExecution(is_captain ? L"captain" : L"visitor", L"example", L"harbour");
  const ObjectClassHandle ship = rti->getObjectClassHandle(L"HLAobjectRoot.Ship");
  const AttributeHandle place = rti->getAttributeHandle(ship, L"place");
  if (is_captain) {
    rti->publishObjectClassAttributes(ship, {place});
    const ObjectInstanceHandle pequod = rti->registerObjectInstance(ship);
    for (double x = 0.0; x < 10.0; x += 1.0) {
      AttributeHandleValueMap values;
      values[place] = place_record(x, 7.0).encode();
      rti->updateAttributeValues(pequod, values, VariableLengthData());
      rti->evokeMultipleCallbacks(0.2, 0.5);
    }
  } else {
    rti->subscribeObjectClassAttributes(ship, {place});
    while (!visitor.has_seen) rti->evokeMultipleCallbacks(0.1, 1.0);
  }
  rti->resignFederationExecution(DELETE_OBJECTS_THEN_DIVEST);
  rti->disconnect();
} catch (Exception const& exception) {
  std::wcerr << exception.what() << std::endl;
  return 1;
}
