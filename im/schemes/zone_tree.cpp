// Counts points on the way from leaf to root, and keeps those of a leaf in a list.
#include "im/schemes/zone_tree.h"

#include <array>
#include <cassert>
#include <utility>

#include "im/basics/checked.h"

namespace rink::im {
namespace {

constexpr std::uint32_t depth_max = 20;

}  // namespace

ZoneTree::ZoneTree(const Region& world, std::uint32_t capacity) : capacity_(capacity) {
  assert(is_valid(world) && capacity_ > 0);
  nodes_.push_back(part(world, no_node, 0));
}

ZoneTree::Part ZoneTree::part(const Region& bounds, Node parent, std::uint32_t depth) const {
  return {.bounds = bounds,
          .x = 0.5 * bounds.low_x + 0.5 * bounds.high_x,
          .y = 0.5 * bounds.low_y + 0.5 * bounds.high_y,
          .parent = parent,
          .depth = depth};
}

ZoneTree::Node ZoneTree::child_at(const Part& from, double x, double y) const {
  return from.children + (x < from.x ? 0u : 1u) + (y < from.y ? 0u : 2u);
}

ZoneTree::Node ZoneTree::leaf_at(double x, double y) const {
  Node node = root;
  while (nodes_[node].children != no_node) node = child_at(nodes_[node], x, y);
  return node;
}

void ZoneTree::link(Entity entity, Node leaf) {
  Point& point = points_[entity];
  point.leaf = leaf;
  point.previous = no_entity;
  point.next = std::exchange(nodes_[leaf].first, entity);
  if (point.next != no_entity) points_[point.next].previous = entity;
}

void ZoneTree::unlink(Entity entity) {
  const Point& point = points_[entity];
  if (point.next != no_entity) points_[point.next].previous = point.previous;
  if (point.previous != no_entity) points_[point.previous].next = point.next;
  else nodes_[point.leaf].first = point.next;
}

/// `change` may be that of -1.
void ZoneTree::count(Node leaf, std::uint32_t change) {
  for (Node node = leaf; node != no_node; node = nodes_[node].parent) nodes_[node].count += change;
  is_changed_ = true;
}

void ZoneTree::set(Entity entity, double x, double y) {
  if (entity >= points_.size()) points_.resize(entity + std::size_t{1});
  Point& point = points_[entity];
  point.x = x, point.y = y;
  const Node leaf = leaf_at(x, y);
  if (leaf == point.leaf) return;
  if (point.leaf != no_node) {
    unlink(entity);
    count(point.leaf, ~std::uint32_t{0});
  }
  link(entity, leaf);
  count(leaf, 1);
  changed_.push_back(entity);
}

void ZoneTree::remove(Entity entity) {
  if (!contains(entity)) return;
  unlink(entity);
  count(points_[entity].leaf, ~std::uint32_t{0});
  points_[entity].leaf = no_node;
}

void ZoneTree::settle(std::vector<Entity>& moved) {
  for (const Entity entity : changed_)
    if (contains(entity)) moved.push_back(entity);
  changed_.clear();
  if (std::exchange(is_changed_, false)) settle(root, moved);
  if constexpr (checks_whole_structures) check();
}

void ZoneTree::settle(Node node, std::vector<Entity>& moved) {
  const Part& own = nodes_[node];
  if (own.children != no_node) {
    const Node children = own.children;
    if (own.count > capacity_) {
      for (Node child = children; child < children + 4; ++child) settle(child, moved);
      return;
    }
    for (Node child = children; child < children + 4; ++child) join(node, child, moved);
    nodes_[node].children = no_node;
    free_.push_back(children);
    zones_ -= 3;
  } else if (own.count > capacity_ && own.depth < depth_max && own.bounds.low_x < own.x &&
             own.x < own.bounds.high_x && own.bounds.low_y < own.y && own.y < own.bounds.high_y) {
    cut(node, moved);
  }
}

/// Gives all points below `node` to `into`.
void ZoneTree::join(Node into, Node node, std::vector<Entity>& moved) {
  if (const Node children = nodes_[node].children; children != no_node) {
    for (Node child = children; child < children + 4; ++child) join(into, child, moved);
    free_.push_back(children);
    zones_ -= 3;
    return;
  }
  while (nodes_[node].first != no_entity) {
    const Entity entity = nodes_[node].first;
    unlink(entity);
    link(entity, into);
    moved.push_back(entity);
  }
}

void ZoneTree::cut(Node node, std::vector<Entity>& moved) {
  if (free_.empty()) {
    free_.push_back(static_cast<Node>(nodes_.size()));
    nodes_.resize(nodes_.size() + 4);
  }
  const Node children = free_.back();
  free_.pop_back();
  zones_ += 3;
  const Part own = nodes_[node];
  const Region& all = own.bounds;
  const std::array bounds{
      Region{all.low_x, all.low_y, own.x, own.y}, Region{own.x, all.low_y, all.high_x, own.y},
      Region{all.low_x, own.y, own.x, all.high_y}, Region{own.x, own.y, all.high_x, all.high_y}};
  for (std::uint32_t i = 0; i < 4; ++i) nodes_[children + i] = part(bounds[i], node, own.depth + 1);
  nodes_[node].children = children;
  nodes_[node].first = no_entity;
  for (Entity entity = own.first, next = no_entity; entity != no_entity; entity = next) {
    next = points_[entity].next;
    const Node child = child_at(nodes_[node], points_[entity].x, points_[entity].y);
    link(entity, child);
    ++nodes_[child].count;
    moved.push_back(entity);
  }
  for (Node child = children; child < children + 4; ++child) settle(child, moved);
}

/// Asserts that each point is in the list of the leaf where it is, and counts are those of lists.
void ZoneTree::check() const {
  [[maybe_unused]] std::uint32_t there = 0;
  for (Entity entity = 0; entity < points_.size(); ++entity) {
    if (!contains(entity)) continue;
    ++there;
    assert(leaf_at(points_[entity].x, points_[entity].y) == points_[entity].leaf);
  }
  assert(there == nodes_[root].count);
  assert(zones_ + free_.size() * 3 == (nodes_.size() - 1) / 4 * 3 + 1);
}

}  // namespace rink::im
