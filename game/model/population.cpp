// Finds a place for every body of a scene: those placed by hand are checked, populations are drawn
// from the seed.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <sstream>

#include "game/model/random_stream.h"
#include "game/model/scene.h"
#include "game/physics/world.h"

namespace rink::game {
namespace {

using physics::BodyKind;

std::string place_text(const Vector2& position) {
  std::ostringstream text;
  text.precision(10);
  text << "[" << position.x() << ", " << position.y() << "]";
  return text.str();
}

/// What a body covers: a rectangle of `half_extent` grown by `radius`.
struct Outline {
  std::string name;
  Vector2 position, half_extent;
  double radius;

  double gap(const Outline& other) const {
    const Vector2 apart =
        ((position - other.position).cwiseAbs() - half_extent - other.half_extent).cwiseMax(0.0);
    return apart.norm() - radius - other.radius;
  }
};

Outline outline(const Puck& puck) {
  return {puck.name, puck.body.position, Vector2::Zero(), puck.body.radius};
}
Outline outline(const Bat& bat) { return {bat.name, bat.body.position, bat.body.half_extent, 0.0}; }
Outline outline(const Post& post) {
  return {post.name, post.body.position, Vector2::Zero(), post.body.radius};
}

std::vector<Outline> outlines(const Bodies& bodies) {
  std::vector<Outline> all;
  for (const Post& post : bodies.posts) all.push_back(outline(post));
  for (const Bat& bat : bodies.bats) all.push_back(outline(bat));
  for (const Puck& puck : bodies.pucks) all.push_back(outline(puck));
  return all;
}

/// Fills a field body by body; an engine's world checks whether a place is free, so that placement
/// and engine agree.
class Placement {
 public:
  explicit Placement(Scene& scene)
      : scene_(scene), world_(scene.world), field_(scene.world.field) {}

  void place_all() {
    check_placed();
    scene_.bodies = scene_.placed;
    // Large bodies first: they are the hardest to place.
    for (const BodyKind kind : {BodyKind::post, BodyKind::bat})
      for (std::size_t k = 0; k < scene_.populations.size(); ++k)
        if (scene_.populations[k].kind == kind) populate_at_random(k);
    place_pucks();
    assert(world_.body_count() == wanted_count() && world_.body_count() == placed_count());
  }

 private:
  static constexpr int try_max = 300;
  /// Random places are tried for up to this part of the area; they would jam at 0.547 (Renyi's
  /// parking in the plane) and get slow before.
  static constexpr double random_packing_max = 0.4;
  static constexpr double clearance =
      1e-9;  ///< between the sites of a lattice, relative, so that rounding causes no overlap

  /// Bodies that the scene asks for, and those that have a place.
  std::uint64_t wanted_count() const {
    std::uint64_t count = count_of(scene_.placed);
    for (const Population& population : scene_.populations) count += population.count;
    return count;
  }
  std::uint64_t placed_count() const { return count_of(scene_.bodies); }

  void check_placed() {
    const Bodies& placed = scene_.placed;
    std::vector<Outline> before;
    for (const Post& post : placed.posts) check(outline(post), before), world_.add(post.body);
    for (const Bat& bat : placed.bats)
      check(outline(bat), before), check_half(bat), world_.add(bat.body);
    for (const Puck& puck : placed.pucks) check(outline(puck), before), world_.add(puck.body);
  }

  bool is_free(const Outline& body) const {
    return body.half_extent == Vector2::Zero() ? world_.is_free(body.position, body.radius)
                                               : world_.is_free(body.position, body.half_extent);
  }

  bool is_inside(const Outline& body) const {
    const Vector2 reach = body.half_extent + Vector2::Constant(body.radius);
    return (body.position - reach).minCoeff() >= 0.0 &&
           body.position.x() + reach.x() <= field_.length &&
           body.position.y() + reach.y() <= field_.width;
  }

  void check(const Outline& body, std::vector<Outline>& before) const {
    const bool is_allowed = scene_.world.allow_overlap ? is_inside(body) : is_free(body);
    if (!is_allowed) refuse(body, before);
    before.push_back(body);
  }

  [[noreturn]] void refuse(const Outline& body, const std::vector<Outline>& before) const {
    for (const Outline& other : scene_.world.allow_overlap ? std::vector<Outline>() : before)
      if (body.gap(other) < 0.0 ||
          (body.gap(other) <= 0.0 && body.radius == 0.0 && other.radius == 0.0))
        throw PlacementError(body.name, body.name + " at " + place_text(body.position) +
                                            " overlaps " + other.name + " at " +
                                            place_text(other.position));
    std::ostringstream text;
    text << body.name << " at " << place_text(body.position)
         << " is not wholly within the field of " << field_.length << " m x " << field_.width
         << " m";
    throw PlacementError(body.name, text.str());
  }

