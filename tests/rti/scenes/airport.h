// A federation that has nothing to do with the game: aircraft, two control towers, and the weather.
// The sample that docs/rti.md explains.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rti/ambassador.h"
#include "rti/transport/federate_link.h"
#include "tests/places.h"

namespace rink::rti::airport {

inline constexpr double end_s = 24.0, step_s = 1.0;
inline constexpr double report_delay_s =
    0.5;  ///< a position is reported so long after it was measured: the lookahead of the traffic
inline constexpr double forecast_s =
    2.0;  ///< wind is known so long before it blows: the lookahead of the weather
inline constexpr double sector_m =
    1000.0;  ///< a sector is a square of this side; the two meet at x = 0

/// The object model and the handles of its parts.
struct Model {
  Fom fom = Fom::load(test::source_folder() + "/tests/rti/scenes/airport.fom.xml");
  ObjectClassHandle aircraft = *fom.object_class("Aircraft");
  AttributeHandle position = *fom.attribute(aircraft, "position"),
                  clearance = *fom.attribute(aircraft, "clearance");
  InteractionClassHandle wind = *fom.interaction_class("Wind");
};

/// Wind [m/s] that blows along x from an instant [s] on.
struct Gust {
  double time = 0.0, velocity = 0.0;
};
/// An aircraft flies along x at its own velocity [m/s], and is carried by the wind.
struct FlightPlan {
  double start_x = 0.0, y = 0.0, velocity = 0.0;
};

/// Where it is at `time`, in closed form: x = x0 + v t + sum over gusts of w_k (min(t, t_k+1) -
/// t_k). Exact where all numbers are small multiples of 1/8.
inline double x_of(const FlightPlan& plan, const std::vector<Gust>& gusts, double time) {
  double x = plan.start_x + plan.velocity * time;
  for (std::size_t k = 0; k < gusts.size() && gusts[k].time < time; ++k)
    x += gusts[k].velocity *
         (std::min(time, k + 1 < gusts.size() ? gusts[k + 1].time : time) - gusts[k].time);
  return x;
}

template <class Value>
std::vector<std::byte> bytes_of_value(const Value& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  return {first, first + sizeof value};
}
template <class Value>
Value value_of(Bytes bytes) {
  Value value{};
  std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof value));
  return value;
}

/// What all federates of the airport have in common: they join, and achieve "ready" when it is
/// announced and their time is managed.
class AirportFederate : public FederateAmbassador {
 public:
  explicit AirportFederate(const Model& model) : model_(model), ambassador_(model.fom, *this) {}
  Ambassador& ambassador() { return ambassador_; }
  bool has_landed() const {
    return has_landed_;
  }  ///< the point "landed" is reached: all have come to the end
  const std::string& trouble() const { return error_; }

  void join(const std::string& name, const std::string& type) {
    ambassador_.join("airport", name, type);
  }

 protected:
  /// Steps 1 to 3 of a federate: declare, manage time, wait for the others.
  void joined(FederateHandle) override {
    declare();
    manage_time();
  }
  virtual void declare() = 0;
  virtual void manage_time() = 0;
  virtual void start() = 0;

  void time_is_managed() {
    is_managed_ = true;
    achieve_ready();
  }
  /// Step 6: nobody leaves before all have come to the end.
  void finish() { has_finished_ = true, achieve_landed(); }

  void announce_synchronization_point(std::string_view label, Bytes) override {
    if (label == "ready") is_called_ = true, achieve_ready();
    if (label == "landed") is_landing_ = true, achieve_landed();
  }
  void federation_synchronized(std::string_view label, std::span<const FederateHandle>) override {
    if (label == "ready") start();
    else has_landed_ = true;
  }
  void join_refused(Refusal, std::string_view why) override { error_ = why; }
  void connection_lost(std::string_view why) override { error_ = why; }

  const Model& model_;
  Ambassador ambassador_;

 private:
  void achieve_ready() {
    if (is_called_ && is_managed_)
      ambassador_.synchronization_point_achieved("ready"), is_called_ = false;
  }
  void achieve_landed() {
    if (is_landing_ && has_finished_)
      ambassador_.synchronization_point_achieved("landed"), is_landing_ = false;
  }
  bool is_managed_ = false, is_called_ = false, is_landing_ = false, has_finished_ = false,
       has_landed_ = false;
  std::string error_;
};

