// A stretch of one dimension in the standard's C++ API.
#pragma once

#include <RTI/SpecificConfig.h>

namespace rti1516e {

class RTI_EXPORT RangeBounds {
 public:
  RangeBounds();
  RangeBounds(unsigned long lowerBound, unsigned long upperBound);
  // Users' headers leave the definition to the library.
  ~RangeBounds();  // NOLINT(performance-trivially-destructible)
  RangeBounds(RangeBounds const& rhs);
  RangeBounds& operator=(RangeBounds const& rhs);

  unsigned long getLowerBound() const;
  unsigned long getUpperBound() const;
  void setLowerBound(unsigned long lowerBound);
  void setUpperBound(unsigned long upperBound);

 private:
  unsigned long _lowerBound;
  unsigned long _upperBound;
};

}  // namespace rti1516e
