// Steps server, RTI and clients by turns; a round in which nothing is sent ends the exchange.
#include "tests/net/lockstep_rink.h"

#include "game/net/server/push_exact.h"
#include "game/net/server/push_filter_hints.h"
#include "game/net/server/serve_report.h"
#include "game/replication/filter_setup.h"
#include "game/replication/trajectory_codec.h"
#include "tests/places.h"

namespace rink::game {
namespace {

rti::FederationSettings federation_settings(const Scene& scene, const std::string& scheme,
                                            rti::UpdateRate update_rate) {
  rti::FederationSettings settings;
  settings.update_rate = update_rate;
  settings.federation = "rink";
  settings.filter = scheme;
  settings.filter_settings = filter_settings(scene, 0.0);
  return settings;
}

}  // namespace

LockstepRink::LockstepRink(const Scene& scene, const LockstepSettings& settings)
    : settings_(settings),
      fom_(load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml")),
      model_(fom_),
      hub_(network_),
      server_endpoint_(network_),
      execution_(fom_, federation_settings(scene, settings.scheme, settings.update_rate)),
      host_(execution_) {
  hub_.listen("rti");
  if (settings.is_recorded) {
    ledger_ = &add_ledger(staged_, fom_);
    recording_ = &staged_.add<RecordingStage>();
  }
  host_.add(staged_);
  server_ = std::make_unique<Server>(fom_, scene, settings.server, [this] { return now; });
  server_link_ = std::make_unique<rti::FederateLink>(server_->ambassador(), server_endpoint_,
                                                     server_endpoint_.connect("rti"));
  server_links_.add(*server_link_);
  if (execution_.filter().traits().uses_flights) server_->hand_in_flights();
  if (settings.server.policy == exact_policy)
    exact_.emplace(server_->game(), scene, fom_, 1.0 / settings.rate_hz);
  settle();
  for (std::uint32_t k = 0; k < settings.clients; ++k) add_client("bat-" + std::to_string(k));
}

Client& LockstepRink::add_client(const std::string& name, bool only_watches) {
  auto player = std::make_unique<Player>(network_);
  const ClientSettings settings{.federation = "rink",
                                .name = name,
                                .view_fraction = settings_.view_fraction,
                                .view_margin = settings_.view_margin,
                                .declares_regions = settings_.declares_regions,
                                .extrapolates = settings_.extrapolates,
                                .only_watches = only_watches,
                                .computes = clients_.size() >= settings_.told};
  player->client = std::make_unique<Client>(fom_, model_, settings);
  player->link = std::make_unique<rti::FederateLink>(player->client->ambassador(), player->endpoint,
                                                     player->endpoint.connect("rti"));
  player->links.add(*player->link);
  clients_.push_back(std::move(player));
  return *clients_.back()->client;
}

void LockstepRink::kill(std::size_t index) {
  Player& player = *clients_[index];
  player.is_dead = true;
  player.endpoint.close(player.link->connection());
}

void LockstepRink::leave(std::size_t index) {
  Player& player = *clients_[index];
  player.client->ambassador().resign();
  player.link->flush(now);
  player.is_dead = true;
}

void LockstepRink::settle() {
  constexpr int rounds = 6;  // a join takes five: join, joined, seat, region, state
  for (int round = 0; round < rounds; ++round) {
    host_.poll({});
    host_.flush();
    server_endpoint_.poll({}, server_links_);
    server_link_->flush(now);
    for (const std::unique_ptr<Player>& player : clients_) {
      player->endpoint.poll({}, player->links);
      if (player->is_dead) continue;
      player->client->follow_bat(now);
      player->link->flush(now);
    }
  }
}

void LockstepRink::start() {
  for (int round = 0; round < 4; ++round) {
    settle();
    send_tick(0.0);
    settle();
  }
  server_->call_to_start();
  settle();
}

void LockstepRink::send_tick(double time) {
  const rti::Stamp stamp{.time = time, .tag = static_cast<std::uint64_t>(1e9 * (time + 1.0))};
  server_->publish(stamp);
  server_link_->flush(now);
  host_.poll({});
  push_filter_hints(*server_, execution_, facts_);
  host_.match();
  if (exact_) push_exact(*server_, *exact_, stamp, execution_);
  host_.flush();
  host_.advance_clock(now);
}

void LockstepRink::tick() {
  settle();
  const double time = static_cast<double>(++tick_number) / settings_.rate_hz;
  now = time;
  server_->simulate(time);
  if (exact_) exact_->look();
  send_tick(time);
  settle();
}

void LockstepRink::run(double seconds) {
  for (const double until = now + seconds; now + 0.5 / settings_.rate_hz < until;) tick();
}

}  // namespace rink::game