/// Sends gusts before they blow. It regulates the others and is told nothing that would constrain
/// it.
class Weather final : public AirportFederate {
 public:
  Weather(const Model& model, std::vector<Gust> gusts, std::size_t federate_count)
      : AirportFederate(model), gusts_(std::move(gusts)), awaited_(federate_count) {}

 private:
  void declare() override {
    ambassador_.publish_interaction_class(model_.wind);
    ambassador_.watch_federates();
  }
  void manage_time() override { ambassador_.enable_time_regulation(forecast_s); }
  void time_regulation_enabled(LogicalTime) override { time_is_managed(); }
  /// It also opens the airport, once all are there: one point for everybody, and one for the end.
  void federate_joined(FederateHandle, std::string_view, std::string_view) override {
    if (--awaited_ > 0) return;
    ambassador_.register_synchronization_point("ready");
    ambassador_.register_synchronization_point("landed");
  }
  void start() override { time_advance_grant(LogicalTime(0.0)); }
  void time_advance_grant(LogicalTime now) override {
    for (; next_ < gusts_.size() && gusts_[next_].time < now.value + 2 * forecast_s; ++next_)
      ambassador_.send_interaction(model_.wind, bytes_of_value(gusts_[next_].velocity),
                                   LogicalTime(gusts_[next_].time));
    if (now.value >= end_s) return finish();
    ambassador_.time_advance_request(LogicalTime(now.value + forecast_s));
  }

  std::vector<Gust> gusts_;
  std::size_t next_ = 0, awaited_;
};

/// Flies all aircraft: regulates with its reports, and is constrained by the wind.
class Traffic final : public AirportFederate {
 public:
  Traffic(const Model& model, std::vector<FlightPlan> plans)
      : AirportFederate(model), plans_(std::move(plans)) {
    for (const FlightPlan& plan : plans_) aircraft_.push_back({plan.start_x, {}, {}, 0});
  }
  double x(std::size_t aircraft) const { return aircraft_[aircraft].x; }
  std::int32_t clearance(std::size_t aircraft) const { return aircraft_[aircraft].clearance; }
  ObjectHandle object(std::size_t aircraft) const { return aircraft_[aircraft].object; }
  const std::vector<Gust>& felt() const { return felt_; }  ///< in the order in which they came

 private:
  struct Flying {
    double x = 0.0;
    ObjectHandle object;
    RegionHandle region;
    std::int32_t clearance = 0;  ///< the tower that cleared it, 0 while none has
  };

  void declare() override {
    ambassador_.publish_object_class_attributes(model_.aircraft,
                                                AttributeSet{model_.position, model_.clearance});
    ambassador_.subscribe_object_class_attributes(model_.aircraft, AttributeSet{model_.clearance});
    ambassador_.subscribe_interaction_class(model_.wind);
  }
  void manage_time() override {
    ambassador_.enable_asynchronous_delivery();
    ambassador_.enable_time_regulation(report_delay_s);
    ambassador_.enable_time_constrained();
  }
  void time_constrained_enabled(LogicalTime) override { time_is_managed(); }

  /// Step 4: what there is, and where it is.
  void start() override {
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      Flying& each = aircraft_[i];
      each.object =
          ambassador_.register_object_instance(model_.aircraft, "flight-" + std::to_string(i));
      each.region = ambassador_.create_region();
      ambassador_.associate_regions_for_updates(each.object, each.region);
    }
    report(0.0);
    ambassador_.time_advance_request(LogicalTime(step_s));
  }
  /// Step 5: what happens, in the order of time. The wind that blew so far carries the aircraft up
  /// to the instant at which it changes.
  void receive_interaction_with_time(InteractionClassHandle, Bytes velocity, FederateHandle,
                                     const TimedStamp& timed) override {
    fly_to(timed.stamp.time);
    wind_ = value_of<double>(velocity);
    felt_.push_back({timed.stamp.time, wind_});
  }
  void time_advance_grant(LogicalTime now) override {
    fly_to(now.value);
    report(now.value);
    if (now.value >= end_s) return finish();
    ambassador_.time_advance_request(LogicalTime(now.value + step_s));
  }
  void fly_to(double time) {
    for (std::size_t i = 0; i < plans_.size(); ++i)
      aircraft_[i].x += (plans_[i].velocity + wind_) * (time - time_);
    time_ = time;
  }
  void report(double now) {
    bounds_.clear();
    for (std::size_t i = 0; i < plans_.size(); ++i)
      bounds_.push_back(
          {aircraft_[i].region, {aircraft_[i].x, plans_[i].y, aircraft_[i].x, plans_[i].y}});
    ambassador_.commit_region_modifications(bounds_);
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      const double place[2] = {aircraft_[i].x, plans_[i].y};
      ambassador_.update_attribute_values(aircraft_[i].object, AttributeSet{model_.position},
                                          std::as_bytes(std::span(place)),
                                          LogicalTime(now + report_delay_s));
    }
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet attributes, Bytes values,
                                const Stamp&) override {
    if (attributes != AttributeSet{model_.clearance}) return;
    for (Flying& each : aircraft_)
      if (each.object == object) each.clearance = value_of<std::int32_t>(values);
  }

  /// An aircraft that takes off owns its clearance until the first tower takes it.
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet attributes,
                                           Bytes) override {
    ambassador_.attribute_ownership_divestiture_if_wanted(object, attributes);
  }

  std::vector<FlightPlan> plans_;
  std::vector<Flying> aircraft_;
  std::vector<RegionBounds> bounds_;
  std::vector<Gust> felt_;
  double time_ = 0.0, wind_ = 0.0;
};

