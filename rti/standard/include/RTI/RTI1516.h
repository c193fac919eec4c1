// Everything of the standard's C++ API, IEEE 1516.1-2010, but encoding helpers and time types.
// These headers declare its names and signatures; what they mean the standard says.
#pragma once

#define HLA_SPECIFICATION_NAME "1516"
#define HLA_API_MAJOR_VERSION 2
#define HLA_API_MINOR_VERSION 0

#include <RTI/Enums.h>
#include <RTI/Exception.h>
#include <RTI/Handle.h>
#include <RTI/LogicalTime.h>
#include <RTI/LogicalTimeFactory.h>
#include <RTI/LogicalTimeInterval.h>
#include <RTI/RangeBounds.h>
#include <RTI/SpecificConfig.h>
#include <RTI/Typedefs.h>
#include <RTI/VariableLengthData.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace rti1516e {

std::wstring rtiName();
std::wstring rtiVersion();

}  // namespace rti1516e

#include <RTI/FederateAmbassador.h>
#include <RTI/RTIambassador.h>
#include <RTI/RTIambassadorFactory.h>
