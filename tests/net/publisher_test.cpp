// What a publisher says is what one says that looks at every entity at every tick, byte for byte.
#include "game/replication/publisher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "game/players/random_plan.h"
#include "game/replication/names.h"
#include "game/replication/trajectory.h"
#include "game/replication/trajectory_codec.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "tests/net/scenes.h"
#include "tests/places.h"

namespace rink::game {
namespace {

/// A federate that has joined a federation of its own.
struct Stage {
  explicit Stage(const rti::Fom& fom)
      : execution(fom, rti::FederationSettings{}), host(execution), ambassador(fom, callbacks) {
    hub.listen("rti");
    host.add(hub);
    link = std::make_unique<rti::FederateLink>(ambassador, endpoint, endpoint.connect("rti"));
    links.add(*link);
    ambassador.join("rink", "server", "server");
    for (int round = 0; round < 4; ++round) exchange();
  }
  void exchange() {
    link->flush(0.0);
    host.poll({});
    host.flush();
    endpoint.poll({}, links);
  }
  std::vector<std::byte> said() {
    const rti::Bytes bytes = ambassador.outgoing();
    std::vector<std::byte> copy(bytes.begin(), bytes.end());
    exchange();
    return copy;
  }

  rti::FederateAmbassador callbacks;
  rti::InProcessNetwork network;
  rti::InProcessEndpoint hub{network}, endpoint{network};
  rti::FederationExecution execution;
  rti::FederationHost host;
  rti::Ambassador ambassador;
  std::unique_ptr<rti::FederateLink> link;
  rti::FederateLinks links;
};

/// Asks policy and region about each entity at each tick, knowing nothing of changes.
class ScanningPublisher {
 public:
  ScanningPublisher(const ObjectModel& model, rti::Ambassador& ambassador, UpdatePolicy& policy,
                    const Game& game, const RegionSweep& sweep, bool hands_in_flights)
      : model_(model),
        ambassador_(ambassador),
        policy_(policy),
        sweep_(sweep),
        motion_(policy.motion_attribute(model)),
        hands_in_flights_(hands_in_flights) {
    ambassador_.publish_object_class_attributes(model_.entity,
                                                {model_.shape, model_.input, motion_});
    ambassador_.publish_object_class_attributes(model_.score, {model_.goals});
    ambassador_.publish_object_class_attributes(model_.field, {model_.extent, model_.drag});
    field_ = ambassador_.register_object_instance(model_.field, "field");
    score_ = ambassador_.register_object_instance(model_.score, "score");
    const physics::Field& field = game.world().spec().field;
    ambassador_.update_attribute_values(
        field_, {model_.extent, model_.drag},
        encode(encoded_, Extent{static_cast<float>(field.length), static_cast<float>(field.width)},
               policy.sent_drag(game.world().spec())),
        {});
    ambassador_.update_attribute_values(score_, {model_.goals}, encode(encoded_, goals_), {});
  }

  void publish(const Game& game, std::span<const std::uint32_t> felt, const rti::Stamp& stamp) {
    std::vector<rti::RegionBounds> moved;
    physics::Movers everybody;
    everybody.look(game.world());
    sweep_.look_at(game.world(), everybody);
    const auto retire_gone = [&] {
      for (std::uint32_t k = 0; k < published_.size(); ++k)
        if (published_[k].object && !game.is_there({k})) {
          ambassador_.delete_object_instance(published_[k].object);
          ambassador_.delete_region(published_[k].region);
          published_[k] = {};
        }
    };
    if (!game.spawned().empty()) retire_gone();
    for (const Entity& entity : game.entities()) {
      if (entity.id.index >= published_.size()) published_.resize(entity.id.index + 1);
      Input input;
      if (entity.player)
        input = {.count = felt[*entity.player], .held = game.keys_held(*entity.player).bits()};
      one(game, entity, input, stamp, moved);
    }
    retire_gone();
    if (!moved.empty()) ambassador_.commit_region_modifications(moved);
    const Goals goals{game.score().left, game.score().right,
                      static_cast<std::uint8_t>(game.is_over())};
    if (goals == goals_) return;
    goals_ = goals;
    ambassador_.update_attribute_values(score_, {model_.goals}, encode(encoded_, goals), stamp);
  }

 private:
  struct Published {
    rti::ObjectHandle object;
    rti::RegionHandle region;
    Position position;
    Input input;
    std::optional<std::uint32_t> flown;
    RegionSweep::Swept swept;
  };

