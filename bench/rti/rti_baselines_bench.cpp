// Periodic state of a crowd through the RTI, in bytes and processor time: every double, quantised,
// and as differences to acknowledged baselines. No transport.
#include <benchmark/benchmark.h>
#include <cstring>

#include <chrono>
#include <cmath>
#include <deque>
#include <random>
#include <string>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"

namespace rink::bench::rti_baselines_bench {
namespace {

using namespace rink::rti;

enum class Telling { doubles, quantised, baselines };

/// The same record in three ways: ranges are what makes it quantised, Periodic what gives it
/// baselines.
Fom model(Telling telling) {
  const std::string type = telling == Telling::baselines ? "<updateType>Periodic</updateType>" : "";
  const auto simple = [&](const char* name, const char* resolution) {
    return "<simpleData" +
           std::string(telling == Telling::doubles ? ""
                                                   : " notes=\"of" + std::string(name) + "\"") +
           "><name>" + name + "</name><representation>HLAfloat64LE</representation><resolution>" +
           resolution + "</resolution></simpleData>";
  };
  const std::string xml =
      "<objectModel><objects><objectClass><name>Root</name><objectClass><name>Entity</"
      "name><attribute><name>state</name><dataType>State</dataType>" +
      type + "</attribute></objectClass></objectClass></objects><dataTypes><simpleDataTypes>" +
      simple("Place", "0.0005") + simple("Pace", "0.004") +
      R"(</simpleDataTypes><fixedRecordDataTypes><fixedRecordData><name>State</name>
<field><name>x</name><dataType>Place</dataType></field><field><name>y</name><dataType>Place</dataType></field>
<field notes="alongX"><name>u</name><dataType>Pace</dataType></field><field notes="alongY"><name>v</name><dataType>Pace</dataType></field>
</fixedRecordData></fixedRecordDataTypes></dataTypes><notes><note><label>ofPlace</label><semantics>range -16 1007</semantics></note>
<note><label>ofPace</label><semantics>range -64 63.9</semantics></note>)" +
      (telling == Telling::doubles ? ""
                                   : "<note><label>alongX</label><semantics>rate of "
                                     "x</semantics></note><note><label>alongY</"
                                     "label><semantics>rate of y</semantics></note>") +
      "</notes></objectModel>";
  return Fom::parse(xml, "bench");
}

struct State {
  double x = 0.0, y = 0.0, u = 0.0, v = 0.0;
};

/// Checks what it hears against what was said.
struct Client : FederateAmbassador {
  Client(const Fom& fom, const std::vector<State>& truth) : ambassador(fom, *this), truth(truth) {}
  Ambassador ambassador;
  const std::vector<State>& truth;
  double greatest_error = 0.0;
  std::uint64_t subscribed = 0;
  void reflect_attribute_values(ObjectHandle object, AttributeSet, Bytes values,
                                const Stamp&) override {
    State state;
    std::memcpy(&state, values.data(), sizeof state);
    const State& said = truth[object.value % object_block];
    greatest_error =
        std::max({greatest_error, std::abs(state.x - said.x), std::abs(state.y - said.y)});
    ++subscribed;
  }
};

/// 1,000 pucks with drag that are hit 1.4 times a second and 100 bats that change their thrust 2.5
/// times a second, 60 ticks a second.
class Crowd : public Outlet {
 public:
  Crowd(Telling telling, std::size_t clients)
      : fom_(model(telling)), execution_(fom_, {}), owner_(fom_, nobody_) {
    const ObjectClassHandle entity = *fom_.object_class("Entity");
    execution_.connect(0);
    owner_.join("rink", "owner", "bench");
    for (std::size_t i = 0; i < clients; ++i) {
      Client& client = clients_.emplace_back(fom_, states_);
      execution_.connect(static_cast<ConnectionId>(i + 1));
      client.ambassador.join("rink", "client " + std::to_string(i), "bench");
      client.ambassador.subscribe_object_class_attributes(entity, fom_.attributes(entity));
    }
    pass();
    owner_.publish_object_class_attributes(entity, fom_.attributes(entity));
    for (int i = 0; i < 1100; ++i) {
      objects_.push_back(owner_.register_object_instance(entity));
      State& state = states_.emplace_back();
      state.x = draw(0.0, 50.0), state.y = draw(0.0, 40.0);
      hit(state);
    }
    thrusts_.resize(100);
    for (int i = 0; i < 30; ++i) tick();
  }
  void tick() {
    time_ += dt;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      move(states_[i], i);
      owner_.update_attribute_values(objects_[i], AttributeSet(1),
                                     std::as_bytes(std::span(&states_[i], 1)), {time_, 0});
    }
    pass();
  }
  void pass() {
    execution_.receive(0, owner_.outgoing());
    owner_.clear_outgoing();
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      execution_.receive(static_cast<ConnectionId>(i + 1), clients_[i].ambassador.outgoing());
      clients_[i].ambassador.clear_outgoing();
    }
    execution_.match();
    const auto start = std::chrono::steady_clock::now();
    execution_.flush(*this);
    flush_s += seconds_since(start);
    const auto received = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < frames_.size(); ++i)
      if (i > 0 && !frames_[i].empty()) clients_[i - 1].ambassador.receive(frames_[i]);
    receive_s += seconds_since(received);
    if (!frames_.empty()) owner_.receive(frames_[0]);
    for (std::vector<std::byte>& frame : frames_) frame.clear();
  }
  double flush_s = 0.0, receive_s = 0.0;
  std::uint64_t bytes_to_clients() const { return execution_.counters().bytes_sent; }
  const std::deque<Client>& clients() const { return clients_; }
  static constexpr double dt = 1.0 / 60.0;

 private:
  static double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  double draw(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void hit(State& state) {
    state.u = draw(-1.5, 1.5);
    state.v = draw(-1.5, 1.5);
  }
  void move(State& state, std::size_t i) {
    if (i >= thrusts_.size()) {
      if (draw(0.0, 1.0) < 1.4 * dt) hit(state);
    } else if (draw(0.0, 1.0) < 2.5 * dt) {
      thrusts_[i].u = 6.0 * std::floor(draw(-1.0, 2.0)),
      thrusts_[i].v = 6.0 * std::floor(draw(-1.0, 2.0));
    }
    const double drag = i < thrusts_.size() ? 3.0 : 0.25;
    const State thrust = i < thrusts_.size() ? thrusts_[i] : State{};
    state.u += (thrust.u - drag * state.u) * dt, state.v += (thrust.v - drag * state.v) * dt;
    if (state.x < 0.0 || state.x > 50.0) state.u = std::copysign(state.u, 25.0 - state.x);
    if (state.y < 0.0 || state.y > 40.0) state.v = std::copysign(state.v, 20.0 - state.y);
    state.x += state.u * dt, state.y += state.v * dt;
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    if (connection >= frames_.size()) frames_.resize(connection + 1);
    for (const Bytes part : parts)
      frames_[connection].insert(frames_[connection].end(), part.begin(), part.end());
  }
  void drop(ConnectionId, std::string_view) override {}

  const Fom fom_;
  FederateAmbassador nobody_;
  std::mt19937_64 random_{1};
  std::vector<State> states_, thrusts_;
  FederationExecution execution_;
  Ambassador owner_;
  std::deque<Client> clients_;
  std::vector<ObjectHandle> objects_;
  std::vector<std::vector<std::byte>> frames_;
  double time_ = 0.0;
};