/// Watches one sector. Who comes into it is cleared by this tower: it takes the clearance over from
/// the tower that had it.
class Tower final : public AirportFederate {
 public:
  struct Report {
    ObjectHandle object;
    double time = 0.0, x = 0.0, y = 0.0;  ///< when it was measured, and where
  };
  /// The number is greater than 0; the sector lies west of x = 0 for the first tower, east of it
  /// for the second.
  Tower(const Model& model, std::int32_t number) : AirportFederate(model), number_(number) {}
  const std::vector<Report>& reports() const { return reports_; }
  const std::set<ObjectHandle>& in_sight() const { return in_sight_; }
  const std::set<ObjectHandle>& cleared() const { return cleared_; }
  std::size_t given_up() const { return given_up_; }  ///< clearances that the other tower took over

 private:
  void declare() override {
    const RegionHandle sector = ambassador_.create_region();
    const double west = number_ == 1 ? -sector_m : 0.0;
    ambassador_.set_region(sector, {west, 0.0, west + sector_m, sector_m});
    ambassador_.commit_region_modifications(sector);
    ambassador_.subscribe_object_class_attributes(model_.aircraft, AttributeSet{model_.position},
                                                  sector);
    ambassador_.publish_object_class_attributes(model_.aircraft, AttributeSet{model_.clearance});
  }
  void manage_time() override {
    ambassador_.enable_asynchronous_delivery();
    ambassador_.enable_time_constrained();
  }
  void time_constrained_enabled(LogicalTime) override { time_is_managed(); }
  void start() override { ambassador_.next_message_request(LogicalTime(end_s)); }
  void time_advance_grant(LogicalTime now) override {
    if (now.value >= end_s) return finish();
    ambassador_.next_message_request(LogicalTime(end_s));
  }
  void reflect_attribute_values_with_time(ObjectHandle object, AttributeSet, Bytes values,
                                          const TimedStamp& timed) override {
    reports_.push_back({object, timed.stamp.time - report_delay_s, value_of<double>(values),
                        value_of<double>(values.subspan(sizeof(double)))});
  }

  void attributes_in_scope(ObjectHandle object) override {
    in_sight_.insert(object);
    if (cleared_.contains(object) || !asked_.insert(object).second) return;
    ambassador_.attribute_ownership_acquisition(object, AttributeSet{model_.clearance},
                                                bytes_of_value(number_));
  }
  void attributes_out_of_scope(ObjectHandle object) override { in_sight_.erase(object); }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet attributes,
                                           Bytes) override {
    ambassador_.attribute_ownership_divestiture_if_wanted(object, attributes);
  }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet) override {
    cleared_.erase(object), ++given_up_;
  }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet attributes,
                                                    Bytes) override {
    asked_.erase(object);
    cleared_.insert(object);
    ambassador_.update_attribute_values(object, attributes, bytes_of_value(number_), Stamp{});
  }

  std::int32_t number_;
  std::vector<Report> reports_;
  std::set<ObjectHandle> in_sight_, cleared_, asked_;
  std::size_t given_up_ = 0;
};

}  // namespace rink::rti::airport
