// The airport federation, in process and over TCP: what every federate knows at the end is the
// closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "rti/federation_directory.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/rti/scenes/airport.h"

namespace rink::rti::airport {
namespace {

/// All numbers are multiples of 1/8, so that every sum of the closed form is exact.
const std::vector<Gust> gusts{
    {2.5, 8.0}, {7.125, -12.0}, {7.75, 4.0}, {15.0, -3.0}, {23.875, 80.0}};
const std::vector<FlightPlan> plans{
    {-400.0, 100.0, 60.0}, {-900.0, 200.0, 20.0}, {300.0, 300.0, -50.0}, {700.0, 400.0, 2.5},
    {-650.0, 500.0, 30.0}, {980.0, 600.0, -90.0}, {-1.0, 700.0, 0.25},   {500.0, 800.0, -12.5}};

/// The sector in which a flight is: 1 west, 2 east.
std::int32_t sector_of(double x) { return x < 0.0 ? 1 : 2; }

enum class Carrier { in_process, tcp };

/// The host, the federates and the loop that carries bytes between them.
class Airport : public ::testing::TestWithParam<Carrier> {
 protected:
  Airport()
      : directory_(settings()),
        host_(directory_),
        server_local_(network_),
        clients_local_(network_) {
    directory_.offer(model_.fom);
    if (is_tcp()) port_ = server_tcp_.listen("127.0.0.1", 0);
    else server_local_.listen("airport");
    host_.add(is_tcp() ? static_cast<Transport&>(server_tcp_) : server_local_);
    directory_.create("airport", model_.fom.hash());
  }
  static DirectorySettings settings() {
    DirectorySettings settings;
    settings.federation.filter = "region";
    settings.federation.filter_settings.world = {-sector_m, 0.0, sector_m, sector_m};
    return settings;
  }
  bool is_tcp() const { return GetParam() == Carrier::tcp; }
  Transport& clients() { return is_tcp() ? static_cast<Transport&>(clients_tcp_) : clients_local_; }