  void one(const Game& game, const Entity& entity, const Input& input, const rti::Stamp& stamp,
           std::vector<rti::RegionBounds>& moved) {
    Published& each = published_[entity.id.index];
    const Vector2 centre = game.position(entity.id);
    const im::Region box = bounding_box(centre, entity.half_extent);
    rti::AttributeSet sent;
    encoded_.clear();
    rti::Writer writer(encoded_);
    if (!each.object) {
      each.object = ambassador_.register_object_instance(
          model_.entity, entity.player ? bat_name(*entity.player) : "");
      each.region = ambassador_.create_region();
      each.position = rounded(centre);
      each.input = input;
      ambassador_.set_region(
          each.region, sweep_.is_on() ? sweep_.region(game.world(), entity.id, each.swept) : box);
      ambassador_.commit_region_modifications(each.region);
      ambassador_.associate_regions_for_updates(each.object, each.region);
      const Resistance own = policy_.sent_drag(game.world().spec()).of(entity.kind);
      Shape shape{
          .kind = static_cast<std::uint8_t>(entity.kind),
          .team = static_cast<std::uint8_t>(entity.team),
          .half_length = static_cast<float>(entity.half_extent.x()),
          .half_width = static_cast<float>(entity.half_extent.y()),
          .drag = static_cast<float>(own.drag),
          .friction = static_cast<float>(own.friction),
          .thrust = entity.player ? static_cast<float>(key_thrust(game, *entity.player)) : 0.0f,
          .mass = std::isfinite(game.world().mass(entity.id))
                      ? static_cast<float>(game.world().mass(entity.id))
                      : 0.0f};
      encode(encoded_, shape, input);
      rti::Writer motion(encoded_);
      policy_.write(game, entity, motion);
      ambassador_.update_attribute_values(each.object, {model_.shape, model_.input, motion_},
                                          encoded_, stamp);
      return;
    }
    follow(game, entity, each, box, moved);
    const bool is_due = policy_.is_due(game, entity), has_felt = input != each.input;
    if (!is_due && !has_felt) return;
    if (has_felt) {
      each.input = input;
      sent.insert(model_.input);
      exchange(writer, each.input);
    }
    if (is_due) {
      sent.insert(motion_);
      policy_.write(game, entity, writer);
    }
    ambassador_.update_attribute_values(each.object, sent, encoded_, stamp);
  }

  void follow(const Game& game, const Entity& entity, Published& each, const im::Region& box,
              std::vector<rti::RegionBounds>& moved) {
    const physics::World& world = game.world();
    if (sweep_.is_on()) {
      if (!sweep_.still_holds(world, entity.id, each.swept))
        moved.push_back({each.region, sweep_.region(world, entity.id, each.swept)});
      return;
    }
    if (entity.kind == physics::BodyKind::post) return;
    if (hands_in_flights_) {
      const std::uint32_t version = world.motion_version(entity.id);
      if (world.is_in_play(entity.id) && each.flown == version) return;
      const physics::Motion motion = world.motion(entity.id);
      const bool has_law = motion.drag == Vector2::Constant(world.spec().puck_drag) &&
                           motion.rest_time == std::numeric_limits<double>::infinity();
      each.flown.reset();
      if (world.is_in_play(entity.id) && motion.acceleration.isZero(0.0) &&
          (has_law || motion.velocity.isZero(0.0))) {
        each.flown = version;
        each.position = rounded(game.position(entity.id));
        moved.push_back({each.region, box});
        return;
      }
    }
    const Position position = rounded(game.position(entity.id));
    if (position == each.position) return;
    each.position = position;
    moved.push_back({each.region, box});
  }

