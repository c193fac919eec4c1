// Ticks as those of rink serve, with writers in place of the RTI.
#include "loadgen/dds/dds_server.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include <dds/dds.h>
#include <topics.h>
#include "game/net/interrupt.h"
#include "game/replication/filter_setup.h"

namespace rink::loadgen {
namespace {

constexpr double longest_wait_s = 0.1;  // so that an interrupt is heeded

double extent_of(const game::Game& game) {
  double most = 0.0;
  for (const game::Entity& entity : game.entities())
    most = std::max(most, entity.half_extent.maxCoeff());
  return most;
}

/// Keys up to a saved game have been pressed.
game::Game game_of(game::ServedGame& played) {
  game::Game game = played.begun ? std::move(*played.begun) : game::Game(played.scene);
  if (played.begun)
    std::erase_if(*played.replay,
                  [&](const game::InputEvent& event) { return event.time <= game.now(); });
  for (const game::InputEvent& event : *played.replay) game.submit(event);
  return game;
}

dds_duration_t duration(double seconds) {
  return static_cast<dds_duration_t>(1e9 * std::max(0.0, seconds));
}

}  // namespace

im::Region field_of(const game::Scene& scene) { return game::filter_settings(scene, 0.0).world; }

double cell_size_of(const DdsServeOptions& options, const game::Scene& scene) {
  if (options.scheme == "none") return 0.0;
  const double size = im::cell_size_of(game::filter_settings(scene, options.cell_size)),
               cells = PartitionGrid::cells_in(field_of(scene), size);
  if (cells <= PartitionGrid::cells_max) return size;
  throw DdsError("--cell-size: cells of " + std::to_string(size) + " m would make " +
                 std::to_string(static_cast<std::uint64_t>(cells)) +
                 " writers: expected a size for at most 10000");
}

DdsServer::DdsServer(const DdsServeOptions& options, game::ServedGame& played,
                     const DdsClock& now_s)
    : options_(options),
      played_(played),
      now_s_(now_s),
      game_(game_of(played)),
      begin_s_(game_.now()),
      grid_(field_of(played.scene), cell_size_of(options, played.scene)),
      domain_(options.domain ? Domain::of_server(*options.domain) : Domain::of_server()),
      writers_(domain_, grid_),
      recorder_(options, played, game_) {
  assert(played.replay && "the game is that of a key log");
  sessions_ = make_writer(domain_, domain_.sessions(), {}, Delivery::kept);
  inputs_ = make_reader(domain_, domain_.inputs(), {}, Delivery::all, 0);
  waiting_ = require(dds_create_waitset(domain_.participant()), "a set to wait for");
  require(dds_waitset_attach(waiting_, inputs_.own, 0), "waiting for inputs");
  say_session(0.0, false);
}

void DdsServer::say_session(double origin_s, bool is_over) {
  const im::Region field = field_of(played_.scene);
  std::vector<rink_dds_Seat> seats;
  for (std::uint32_t player = 0; player < std::min(options_.clients, game_.player_count());
       ++player) {
    const auto bat = game_.bat(player);
    if (!bat) continue;
    const physics::Vector2 place = game_.position(*bat);
    seats.push_back({bat->index, static_cast<float>(place.x()), static_cast<float>(place.y())});
  }
  rink_dds_Session session{};
  session.origin_ns = std::llround(1e9 * origin_s);
  session.begin_s = begin_s_, session.rate_hz = options_.rate_hz;
  session.cell_size = cell_size_of(options_, played_.scene);
  session.low_x = field.low_x, session.low_y = field.low_y;
  session.high_x = field.high_x, session.high_y = field.high_y;
  session.extent = extent_of(game_);
  session.is_over = is_over;
  session.seats._buffer = seats.data();
  session.seats._length = session.seats._maximum = static_cast<std::uint32_t>(seats.size());
  require(dds_write(sessions_.own, &session), "writing the session");
  dds_write_flush(sessions_.own);
}

/// Keys are counted and not felt: the game is that of the key log, in all of whose cells they are
/// played at their planned instants.
void DdsServer::hear() {
  constexpr std::size_t most = 64;
  std::array<rink_dds_Input, most> inputs;
  std::array<void*, most> places;
  std::array<dds_sample_info_t, most> infos;
  for (std::size_t k = 0; k < most; ++k) places[k] = &inputs[k];
  for (;;) {
    const auto count =
        require(dds_take(inputs_.own, places.data(), infos.data(), most, most), "taking inputs");
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      if (!infos[k].valid_data) continue;
      if (inputs[k].kind < 2) ++keys_;
      else if (inputs[k].player < options_.clients) ready_.insert(inputs[k].player);
    }
    if (static_cast<std::size_t>(count) < most) return;
  }
}

void DdsServer::hear_until(double until_s) {
  do {
    const double wait_s = std::min(longest_wait_s, until_s - now_s_());
    dds_attach_t which = 0;
    if (wait_s > 0.0) dds_waitset_wait(waiting_, &which, 1, duration(wait_s));
    hear();
  } while (now_s_() < until_s && !game::is_interrupted);
}

