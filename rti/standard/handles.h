// The standard's handles and Rink's.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/standard/standard_headers.h"
#include "rti/types.h"

// The standard's headers name these classes friends of the handles. A handle is a pointer to what
// they do not say: here it is the handle's number plus one, so that nothing is allocated, an empty
// one is a null pointer, and a copy costs a word.
#define RINK_HANDLE_FRIEND(Kind)                                                \
  class Kind##Friend {                                                          \
   public:                                                                      \
    static Kind make(std::uint32_t number) {                                    \
      const std::uintptr_t word = static_cast<std::uint32_t>(number + 1);       \
      return Kind(reinterpret_cast<Kind##Implementation*>(word));               \
    }                                                                           \
    static std::uint32_t number(Kind const& handle) {                           \
      return static_cast<std::uint32_t>(                                        \
          reinterpret_cast<std::uintptr_t>(handle.getImplementation()) - 1);    \
    }                                                                           \
    static Kind decode(VariableLengthData const& bytes) { return Kind(bytes); } \
  };

namespace rti1516e {

RINK_HANDLE_FRIEND(FederateHandle)
RINK_HANDLE_FRIEND(ObjectClassHandle)
RINK_HANDLE_FRIEND(InteractionClassHandle)
RINK_HANDLE_FRIEND(ObjectInstanceHandle)
RINK_HANDLE_FRIEND(AttributeHandle)
RINK_HANDLE_FRIEND(ParameterHandle)
RINK_HANDLE_FRIEND(DimensionHandle)
RINK_HANDLE_FRIEND(RegionHandle)

class MessageRetractionHandleFriend {
 public:
  static MessageRetractionHandle make(const rink::rti::RetractionHandle& handle);
  static rink::rti::RetractionHandle value(MessageRetractionHandle const& handle);
  static MessageRetractionHandle decode(VariableLengthData const& bytes) {
    return MessageRetractionHandle(bytes);
  }
};

}  // namespace rti1516e

#undef RINK_HANDLE_FRIEND

namespace rink::standard {

#define RINK_HANDLE_CONVERSIONS(Kind, Core)                \
  inline rti::Core to_core(const rti1516e::Kind& handle) { \
    return {rti1516e::Kind##Friend::number(handle)};       \
  }                                                        \
  inline rti1516e::Kind to_standard(rti::Core handle) {    \
    return rti1516e::Kind##Friend::make(handle.value);     \
  }
RINK_HANDLE_CONVERSIONS(FederateHandle, FederateHandle)
RINK_HANDLE_CONVERSIONS(ObjectClassHandle, ObjectClassHandle)
RINK_HANDLE_CONVERSIONS(InteractionClassHandle, InteractionClassHandle)
RINK_HANDLE_CONVERSIONS(ObjectInstanceHandle, ObjectHandle)
RINK_HANDLE_CONVERSIONS(AttributeHandle, AttributeHandle)
RINK_HANDLE_CONVERSIONS(ParameterHandle, ParameterHandle)
RINK_HANDLE_CONVERSIONS(DimensionHandle, DimensionHandle)
RINK_HANDLE_CONVERSIONS(RegionHandle, RegionHandle)
#undef RINK_HANDLE_CONVERSIONS

inline rti::RetractionHandle to_core(const rti1516e::MessageRetractionHandle& handle) {
  return rti1516e::MessageRetractionHandleFriend::value(handle);
}
inline rti1516e::MessageRetractionHandle to_standard(const rti::RetractionHandle& handle) {
  return rti1516e::MessageRetractionHandleFriend::make(handle);
}

/// Throws AttributeNotDefined for a handle that no class has.
rti::AttributeSet to_core(const rti1516e::AttributeHandleSet& attributes);
/// Throws InvalidDimensionHandle.
rti::DimensionSet to_core(const rti1516e::DimensionHandleSet& dimensions);
std::vector<rti::FederateHandle> to_core(const rti1516e::FederateHandleSet& federates);
std::vector<rti::RegionHandle> to_core(const rti1516e::RegionHandleSet& regions);
std::vector<rti::AttributeRegions> to_core(
    const rti1516e::AttributeHandleSetRegionHandleSetPairVector& pairs);
rti1516e::AttributeHandleSet to_standard(rti::AttributeSet attributes);
rti1516e::DimensionHandleSet to_standard(rti::DimensionSet dimensions);

}  // namespace rink::standard