void tell(benchmark::State& state, Telling telling) {
  Crowd crowd(telling, static_cast<std::size_t>(state.range(0)));
  const std::uint64_t before = crowd.bytes_to_clients();
  crowd.flush_s = crowd.receive_s = 0.0;
  for (auto _ : state) crowd.tick();
  const auto ticks = static_cast<double>(state.iterations()),
             clients = static_cast<double>(state.range(0));
  state.counters["kB_per_client_s"] =
      1e-3 * static_cast<double>(crowd.bytes_to_clients() - before) / clients / (ticks * Crowd::dt);
  state.counters["flush_us"] = 1e6 * crowd.flush_s / ticks;
  state.counters["receive_us_per_client"] = 1e6 * crowd.receive_s / ticks / clients;
  double error = 0.0;
  std::uint64_t subscribed = 0;
  for (const Client& client : crowd.clients())
    error = std::max(error, client.greatest_error), subscribed += client.subscribed;
  state.counters["error_max_mm"] = 1e3 * error;
  state.counters["heard"] = static_cast<double>(subscribed);
}

void to_one_and_to_many(benchmark::internal::Benchmark* timed) {
  timed->ArgName("clients")->Arg(1)->Arg(100)->UseRealTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(tell, doubles, Telling::doubles)
    ->Name("rti/periodic/doubles")
    ->Apply(to_one_and_to_many);
BENCHMARK_CAPTURE(tell, quantised, Telling::quantised)
    ->Name("rti/periodic/quantised")
    ->Apply(to_one_and_to_many);
BENCHMARK_CAPTURE(tell, baselines, Telling::baselines)
    ->Name("rti/periodic/baselines")
    ->Apply(to_one_and_to_many);

}  // namespace
}  // namespace rink::bench::rti_baselines_bench
