// Makes a federate's side of the RTI.
#pragma once

#include <RTI/Exception.h>
#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>

#include <memory>

namespace rti1516e {

class RTIambassador;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT RTIambassadorFactory {
 public:
  RTIambassadorFactory();
  virtual ~RTIambassadorFactory();

  std::auto_ptr<RTIambassador> createRTIambassador();
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
