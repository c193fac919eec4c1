// The standard's C++ API for the library's own sources, whether the headers are Rink's or the
// user's.
#pragma once

#include <iosfwd>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

// The headers of 2010 say by dynamic exception specifications what is thrown, which C++17 took out
// of the language. They are no part of a function's linked name: a federate that is compiled with
// them as C++14 links with what is compiled here.
#if defined(RINK_HLA_HEADERS) && __cplusplus >= 201703L
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#define throw(...) noexcept(true __VA_OPT__(&&false))
#endif

#include <RTI/NullFederateAmbassador.h>
#include <RTI/RTI1516.h>
#include <RTI/encoding/BasicDataElements.h>
#include <RTI/encoding/HLAfixedArray.h>
#include <RTI/encoding/HLAfixedRecord.h>
#include <RTI/encoding/HLAopaqueData.h>
#include <RTI/encoding/HLAvariableArray.h>
#include <RTI/encoding/HLAvariantRecord.h>
#include <RTI/time/HLAfloat64Interval.h>
#include <RTI/time/HLAfloat64Time.h>
#include <RTI/time/HLAfloat64TimeFactory.h>
#include <RTI/time/HLAinteger64Interval.h>
#include <RTI/time/HLAinteger64Time.h>
#include <RTI/time/HLAinteger64TimeFactory.h>

#if defined(RINK_HLA_HEADERS) && __cplusplus >= 201703L
#undef throw
#pragma GCC diagnostic pop
#endif