bool DdsServer::gather() {
  const double begin_s = now_s_(), give_up_s = begin_s + options_.patience_s;
  while (ready_.size() < options_.clients && now_s_() < give_up_s && !game::is_interrupted)
    hear_until(now_s_() + 0.01);
  gathering_s_ = now_s_() - begin_s;
  return ready_.size() >= options_.clients && !game::is_interrupted;
}

DdsServer::Counted DdsServer::counted() const {
  return {.sent = sent_so_far(),
          .received = received_so_far(),
          .states = writers_.written(),
          .crossings = writers_.crossings(),
          .loopback = loopback_bytes()};
}

/// A reader that its process took along, or whose lease ran out, is no longer matched.
std::uint32_t DdsServer::present_count() const {
  dds_subscription_matched_status_t matched;
  require(dds_get_subscription_matched_status(inputs_.own, &matched), "counting bots");
  return std::min(options_.clients, matched.current_count);
}

/// Bots leave by the clock, so who is gone when the game's time is up was not lost.
void DdsServer::count_present() {
  const double end_s =
      start_s_ + std::floor(options_.duration_s * options_.rate_hz + 1e-9) / options_.rate_hz;
  const std::uint32_t present = present_count();
  if (now_s_() < end_s) lost_ = std::max(lost_, options_.clients - present);
}

void DdsServer::run() {
  constexpr double lead_s = 0.1;  // so that the first tick is not late
  const Counted before = counted();
  gathering_ = before.sent;
  gathering_.bytes += before.received.bytes;
  gathering_.discovery_bytes += before.received.discovery_bytes;
  start_s_ = now_s_() + lead_s;
  say_session(start_s_, false);
  const auto last =
      static_cast<std::uint64_t>(std::floor(options_.duration_s * options_.rate_hz + 1e-9));
  bool is_measuring = false;
  for (std::uint64_t number = 0; number <= last && !game::is_interrupted; ++number) {
    hear_until(start_s_ + static_cast<double>(number) / options_.rate_hz);
    if (game::is_interrupted) break;
    const std::uint64_t left_out = ticks_left_out(number, last);
    if (is_measuring) costs_.left_out += left_out;
    number += left_out;
    if (!is_measuring && static_cast<double>(number) / options_.rate_hz >= options_.warm_up_s)
      is_measuring = true, costs_.from_s = now_s_(), costs_.begin = costs_.end = counted();
    // The last tick closes the span and is not in it.
    if (number == last && is_measuring) end_span();
    tick(number, is_measuring && number < last);
    if (number < last) count_present();
  }
  if (is_measuring && costs_.span_s == 0.0) end_span();
  recorder_.end(game_.hash());
  if (game::is_interrupted) return;  // bots see that the server goes
  say_session(start_s_, true);
  bid_farewell();
}

/// Of a server that is late: those up to now where it is more than a second behind, and all but the
/// last when the game's time is up.
std::uint64_t DdsServer::ticks_left_out(std::uint64_t number, std::uint64_t last) const {
  assert(number <= last);
  const double behind_s = now_s_() - start_s_ - static_cast<double>(number) / options_.rate_hz,
               over_s = now_s_() - start_s_ - static_cast<double>(last) / options_.rate_hz;
  if (over_s >= 0.0) return last - number;
  return behind_s > 1.0 ? static_cast<std::uint64_t>(behind_s * options_.rate_hz) : 0;
}

void DdsServer::end_span() { costs_.span_s = now_s_() - costs_.from_s, costs_.end = counted(); }

/// Waits until the bots know that the game is over and have gone.
void DdsServer::bid_farewell() {
  constexpr double longest_s = 2.0;
  const double give_up_s = now_s_() + longest_s;
  for (std::uint32_t present = options_.clients; present > 0 && now_s_() < give_up_s;) {
    if (game::is_interrupted) return;
    hear_until(now_s_() + 0.005);
    present = present_count();
  }
}

void DdsServer::tick(std::uint64_t number, bool is_counted) {
  const double elapsed_s = static_cast<double>(number) / options_.rate_hz,
               simulated_s = begin_s_ + elapsed_s, due_s = start_s_ + elapsed_s;
  const double begin_s = now_s_();
  if (simulated_s > game_.now() || number == 0) game_.advance(std::max(simulated_s, game_.now()));
  const double played_s = now_s_();
  writers_.look(game_);
  const double looked_s = now_s_();
  writers_.send();
  const double sent_s = now_s_();
  recorder_.note({simulated_s, played_s - begin_s, looked_s - played_s, sent_s - looked_s},
                 writers_);
  if (!is_counted) return;
  costs_.physics_s += played_s - begin_s, costs_.filter_s += looked_s - played_s;
  costs_.send_s += sent_s - looked_s;
  ++costs_.ticks;
  if (now_s_() <= due_s + 1.0 / options_.rate_hz) ++costs_.on_time;
}

}  // namespace rink::loadgen