  const ObjectModel& model_;
  rti::Ambassador& ambassador_;
  UpdatePolicy& policy_;
  RegionSweep sweep_;
  const rti::AttributeHandle motion_;
  const bool hands_in_flights_;
  std::vector<Published> published_;
  std::vector<std::byte> encoded_;
  rti::ObjectHandle field_, score_;
  Goals goals_;
};

/// Everything that a game has: keys, goals and face-offs, who leaves and comes back, pucks that
/// rest, friction.
std::vector<InputEvent> eventful_keys(const Scene& scene, double seconds) {
  std::vector<InputEvent> keys = keys_for(scene, 5, seconds);
  for (const auto& [time, kind] : {std::pair{1.0, InputKind::leave},
                                   {1.5, InputKind::enter},
                                   {2.01, InputKind::leave},
                                   {2.02, InputKind::enter}})
    keys.push_back({.time = time, .player = 0, .kind = kind, .key = Key::up});
  return keys;
}

/// Answers how many goals there were.
std::uint32_t expect_the_same(const Scene& scene, const std::string& policy,
                              std::uint32_t sweep_ticks, bool hands_in_flights) {
  SCOPED_TRACE(policy + ", swept over " + std::to_string(sweep_ticks) +
               (hands_in_flights ? ", with flights" : ""));
  constexpr double tick_s = 1.0 / 30.0;
  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectModel model(fom);
  Stage ours(fom), theirs(fom);
  const auto our_policy = make_update_policy(policy), their_policy = make_update_policy(policy);
  Game game(scene);
  for (const InputEvent& event : eventful_keys(scene, 4.0)) game.submit(event);
  Publisher publisher(model, ours.ambassador, *our_policy, game, {sweep_ticks, tick_s});
  if (hands_in_flights) publisher.hand_in_flights();
  ScanningPublisher reference(model, theirs.ambassador, *their_policy, game, {sweep_ticks, tick_s},
                              hands_in_flights);
  std::vector<std::uint32_t> felt(game.player_count());
  for (std::uint32_t tick = 0; tick < 120; ++tick) {
    game.advance(tick * tick_s);
    for (std::uint32_t player = 0; player < felt.size(); ++player)
      felt[player] = game.input_count(player);
    const rti::Stamp stamp{game.now(), tick};
    publisher.publish(game, felt, stamp);
    reference.publish(game, felt, stamp);
    if (ours.said() != theirs.said()) {
      ADD_FAILURE() << "other bytes at tick " << tick;
      break;
    }
  }
  if (policy == "on-event" && sweep_ticks == 0 && hands_in_flights) {
    EXPECT_LT(publisher.counters().entities_looked_at, 120 * game.entities().size() * 2 / 3);
  }
  return game.score().left + game.score().right;
}

Scene rough_crowd() {
  Scene scene = small_crowd();
  scene.world.puck_drag = 0.3;
  scene.world.puck_friction = 0.4;
  return scene;
}

TEST(PublisherTest, SaysByteForByteWhatOneSaysThatLooksAtEveryEntityAtEveryTick) {
  std::uint32_t goals = 0;
  for (const Scene& scene : {small_crowd(), match(), rough_crowd()})
    for (const std::string& policy : update_policy_names())
      for (const std::uint32_t sweep_ticks : {0u, 1u, 3u})
        for (const bool hands_in_flights : {false, true})
          if (sweep_ticks == 0 || !hands_in_flights)
            goals += expect_the_same(scene, policy, sweep_ticks, hands_in_flights);
  EXPECT_GT(goals, 0u) << "scored pucks lie still until their face-off";
}

/// A second federate on a stage, which sees the entities that are in its region's scope.
struct Watcher {
  Watcher(Stage& the_stage, const rti::Fom& fom)
      : stage(the_stage),
        endpoint(the_stage.network),
        ambassador(fom, callbacks),
        link(ambassador, endpoint, endpoint.connect("rti")) {
    links.add(link);
    ambassador.join("rink", "watcher", "watcher");
    for (int round = 0; round < 4; ++round) exchange();
  }
  void exchange() {
    link.flush(0.0);
    stage.exchange();
    endpoint.poll({}, links);
  }
  bool sees(rti::ObjectHandle object) {
    exchange();
    stage.host.match();
    return stage.execution.is_in_scope(ambassador.federate(), object);
  }

  Stage& stage;
  rti::FederateAmbassador callbacks;
  rti::InProcessEndpoint endpoint;
  rti::Ambassador ambassador;
  rti::FederateLink link;
  rti::FederateLinks links;
};

TEST(PublisherTest, HidesAnEntityFromAllWithRegionsUntilItIsShownWhereItIsThen) {
  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectModel model(fom);
  for (const std::string& policy_name : update_policy_names()) {
    Stage stage(fom);
    const auto policy = make_update_policy(policy_name);
    Game game(small_crowd());
    Publisher publisher(model, stage.ambassador, *policy, game);
    std::vector<std::uint32_t> felt(game.player_count());
    const auto publish = [&](double until) {
      game.advance(until);
      publisher.publish(game, felt, {game.now(), 0});
    };
    publish(0.0);
    const EntityId puck = game.entities().back().id;
    Watcher watcher(stage, fom);
    const rti::RegionHandle region = watcher.ambassador.create_region();
    const auto look_at = [&](const Vector2& place) {
      watcher.ambassador.set_region(
          region, {place.x() - 0.05, place.y() - 0.05, place.x() + 0.05, place.y() + 0.05});
      watcher.ambassador.commit_region_modifications(region);
    };
    look_at(game.position(puck));
    watcher.ambassador.subscribe_object_class_attributes(model.entity, {model.shape}, region);
    ASSERT_TRUE(watcher.sees(publisher.object(puck)));

    publisher.hide(puck), publisher.hide(puck);
    EXPECT_EQ(publisher.hidden_count(), 1u);
    EXPECT_FALSE(watcher.sees(publisher.object(puck)));
    publish(0.5);
    look_at(game.position(puck));
    EXPECT_FALSE(watcher.sees(publisher.object(puck)));

    publisher.show(puck), publisher.show(puck);
    EXPECT_EQ(publisher.hidden_count(), 0u);
    publish(1.0);
    look_at(game.position(puck));
    EXPECT_TRUE(watcher.sees(publisher.object(puck))) << policy_name;
    publish(1.5);
    look_at(game.position(puck));
    EXPECT_TRUE(watcher.sees(publisher.object(puck))) << "it is followed";
  }
}

}  // namespace
}  // namespace rink::game