  void enter(AirportFederate& federate, const std::string& name, const std::string& type) {
    const ConnectionId connection =
        is_tcp() ? clients_tcp_.connect("127.0.0.1", port_) : clients_local_.connect("airport");
    federate_links_.push_back(
        std::make_unique<FederateLink>(federate.ambassador(), clients(), connection));
    links_.add(*federate_links_.back());
    federate.join(name, type);
  }
  void round() {
    const auto wait = is_tcp() ? std::chrono::microseconds(200) : std::chrono::microseconds(0);
    links_.flush(0.0);
    host_.poll(wait);
    host_.advance_clock(0.0);
    host_.match();
    host_.flush();
    clients().poll(wait, links_);
  }
  /// Until all have landed, or somebody is in trouble.
  void run() {
    enter(weather_, "meteo", "weather");
    enter(traffic_, "traffic", "aircraft");
    enter(west_, "west", "tower");
    enter(east_, "east", "tower");
    for (int rounds = 0; rounds < 20'000 && !has_landed(); ++rounds) round();
    for (int rounds = 0; rounds < 20; ++rounds) round();
    for (const AirportFederate* each : all()) EXPECT_EQ(each->trouble(), "");
    ASSERT_TRUE(has_landed());
  }
  std::vector<AirportFederate*> all() { return {&weather_, &traffic_, &west_, &east_}; }
  bool has_landed() {
    const auto federates = all();
    return std::all_of(federates.begin(), federates.end(),
                       [](const AirportFederate* each) { return each->has_landed(); });
  }
  std::size_t flight_of(ObjectHandle object) const {
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (traffic_.object(i) == object) return i;
    ADD_FAILURE() << "no flight has object " << object.value;
    return 0;
  }

  const Model model_;
  FederationDirectory directory_;
  FederationHost host_;
  InProcessNetwork network_;
  TcpTransport server_tcp_, clients_tcp_;
  InProcessEndpoint server_local_, clients_local_;
  std::uint16_t port_ = 0;
  FederateLinks links_;
  std::vector<std::unique_ptr<FederateLink>> federate_links_;
  Weather weather_{model_, gusts, 4};
  Traffic traffic_{model_, plans};
  Tower west_{model_, 1}, east_{model_, 2};
};

TEST_P(Airport, EveryFlightIsWhereTheClosedFormHasItToTheLastBit) {
  run();
  ASSERT_EQ(traffic_.felt().size(), gusts.size());
  for (std::size_t k = 0; k < gusts.size(); ++k)
    EXPECT_EQ(traffic_.felt()[k].time, gusts[k].time) << "in the order of time";
  for (std::size_t i = 0; i < plans.size(); ++i)
    EXPECT_EQ(traffic_.x(i), x_of(plans[i], gusts, end_s)) << "flight " << i;
}

TEST_P(Airport, TowersHearOfTheirOwnSectorInTheOrderOfTimeAndExactly) {
  run();
  for (const Tower* tower : {&west_, &east_}) {
    double last = 0.0;
    EXPECT_FALSE(tower->reports().empty());
    for (const Tower::Report& report : tower->reports()) {
      const std::size_t flight = flight_of(report.object);
      EXPECT_GE(report.time, last);
      last = report.time;
      EXPECT_EQ(report.x, x_of(plans[flight], gusts, report.time))
          << "flight " << flight << " at " << report.time;
      EXPECT_EQ(report.y, plans[flight].y);
    }
  }
}

TEST_P(Airport, WhoFliesInASectorForAWhileIsInItsTowersSightAndReportedEverySecond) {
  run();
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const Tower& tower = sector_of(x_of(plans[i], gusts, end_s)) == 1 ? west_ : east_;
    const Tower& other = &tower == &west_ ? east_ : west_;
    bool has_stayed = true;
    for (double time = end_s - 5.0; time <= end_s; time += step_s) {
      const double x = x_of(plans[i], gusts, time);
      has_stayed = has_stayed && sector_of(x) == sector_of(x_of(plans[i], gusts, end_s)) &&
                   std::abs(x) < sector_m;
    }
    if (!has_stayed) continue;
    EXPECT_TRUE(tower.in_sight().contains(traffic_.object(i))) << "flight " << i;
    EXPECT_FALSE(other.in_sight().contains(traffic_.object(i))) << "flight " << i;
    for (double time = end_s - 4.0; time < end_s; time += step_s)
      EXPECT_EQ(std::count_if(tower.reports().begin(), tower.reports().end(),
                              [&](const Tower::Report& each) {
                                return each.object == traffic_.object(i) && each.time == time;
                              }),
                1)
          << "flight " << i << " at " << time;
  }
}

TEST_P(Airport, EachFlightIsClearedByTheTowerOfItsSectorAndHandedOverWhenItCrosses) {
  run();
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    std::int32_t cleared_by =
        0;  // who entered a sector's square last; nobody clears outside of both
    for (double time = 0.0; time <= end_s; time += step_s) {
      const double x = x_of(plans[i], gusts, time);
      if (std::abs(x) > sector_m) continue;
      crossings += cleared_by != 0 && cleared_by != sector_of(x) ? 1u : 0u;
      cleared_by = sector_of(x);
    }
    EXPECT_EQ(west_.cleared().contains(traffic_.object(i)), cleared_by == 1) << "flight " << i;
    EXPECT_EQ(east_.cleared().contains(traffic_.object(i)), cleared_by == 2) << "flight " << i;
    EXPECT_EQ(traffic_.clearance(i), cleared_by) << "flight " << i;
  }
  EXPECT_GT(crossings, 2u);
  EXPECT_EQ(west_.given_up() + east_.given_up(), crossings);
}

INSTANTIATE_TEST_SUITE_P(Over, Airport, ::testing::Values(Carrier::in_process, Carrier::tcp),
                         [](const auto& carrier) {
                           return carrier.param == Carrier::tcp ? "tcp" : "in_process";
                         });

}  // namespace
}  // namespace rink::rti::airport
