// A federate's logical time, of the kind that its federation execution has; the core counts in
// doubles.
#pragma once

#include <memory>
#include <string>

#include "rti/standard/standard_headers.h"
#include "rti/types.h"

namespace rink::standard {

/// Converts times and intervals. Integers are exact up to 2^53.
class Times {
 public:
  /// "HLAfloat64Time", "HLAinteger64Time", or empty for the former. Throws
  /// CouldNotCreateLogicalTimeFactory.
  explicit Times(const std::wstring& implementation);
  Times() = default;  ///< HLAfloat64Time

  bool is_integer() const { return is_integer_; }
  std::wstring name() const;
  std::unique_ptr<rti1516e::LogicalTimeFactory> factory() const;
  /// The time that the core's stands for; between two integers it is the later one, before which
  /// nothing can come either.
  std::unique_ptr<rti1516e::LogicalTime> time(double value) const;
  /// Throw InvalidLogicalTime for another kind of time, or one beyond what doubles hold exactly.
  double number(const rti1516e::LogicalTime& time) const;
  void assign(rti1516e::LogicalTime& time, double value) const;
  /// Throw InvalidLookahead for another kind of interval.
  double number(const rti1516e::LogicalTimeInterval& interval) const;
  void assign(rti1516e::LogicalTimeInterval& interval, double value) const;

 private:
  bool is_integer_ = false;
};

}  // namespace rink::standard
