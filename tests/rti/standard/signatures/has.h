// Whether a class has a member function of a certain signature. Compiles as C++14 and as C++20.
#pragma once

#include "rti/standard/standard_headers.h"

namespace rink {
namespace standard {
namespace testing {

/// `Signature` chooses among overloads: nothing compiles that has no such one.
template <class Class, class Signature>
constexpr bool has(Signature Class::*) {
  return true;
}

}  // namespace testing
}  // namespace standard
}  // namespace rink
