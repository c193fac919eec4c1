// Logical times of the standard's API, and what the core makes of them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rti/standard/times.h"

namespace rink::standard {
namespace {

using namespace rti1516e;

/// Both kinds, alike.
struct Float64 {
  using Time = HLAfloat64Time;
  using Interval = HLAfloat64Interval;
  using Factory = HLAfloat64TimeFactory;
  static constexpr const wchar_t* name = L"HLAfloat64Time";
};
struct Integer {
  using Time = HLAinteger64Time;
  using Interval = HLAinteger64Interval;
  using Factory = HLAinteger64TimeFactory;
  static constexpr const wchar_t* name = L"HLAinteger64Time";
};

template <class Kind>
void check_that_times_and_intervals_add_and_compare() {
  using Time = typename Kind::Time;
  using Interval = typename Kind::Interval;
  Time time(5);
  time += Interval(3);
  EXPECT_TRUE(time == Time(8));
  time -= Interval(8);
  EXPECT_TRUE(time.isInitial());
  EXPECT_TRUE(Time(1) < Time(2) && Time(2) <= Time(2) && Time(3) > Time(2) && Time(2) >= Time(2));
  Interval between;
  between.setToDifference(Time(9), Time(4));
  EXPECT_TRUE(between == Interval(5));
  between -= Interval(5);
  EXPECT_TRUE(between.isZero());
}
TEST(LogicalTimeKinds, TimesAndIntervalsAddAndCompare) {
  check_that_times_and_intervals_add_and_compare<Float64>();
  check_that_times_and_intervals_add_and_compare<Integer>();
}

template <class Kind>
void check_that_sums_do_not_leave_the_range_of_time() {
  using Time = typename Kind::Time;
  using Interval = typename Kind::Interval;
  Time last;
  last.setFinal();
  EXPECT_TRUE(last.isFinal());
  Interval step(2);
  Interval most;
  most.setToDifference(last, Time(0));
  EXPECT_THROW(last += most, IllegalTimeArithmetic);
  EXPECT_THROW(Time(1) -= step, IllegalTimeArithmetic);
  EXPECT_THROW(step.setToDifference(Time(1), Time(2)), IllegalTimeArithmetic);
  EXPECT_TRUE(last.isFinal());
}
TEST(LogicalTimeKinds, SumsDoNotLeaveTheRangeOfTime) {
  check_that_sums_do_not_leave_the_range_of_time<Float64>();
  check_that_sums_do_not_leave_the_range_of_time<Integer>();
}

template <class Kind>
void check_that_epsilon_is_the_least_interval_above_zero() {
  typename Kind::Interval least;
  least.setEpsilon();
  EXPECT_TRUE(least.isEpsilon());
  EXPECT_FALSE(least.isZero());
  EXPECT_GT(least.getInterval(), 0);
}
TEST(LogicalTimeKinds, TextReadsAsTheSameNumber) {
  EXPECT_EQ(rti1516e::HLAfloat64Time(2.5).toString(), L"2.5");
  for (const double value : {0.1, 1e-7, 1.0 / 3.0, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max()}) {
    EXPECT_EQ(rti1516e::HLAfloat64Interval(value).toString(),
              rti1516e::HLAfloat64Time(value).toString());
    EXPECT_EQ(std::wcstod(rti1516e::HLAfloat64Time(value).toString().c_str(), nullptr), value);
  }
}

TEST(LogicalTimeKinds, EpsilonIsTheLeastIntervalAboveZero) {
  check_that_epsilon_is_the_least_interval_above_zero<Float64>();
  check_that_epsilon_is_the_least_interval_above_zero<Integer>();
}

template <class Kind>
void check_that_encodings_have_eight_bytes_the_most_significant_first() {
  typename Kind::Factory factory;
  const typename Kind::Time time(2);
  const VariableLengthData bytes = time.encode();
  ASSERT_EQ(bytes.size(), 8u);
  const std::string expected = std::is_same_v<Kind, Float64> ? std::string("\x40\0\0\0\0\0\0\0", 8)
                                                             : std::string("\0\0\0\0\0\0\0\2", 8);
  EXPECT_EQ(std::string(static_cast<const char*>(bytes.data()), 8), expected);
  EXPECT_TRUE(*factory.decodeLogicalTime(bytes) == time);
  EXPECT_THROW(factory.decodeLogicalTime(VariableLengthData("abc", 3)), CouldNotDecode);
  // A negative number, and for doubles a NaN: neither is a time.
  EXPECT_THROW(factory.decodeLogicalTimeInterval(VariableLengthData("\xff\xff\xff\xff\0\0\0\1", 8)),
               CouldNotDecode);
}
TEST(LogicalTimeKinds, EncodingsHaveEightBytesTheMostSignificantFirst) {
  check_that_encodings_have_eight_bytes_the_most_significant_first<Float64>();
  check_that_encodings_have_eight_bytes_the_most_significant_first<Integer>();
}

template <class Kind>
void check_that_the_factory_of_a_name_makes_its_kind() {
  const auto factory = HLAlogicalTimeFactoryFactory::makeLogicalTimeFactory(Kind::name);
  ASSERT_NE(factory.get(), nullptr);
  EXPECT_EQ(factory->getName(), Kind::name);
  EXPECT_EQ(factory->makeInitial()->implementationName(), Kind::name);
  EXPECT_TRUE(factory->makeFinal()->isFinal());
  EXPECT_TRUE(factory->makeZero()->isZero());
  EXPECT_TRUE(factory->makeEpsilon()->isEpsilon());
  EXPECT_EQ(HLAlogicalTimeFactoryFactory::makeLogicalTimeFactory(L"HLAdays").get(), nullptr);
}
TEST(LogicalTimeKinds, TheFactoryOfANameMakesItsKind) {
  check_that_the_factory_of_a_name_makes_its_kind<Float64>();
  check_that_the_factory_of_a_name_makes_its_kind<Integer>();
}

TEST(LogicalTime, TheTwoKindsDoNotMix) {
  HLAfloat64Time time(1.0);
  EXPECT_THROW(time = HLAinteger64Time(1), InvalidLogicalTime);
  EXPECT_THROW((void)(time < HLAinteger64Time(1)), InvalidLogicalTime);
  EXPECT_THROW(time += HLAinteger64Interval(1), InvalidLogicalTimeInterval);
}

TEST(Times, IntegersAreExactUpToTwoToThe53) {
  const Times times(L"HLAinteger64Time");
  const Integer64 most = Integer64{1} << 53;
  EXPECT_EQ(times.number(HLAinteger64Time(most - 1)), 9007199254740991.0);
  EXPECT_EQ(dynamic_cast<HLAinteger64Time&>(*times.time(9007199254740991.0)).getTime(), most - 1);
  EXPECT_THROW(times.number(HLAinteger64Time(most + 1)), InvalidLogicalTime);
  EXPECT_THROW(times.number(HLAfloat64Time(1.0)), InvalidLogicalTime);
  EXPECT_THROW(times.number(HLAfloat64Interval(1.0)), InvalidLookahead);
}

TEST(Times, AnInstantBetweenTwoIntegersIsTheLaterOne) {
  const Times times(L"HLAinteger64Time");
  EXPECT_EQ(times.time(std::nextafter(3.0, 4.0))->toString(), L"4");
  EXPECT_EQ(times.time(3.0)->toString(), L"3");
}

TEST(Times, TheFinalTimeIsOneThatTheCoreTakes) {
  HLAfloat64Time last;
  last.setFinal();
  const Times times;
  const double number = times.number(last);
  EXPECT_LT(number, std::numeric_limits<double>::max());
  EXPECT_TRUE(times.time(number)->isFinal());
  EXPECT_TRUE(times.time(std::numeric_limits<double>::infinity())->isFinal());
  EXPECT_THROW(Times(L"HLAdays"), CouldNotCreateLogicalTimeFactory);
}

}  // namespace
}  // namespace rink::standard
