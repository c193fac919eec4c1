// Values, ranges and records of the standard's C++ API.
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "rti/standard/standard_headers.h"

namespace rti1516e {

/// Bytes that are copied, borrowed or taken over.
class VariableLengthDataImplementation {
 public:
  VariableLengthDataImplementation() = default;
  VariableLengthDataImplementation(const VariableLengthDataImplementation&) = delete;
  VariableLengthDataImplementation& operator=(const VariableLengthDataImplementation&) = delete;
  ~VariableLengthDataImplementation() { release(); }

  const void* data() const { return data_; }
  size_t size() const { return size_; }
  void copy(const void* data, size_t size) {
    assert(data != nullptr || size == 0);
    if (size > sizeof near_) {
      char* const bytes = new char[size];
      std::memcpy(bytes, data, size);
      return hold(bytes, size, delete_array);
    }
    std::array<char, near_max> bytes;
    if (size != 0) std::memcpy(bytes.data(), data, size);  // which may be its own
    release();
    if (size != 0) std::memcpy(near_.data(), bytes.data(), size);
    data_ = size == 0 ? nullptr : near_.data();
    size_ = size;
    release_by_ = nullptr;
  }
  void hold(void* data, size_t size, VariableLengthDataDeleteFunction release_by) {
    release();
    data_ = data;
    size_ = size;
    release_by_ = release_by;
  }
  static void delete_array(void* data) { delete[] static_cast<char*>(data); }

 private:
  void release() {
    if (release_by_ != nullptr && data_ != nullptr) release_by_(data_);
  }

  /// Values up to this size take no memory of their own.
  static constexpr std::size_t near_max = 40;

  void* data_ = nullptr;
  size_t size_ = 0;
  std::array<char, near_max> near_;
  VariableLengthDataDeleteFunction release_by_ = nullptr;  ///< null: the bytes are the caller's
};

VariableLengthData::VariableLengthData() : _impl(new VariableLengthDataImplementation) {}
VariableLengthData::VariableLengthData(void const* inData, size_t inSize) : VariableLengthData() {
  _impl->copy(inData, inSize);
}
VariableLengthData::VariableLengthData(VariableLengthData const& rhs) : VariableLengthData() {
  _impl->copy(rhs.data(), rhs.size());
}
VariableLengthData::~VariableLengthData() { delete _impl; }
VariableLengthData& VariableLengthData::operator=(VariableLengthData const& rhs) {
  if (this != &rhs) _impl->copy(rhs.data(), rhs.size());
  return *this;
}
void const* VariableLengthData::data() const { return _impl->data(); }
size_t VariableLengthData::size() const { return _impl->size(); }
void VariableLengthData::setData(void const* inData, size_t inSize) { _impl->copy(inData, inSize); }
void VariableLengthData::setDataPointer(void* inData, size_t inSize) {
  _impl->hold(inData, inSize, nullptr);
}
void VariableLengthData::takeDataPointer(void* inData, size_t inSize,
                                         VariableLengthDataDeleteFunction func) {
  _impl->hold(inData, inSize,
              func == nullptr ? VariableLengthDataImplementation::delete_array : func);
}

RangeBounds::RangeBounds() : _lowerBound(0), _upperBound(0) {}
RangeBounds::RangeBounds(unsigned long lowerBound, unsigned long upperBound)
    : _lowerBound(lowerBound), _upperBound(upperBound) {}
RangeBounds::~RangeBounds() = default;
RangeBounds::RangeBounds(RangeBounds const& rhs) = default;
RangeBounds& RangeBounds::operator=(RangeBounds const& rhs) = default;
unsigned long RangeBounds::getLowerBound() const { return _lowerBound; }
unsigned long RangeBounds::getUpperBound() const { return _upperBound; }
void RangeBounds::setLowerBound(unsigned long lowerBound) { _lowerBound = lowerBound; }
void RangeBounds::setUpperBound(unsigned long upperBound) { _upperBound = upperBound; }

FederateRestoreStatus::FederateRestoreStatus(FederateHandle const& thePreHandle,
                                             FederateHandle const& thePostHandle,
                                             RestoreStatus theStatus)
    : preRestoreHandle(thePreHandle), postRestoreHandle(thePostHandle), status(theStatus) {}

FederationExecutionInformation::FederationExecutionInformation(
    std::wstring const& theFederationExecutionName,
    std::wstring const& theLogicalTimeImplementationName)
    : federationExecutionName(theFederationExecutionName),
      logicalTimeImplementationName(theLogicalTimeImplementationName) {}

#define RINK_DEFINE_SUPPLEMENT(Kind)                                                               \
  Kind::Kind() : hasProducingFederate(false), hasSentRegions(false) {}                             \
  Kind::Kind(FederateHandle const& theFederateHandle)                                              \
      : hasProducingFederate(true), hasSentRegions(false), producingFederate(theFederateHandle) {} \
  Kind::Kind(RegionHandleSet const& theRegionHandleSet)                                            \
      : hasProducingFederate(false), hasSentRegions(true), sentRegions(theRegionHandleSet) {}      \
  Kind::Kind(FederateHandle const& theFederateHandle, RegionHandleSet const& theRegionHandleSet)   \
      : hasProducingFederate(true),                                                                \
        hasSentRegions(true),                                                                      \
        producingFederate(theFederateHandle),                                                      \
        sentRegions(theRegionHandleSet) {}
RINK_DEFINE_SUPPLEMENT(SupplementalReflectInfo)
RINK_DEFINE_SUPPLEMENT(SupplementalReceiveInfo)
#undef RINK_DEFINE_SUPPLEMENT

SupplementalRemoveInfo::SupplementalRemoveInfo() : hasProducingFederate(false) {}
SupplementalRemoveInfo::SupplementalRemoveInfo(FederateHandle const& theFederateHandle)
    : hasProducingFederate(true), producingFederate(theFederateHandle) {}

FederateAmbassador::FederateAmbassador() = default;
FederateAmbassador::~FederateAmbassador() = default;
RTIambassador::RTIambassador() noexcept = default;
RTIambassador::~RTIambassador() = default;

}  // namespace rti1516e
