// A sample per body and tick, batched by cell.
#include "loadgen/dds/state_writers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include <dds/dds.h>
#include <topics.h>

namespace rink::loadgen {

StateWriters::StateWriters(const Domain& domain, const PartitionGrid& grid) : grid_(grid) {
  dds_write_set_batch(true);
  writers_.reserve(grid.size());
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    writers_.push_back(
        make_writer(domain, domain.states(), grid.name_of(cell), Delivery::best_effort).own);
  is_used_.resize(grid.size());
}

void StateWriters::look(const game::Game& game) {
  stamp_ns_ = std::llround(1e9 * game.now());
  shown_.clear(), left_.clear();
  shown_.reserve(game.entities().size());
  is_there_.assign(is_there_.size(), false);
  for (const game::Entity& entity : game.entities()) {
    const std::uint32_t body = entity.id.index;
    if (body >= cell_of_.size()) cell_of_.resize(body + 1, nowhere), is_there_.resize(body + 1);
    const physics::Vector2 place = game.position(entity.id);
    const std::uint32_t cell = grid_.cell_at(place);
    if (cell_of_[body] != cell && cell_of_[body] != nowhere)
      left_.push_back({body, cell_of_[body]}), ++crossings_;
    cell_of_[body] = cell, is_there_[body] = true;
    shown_.push_back({body, cell, place, game.velocity(entity.id)});
  }
  for (std::uint32_t body = 0; body < cell_of_.size(); ++body)
    if (!is_there_[body] && cell_of_[body] != nowhere)
      left_.push_back({body, std::exchange(cell_of_[body], nowhere)});
}

void StateWriters::send() {
  send_all();
  unregister_left();
}

void StateWriters::send_all() {
  for (const Shown& body : shown_) {
    const rink_dds_State state{.body = body.body,
                               .x = static_cast<float>(body.position.x()),
                               .y = static_cast<float>(body.position.y()),
                               .vx = static_cast<float>(body.velocity.x()),
                               .vy = static_cast<float>(body.velocity.y())};
    require(dds_write_ts(writers_[body.cell], &state, stamp_ns_), "writing a state");
    is_used_[body.cell] = true;
    ++written_;
  }
  for (std::uint32_t cell = 0; cell < writers_.size(); ++cell)
    if (is_used_[cell]) dds_write_flush(writers_[cell]), is_used_[cell] = false;
}

void StateWriters::unregister_left() {
  for (const Left& body : left_) {
    const rink_dds_State key{.body = body.body, .x = 0.0f, .y = 0.0f, .vx = 0.0f, .vy = 0.0f};
    require(dds_unregister_instance_ts(writers_[body.cell], &key, stamp_ns_),
            "unregistering a body");
    is_used_[body.cell] = true;
  }
  for (const Left& body : left_)
    if (is_used_[body.cell]) dds_write_flush(writers_[body.cell]), is_used_[body.cell] = false;
}

std::vector<std::uint32_t> StateWriters::players_reading(DdsEntity writer) {
  std::vector<dds_instance_handle_t> readers(256);
  auto count = dds_get_matched_subscriptions(writer, readers.data(), readers.size());
  if (count > static_cast<dds_return_t>(readers.size())) {
    readers.resize(static_cast<std::size_t>(count));
    count = dds_get_matched_subscriptions(writer, readers.data(), readers.size());
  }
  readers.resize(std::min(readers.size(), static_cast<std::size_t>(std::max(count, 0))));
  std::vector<std::uint32_t> players;
  for (const dds_instance_handle_t reader : readers) {
    if (const auto known = player_of_reader_.find(reader); known != player_of_reader_.end()) {
      players.push_back(known->second);
      continue;
    }
    auto* const data = dds_get_matched_subscription_data(writer, reader);
    if (data == nullptr) continue;
    void* said = nullptr;
    std::size_t size = 0;
    std::uint32_t player = 0;
    if (dds_qget_userdata(data->qos, &said, &size) && size == sizeof player) {
      std::memcpy(&player, said, size);
      players.push_back(player_of_reader_[reader] = player);
    }
    dds_free(said);
    dds_builtintopic_free_endpoint(data);
  }
  return players;
}

std::map<std::uint32_t, std::vector<std::uint32_t>> StateWriters::scopes() {
  std::vector<std::vector<std::uint32_t>> bodies(writers_.size());
  for (const Shown& body : shown_) bodies[body.cell].push_back(body.body);
  std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
  for (std::uint32_t cell = 0; cell < writers_.size(); ++cell)
    for (const std::uint32_t player : players_reading(writers_[cell]))
      scopes[player].insert(scopes[player].end(), bodies[cell].begin(), bodies[cell].end());
  for (auto& [player, scope] : scopes) std::sort(scope.begin(), scope.end());
  return scopes;
}

}  // namespace rink::loadgen