  /// The part of the field in which a bat of `team` must stay.
  physics::Half half_of(Team team) const {
    if (!field_.bats_keep_to_half || team == Team::none) return physics::Half::both;
    return team == Team::left ? physics::Half::left : physics::Half::right;
  }

  void check_half(const Bat& bat) const {
    const double halfway = field_.length / 2, x = bat.body.position.x(),
                 reach = bat.body.half_extent.x();
    const bool is_out = (bat.body.half == physics::Half::left && x + reach > halfway) ||
                        (bat.body.half == physics::Half::right && x - reach < halfway);
    if (is_out)
      throw PlacementError(bat.name, bat.name + " at " + place_text(bat.body.position) +
                                         " is not wholly within its team's half");
  }

  RandomStream stream_of(std::size_t population) const {
    return RandomStream(scene_.seed, population);
  }

  void populate_at_random(std::size_t k) {
    const Population& population = scene_.populations[k];
    RandomStream random = stream_of(k);
    for (std::uint32_t i = 0; i < population.count; ++i) {
      const bool is_placed = population.kind == BodyKind::post  ? add_post(population, i, random)
                             : population.kind == BodyKind::bat ? add_bat(population, i, random)
                                                                : add_puck(population, i, random);
      if (!is_placed) refuse(population, i);
    }
  }

  [[noreturn]] static void refuse(const Population& population, std::uint32_t placed) {
    throw PlacementError(population.name,
                         "the population " + population.name + " does not fit: found place for " +
                             std::to_string(placed) + " of " + std::to_string(population.count) +
                             "; make the field larger, or the bodies smaller or fewer");
  }

  std::optional<Vector2> random_place(RandomStream& random, const Vector2& half_extent,
                                      double radius, physics::Half half) const {
    assert(half_extent.minCoeff() >= 0.0 && radius >= 0.0);
    const Vector2 reach = half_extent + Vector2::Constant(radius);
    Vector2 low = reach, high = Vector2(field_.length, field_.width) - reach;
    if (half == physics::Half::left) high.x() = field_.length / 2 - reach.x();
    if (half == physics::Half::right) low.x() = field_.length / 2 + reach.x();
    if ((high - low).minCoeff() < 0.0) return std::nullopt;
    for (int attempt = 0; attempt < try_max; ++attempt) {
      const double x = random.uniform(low.x(), high.x()), y = random.uniform(low.y(), high.y());
      if (is_free({{}, {x, y}, half_extent, radius})) return Vector2(x, y);
    }
    return std::nullopt;
  }

  static std::string name_of(const Population& population, std::uint32_t i) {
    return population.name + "-" + std::to_string(i);
  }

  bool add_post(const Population& population, std::uint32_t i, RandomStream& random) {
    const double radius = random.uniform(population.radius_min, population.radius_max);
    const auto place = random_place(random, Vector2::Zero(), radius, physics::Half::both);
    if (!place) return false;
    scene_.bodies.posts.push_back(
        {name_of(population, i),
         {.position = *place, .radius = radius, .material = population.material}});
    world_.add(scene_.bodies.posts.back().body);
    return true;
  }

  bool add_bat(const Population& population, std::uint32_t i, RandomStream& random) {
    const Team team = population.team.value_or(i % 2 == 0 ? Team::left : Team::right);
    const physics::Half half = half_of(team);
    const auto place = random_place(random, population.half_extent, 0.0, half);
    if (!place) return false;
    scene_.bodies.bats.push_back({.name = name_of(population, i),
                                  .body = {.position = *place,
                                           .half_extent = population.half_extent,
                                           .mass = population.mass,
                                           .material = population.material,
                                           .half = half},
                                  .thrust = population.thrust,
                                  .team = team});
    world_.add(scene_.bodies.bats.back().body);
    return true;
  }

  Puck make_puck(const Population& population, std::uint32_t i, const Vector2& place, double radius,
                 RandomStream& random) const {
    return {name_of(population, i),
            {.position = place,
             .velocity = speed(population, random) * random.direction(),
             .radius = radius,
             .mass = population.mass,
             .material = population.material}};
  }

