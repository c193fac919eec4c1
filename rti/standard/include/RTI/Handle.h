// The handles of the standard's C++ API.
#pragma once

#include <RTI/Exception.h>
#include <RTI/SpecificConfig.h>
#include <RTI/VariableLengthData.h>

#include <iosfwd>
#include <string>

// NOLINTBEGIN(bugprone-macro-parentheses): types, which the argument is, have none.
#define DEFINE_HANDLE_CLASS(HandleKind)                          \
  class HandleKind##Implementation;                              \
                                                                 \
  class RTI_EXPORT HandleKind {                                  \
   public:                                                       \
    HandleKind();                                                \
    ~HandleKind();                                               \
    HandleKind(HandleKind const& rhs);                           \
    HandleKind& operator=(HandleKind const& rhs);                \
                                                                 \
    bool isValid() const;                                        \
    bool operator==(HandleKind const& rhs) const;                \
    bool operator!=(HandleKind const& rhs) const;                \
    bool operator<(HandleKind const& rhs) const;                 \
    long hash() const;                                           \
                                                                 \
    VariableLengthData encode() const;                           \
    void encode(VariableLengthData& buffer) const;               \
    size_t encode(void* buffer, size_t bufferSize) const;        \
    size_t encodedLength() const;                                \
    std::wstring toString() const;                               \
                                                                 \
   protected:                                                    \
    friend class HandleKind##Friend;                             \
    const HandleKind##Implementation* getImplementation() const; \
    HandleKind##Implementation* getImplementation();             \
    explicit HandleKind(HandleKind##Implementation* impl);       \
    explicit HandleKind(VariableLengthData const& encodedValue); \
                                                                 \
    HandleKind##Implementation* _impl;                           \
  };                                                             \
                                                                 \
  std::wostream& operator<<(std::wostream& stream, HandleKind const& handle);
// NOLINTEND(bugprone-macro-parentheses)

namespace rti1516e {

DEFINE_HANDLE_CLASS(FederateHandle)
DEFINE_HANDLE_CLASS(ObjectClassHandle)
DEFINE_HANDLE_CLASS(InteractionClassHandle)
DEFINE_HANDLE_CLASS(ObjectInstanceHandle)
DEFINE_HANDLE_CLASS(AttributeHandle)
DEFINE_HANDLE_CLASS(ParameterHandle)
DEFINE_HANDLE_CLASS(DimensionHandle)
DEFINE_HANDLE_CLASS(MessageRetractionHandle)
DEFINE_HANDLE_CLASS(RegionHandle)

}  // namespace rti1516e
