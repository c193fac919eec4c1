// A rectangle of the world cut into zones by how many entities are where.
#pragma once

#include <cstdint>
#include <vector>

#include "im/filter.h"

namespace rink::im {

/// Points in zones: a zone with more than `capacity` points is cut through its middle into four,
/// and four that have no more than that together are one again. So the zones follow from the points
/// alone. A zone that was cut 20 times, or that has no double in its middle, is not cut. A point on
/// a cut is in the upper or right zone; what is outside the world is in the zone nearest to it.
class ZoneTree {
 public:
  ZoneTree(const Region& world, std::uint32_t capacity);

  /// Adds the point or moves it; finite.
  void set(Entity entity, double x, double y);
  void remove(Entity entity);
  /// Cuts and joins zones, and appends the points that are in other zones than after the last call,
  /// some of them perhaps several times.
  void settle(std::vector<Entity>& moved);
  /// The zone of a point that is there, as of the last `settle`.
  const Region& zone_of(Entity entity) const { return nodes_[points_[entity].leaf].bounds; }
  bool contains(Entity entity) const {
    return entity < points_.size() && points_[entity].leaf != no_node;
  }
  std::uint32_t zone_count() const { return zones_; }

 private:
  using Node = std::uint32_t;
  static constexpr Node root = 0, no_node = 0xffffffffu;
  static constexpr Entity no_entity = 0xffffffffu;
  struct Part {
    Region bounds;
    double x, y;                      ///< the middle, where it is cut
    Node parent, children = no_node;  ///< the first of four that follow each other
    std::uint32_t count = 0, depth = 0;
    Entity first = no_entity;  ///< of the list of a leaf's points
  };
  struct Point {
    double x = 0.0, y = 0.0;
    Node leaf = no_node;
    Entity next = no_entity, previous = no_entity;
  };

  Part part(const Region& bounds, Node parent, std::uint32_t depth) const;
  Node leaf_at(double x, double y) const;
  Node child_at(const Part& from, double x, double y) const;
  void link(Entity entity, Node leaf);
  void unlink(Entity entity);
  void count(Node leaf, std::uint32_t change);
  void settle(Node node, std::vector<Entity>& moved);
  void cut(Node node, std::vector<Entity>& moved);
  void join(Node into, Node node, std::vector<Entity>& moved);
  void check() const;

  std::uint32_t capacity_, zones_ = 1;
  std::vector<Part> nodes_;
  std::vector<Node> free_;  ///< first ones of four that are unused
  std::vector<Point> points_;
  std::vector<Entity> changed_;  ///< set since the last `settle`
  bool is_changed_ = false;
};

}  // namespace rink::im