  static double speed(const Population& population, RandomStream& random) {
    const double mean = population.mean_speed;
    assert(mean >= 0.0);
    if (population.speeds == SpeedDistribution::fixed) return mean;
    if (population.speeds == SpeedDistribution::uniform) return random.uniform(0.0, 2.0 * mean);
    double drawn = random.maxwell(mean);
    while (drawn > 5.0 * mean) drawn = random.maxwell(mean);
    return drawn;
  }

  bool add_puck(const Population& population, std::uint32_t i, RandomStream& random) {
    const double radius = random.uniform(population.radius_min, population.radius_max);
    const auto place = random_place(random, Vector2::Zero(), radius, physics::Half::both);
    if (!place) return false;
    scene_.bodies.pucks.push_back(make_puck(population, i, *place, radius, random));
    world_.add(scene_.bodies.pucks.back().body);
    return true;
  }

  double covered() const {
    double area = 0.0;
    for (const Outline& body : outlines(scene_.bodies))
      area += 4.0 * body.half_extent.prod() + 4.0 * body.radius * body.half_extent.sum() +
              std::numbers::pi * body.radius * body.radius;
    for (const Population& population : scene_.populations) {
      const double radius = (population.radius_min + population.radius_max) / 2;
      if (population.kind == BodyKind::puck)
        area += population.count * std::numbers::pi * radius * radius;
    }
    assert(area >= 0.0 && field_.length > 0.0 && field_.width > 0.0);
    return area / (field_.length * field_.width);
  }

  void place_pucks() {
    const bool is_sparse = covered() <= random_packing_max;
    for (std::size_t k = 0; is_sparse && k < scene_.populations.size(); ++k)
      if (scene_.populations[k].kind == BodyKind::puck) populate_at_random(k);
    if (!is_sparse) place_on_lattice();
  }

  /// Pucks too dense for random places: random sites of the widest hexagonal lattice that has
  /// enough of them, each moved at random as far as its cell allows.
  void place_on_lattice() {
    double radius = 0.0;
    std::uint32_t count = 0;
    for (const Population& population : scene_.populations)
      if (population.kind == BodyKind::puck)
        radius = std::max(radius, population.radius_max), count += population.count;
    const double least = 2.0 * radius * (1.0 + clearance);
    double spacing =
        std::max(least, std::sqrt(field_.length * field_.width / count * 2.0 / std::sqrt(3.0)));
    std::vector<Vector2> sites = free_sites(spacing, radius);
    while (sites.size() < count && spacing > least) {
      spacing = std::max(least, 0.995 * spacing);
      sites = free_sites(spacing, radius);
    }
    RandomStream random = stream_of(scene_.populations.size());
    assert(spacing >= least && "discs on neighbouring sites do not overlap");
    for (std::size_t i = 0; i < sites.size(); ++i)
      std::swap(sites[i], sites[i + random.below(static_cast<std::uint32_t>(sites.size() - i))]);
    take_sites(sites, spacing, random);
  }

  /// Sites whose discs of `radius` are free of what is placed already.
  std::vector<Vector2> free_sites(double spacing, double radius) const {
    assert(spacing > 0.0 && radius >= 0.0);
    std::vector<Vector2> sites;
    const double height = spacing * std::sqrt(3.0) / 2;
    for (int row = 0; radius + row * height <= field_.width - radius; ++row)
      for (int column = 0;
           radius + column * spacing + (row % 2) * spacing / 2 <= field_.length - radius;
           ++column) {
        const Vector2 site(radius + column * spacing + (row % 2) * spacing / 2,
                           radius + row * height);
        if (world_.is_free(site, radius)) sites.push_back(site);
      }
    return sites;
  }

  void take_sites(const std::vector<Vector2>& sites, double spacing, RandomStream& random) {
    std::size_t taken = 0;
    for (const Population& population : scene_.populations) {
      if (population.kind != BodyKind::puck) continue;
      for (std::uint32_t i = 0; i < population.count; ++i, ++taken) {
        if (taken == sites.size()) refuse(population, i);
        const double radius = random.uniform(population.radius_min, population.radius_max);
        const Vector2 moved =
            sites[taken] +
            std::max(0.0, (spacing / 2) * (1.0 - clearance) - radius) * random.in_disc();
        const Vector2 place = world_.is_free(moved, radius) ? moved : sites[taken];
        scene_.bodies.pucks.push_back(make_puck(population, i, place, radius, random));
        world_.add(scene_.bodies.pucks.back().body);
      }
    }
  }

  Scene& scene_;
  physics::World world_;
  const physics::Field field_;
};

}  // namespace

void populate(Scene& scene) { Placement(scene).place_all(); }

}  // namespace rink::game
