// A reader for each cell: the library cannot change the partitions of one that is there.
#include "loadgen/dds/dds_bot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <dds/dds.h>
#include <topics.h>
#include "game/net/view.h"

namespace rink::loadgen {
namespace {

/// A bat that has not been heard of for so long has left the cells that are read.
constexpr double lost_after_s = 0.5;

}  // namespace

DdsBot::DdsBot(const DdsBotsOptions& options, std::uint32_t number, DdsEntity waiting,
               Listener& listener, std::uint32_t instances_before)
    : options_(options),
      number_(number),
      waiting_(waiting),
      listener_(listener),
      domain_(Domain::of_bot(options.domain, instances_before + number)),
      view_(options.view_margin) {
  sessions_ = make_reader(domain_, domain_.sessions(), {}, Delivery::kept, number);
  inputs_ = make_writer(domain_, domain_.inputs(), {}, Delivery::all);
  attach(sessions_.own);
}

void DdsBot::attach(DdsEntity reader) const {
  const std::uint64_t which =
      std::uint64_t{number_} << 32 | static_cast<std::uint64_t>(static_cast<std::uint32_t>(reader));
  require(dds_waitset_attach(waiting_, reader, static_cast<dds_attach_t>(which)), "attaching");
}

void DdsBot::take(DdsEntity reader) {
  if (reader == sessions_.own) return take_session();
  const auto found = std::ranges::find_if(
      readers_, [&](const Reader& each) { return each.endpoint.own == reader; });
  if (found != readers_.end()) take_states(*found);
}

void DdsBot::take_session() {
  void* place = nullptr;
  dds_sample_info_t info;
  while (require(dds_take(sessions_.own, &place, &info, 1, 1), "taking the session") == 1) {
    const auto& said = *static_cast<const rink_dds_Session*>(place);
    if (info.valid_data) {
      if (number_ >= said.seats._length) {
        const std::string seats = std::to_string(said.seats._length);
        dds_return_loan(sessions_.own, &place, 1);
        throw DdsError("bot " + std::to_string(number_ + 1) + " has no seat: the game has " +
                       seats + "; expected a --count of at most that");
      }
      DdsSession session;
      session.seats = said.seats._length;
      if (said.origin_ns > 0) session.origin_s = 1e-9 * static_cast<double>(said.origin_ns);
      session.begin_s = said.begin_s, session.rate_hz = said.rate_hz;
      session.cell_size = said.cell_size, session.extent = said.extent;
      session.field = {said.low_x, said.low_y, said.high_x, said.high_y};
      session.is_over = said.is_over;
      session.body = said.seats._buffer[number_].body;
      session.place = {said.seats._buffer[number_].x, said.seats._buffer[number_].y};
      session_ = session;
    }
    dds_return_loan(sessions_.own, &place, 1);
    place = nullptr;
  }
}

void DdsBot::take_states(const Reader& reader) {
  constexpr std::size_t most = 256;
  std::array<rink_dds_State, most> states;
  std::array<void*, most> places;
  std::array<dds_sample_info_t, most> infos;
  for (std::size_t k = 0; k < most; ++k) places[k] = &states[k];
  for (;;) {
    const auto count = static_cast<std::size_t>(require(
        dds_take(reader.endpoint.own, places.data(), infos.data(), most, most), "taking states"));
    for (std::size_t k = 0; k < count; ++k) {
      const rink_dds_State& state = states[k];
      if (state.body >= replicas_.size()) replicas_.resize(state.body + std::size_t{1});
      DdsReplica& replica = replicas_[state.body];
      const std::int64_t stamp_ns = infos[k].source_timestamp;
      if (infos[k].valid_data && stamp_ns >= replica.stamp_ns) {
        const bool is_new = !replica.is_known;
        replica = {true, reader.cell, stamp_ns, {state.x, state.y}, {state.vx, state.vy}};
        newest_ns_ = std::max(newest_ns_, stamp_ns);
        ++states_;
        if (is_new) listener_.scope_changed(*this, state.body, true);
        listener_.state_came(*this, state.body, stamp_ns);
      }
      if (infos[k].instance_state != DDS_IST_ALIVE)
        left_.push_back({state.body, reader.cell, stamp_ns});
    }
    if (count < most) return;
  }
}

/// Who crosses is written in its new cell first, but readers are asked in no such order: so they
/// are asked once more before a body that left is let go. What leaves meanwhile waits.
void DdsBot::settle() {
  if (!left_.empty()) {
    const std::vector<Left> left = std::exchange(left_, {});
    for (const Reader& reader : readers_) take_states(reader);
    for (const Left& each : left) {
      const DdsReplica& replica = replicas_[each.body];
      const bool is_back = replica.stamp_ns > each.stamp_ns;
      if (replica.is_known && replica.cell == each.cell && !is_back) forget(each.body);
    }
  }
  forget_silent();
}

/// All bodies in the cells that are read are written at each tick, so who is silent for long has
/// left, and the word of it was lost.
void DdsBot::forget_silent() {
  constexpr auto lost_after_ns = static_cast<std::int64_t>(1e9 * lost_after_s);
  if (newest_ns_ - swept_ns_ < lost_after_ns / 2) return;
  swept_ns_ = newest_ns_;
  for (std::uint32_t body = 0; body < replicas_.size(); ++body)
    if (replicas_[body].is_known && newest_ns_ - replicas_[body].stamp_ns > lost_after_ns)
      forget(body);
}

void DdsBot::forget(std::uint32_t body) {
  replicas_[body].is_known = false;
  listener_.scope_changed(*this, body, false);
}

void DdsBot::forget_cell(std::uint32_t cell) {
  for (std::uint32_t body = 0; body < replicas_.size(); ++body)
    if (replicas_[body].is_known && replicas_[body].cell == cell) forget(body);
}

double DdsBot::half_side() const {
  const im::Region& field = session_->field;
  return game::view_half_side(options_.view_area, options_.view_fraction,
                              field.high_x - field.low_x, field.high_y - field.low_y);
}

/// Bodies belong to the cells of their centres, so that those of the region grown by the largest
/// body's half hold all that touch the region.
void DdsBot::follow(double now_s) {
  if (!session_) return;
  const bool is_first = !grid_;
  if (is_first) grid_.emplace(session_->field, session_->cell_size), bat_seen_s_ = now_s;
  if (grid_->size() == 1) {
    if (is_first) read_cells({0});
    return;
  }
  const DdsReplica* const bat =
      session_->body < replicas_.size() ? &replicas_[session_->body] : nullptr;
  const bool is_seen = bat != nullptr && bat->is_known;
  if (is_seen || !session_->origin_s) bat_seen_s_ = now_s;
  if (now_s - bat_seen_s_ > lost_after_s && !reads_all_) {
    std::vector<std::uint32_t> all(grid_->size());
    std::iota(all.begin(), all.end(), 0u);
    reads_all_ = true;
    return read_cells(all);
  }
  if (!is_first && (!is_seen || (!reads_all_ && !view_.is_left_by(bat->position)))) return;
  im::Region region = view_.look_around(is_seen ? bat->position : session_->place, half_side());
  region = {region.low_x - session_->extent, region.low_y - session_->extent,
            region.high_x + session_->extent, region.high_y + session_->extent};
  reads_all_ = false;
  read_cells(grid_->cells_of(region));
}

void DdsBot::read_cells(const std::vector<std::uint32_t>& cells) {
  std::vector<Reader> kept;
  kept.reserve(cells.size());
  for (const Reader& reader : readers_) {
    if (std::ranges::binary_search(cells, reader.cell)) {
      kept.push_back(reader);
      continue;
    }
    forget_cell(reader.cell);
    require(dds_delete(reader.endpoint.group), "leaving a cell");
  }
  for (const std::uint32_t cell : cells) {
    if (std::ranges::any_of(readers_, [&](const Reader& each) { return each.cell == cell; }))
      continue;
    kept.push_back({cell, make_reader(domain_, domain_.states(), grid_->name_of(cell),
                                      Delivery::best_effort, number_)});
    attach(kept.back().endpoint.own);
    ++cells_joined_;
  }
  std::ranges::sort(kept, {}, &Reader::cell);
  readers_ = std::move(kept);
}

bool DdsBot::say_ready() {
  if (is_ready_ || readers_.empty()) return is_ready_;
  for (const Reader& reader : readers_) {
    dds_subscription_matched_status_t matched;
    require(dds_get_subscription_matched_status(reader.endpoint.own, &matched), "finding a writer");
    if (matched.current_count == 0) return false;
  }
  dds_publication_matched_status_t heard;
  require(dds_get_publication_matched_status(inputs_.own, &heard), "finding the server");
  if (heard.current_count == 0) return false;
  const rink_dds_Input ready{.player = number_, .kind = 2, .symbol = 0, .due_ns = 0};
  require(dds_write(inputs_.own, &ready), "writing that a bot is ready");
  dds_write_flush(inputs_.own);
  return is_ready_ = true;
}

bool DdsBot::is_server_there() const {
  dds_subscription_matched_status_t matched;
  require(dds_get_subscription_matched_status(sessions_.own, &matched), "finding the server");
  return matched.current_count > 0;
}

void DdsBot::press(const KeyChange& change, double due_s) const {
  const rink_dds_Input input{.player = number_,
                             .kind = static_cast<std::uint8_t>(change.is_down ? 0 : 1),
                             .symbol = static_cast<std::uint8_t>(change.key),
                             .due_ns = std::llround(1e9 * due_s)};
  require(dds_write(inputs_.own, &input), "writing a key");
  dds_write_flush(inputs_.own);
}

}  // namespace rink::loadgen
