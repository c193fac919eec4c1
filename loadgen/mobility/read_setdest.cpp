// Reads the movements that ns-2's setdest writes: initial places, and at given times where to go
// and how fast. A node that is sent elsewhere on its way goes on from where it is.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_text.h"

namespace rink::loadgen {
namespace {

/// At `time_s` the node sets out for `place` at `speed` [m/s].
struct Order {
  double time_s = 0.0;
  Vector2 place{0.0, 0.0};
  double speed = 0.0;
  std::size_t line = 0;
};

struct Node {
  std::optional<double> x, y;
  std::size_t line = 0;  ///< of the first that names it
  std::vector<Order> orders;
};

class SetdestReader {
 public:
  explicit SetdestReader(TraceBuilder& builder) : builder_(builder) {}

  void read(std::string_view text) {
    TextLines lines(text);
    while (lines.next()) {
      line_ = lines.number();
      list_words(lines.line(), " \t\"", words_);
      if (words_.empty() || words_[0].starts_with('#') || words_[0] == "$god_") continue;
      if (words_.size() == 4 && words_[1] == "set") read_place();
      else if (words_.size() >= 5 && words_[0] == "$ns_" && words_[1] == "at") read_order();
      else refuse_line();
    }
    for (auto& [number, node] : nodes_) walk(number, node);
    builder_.hold_to_end();
  }

 private:
  [[noreturn]] void refuse_line() const {
    builder_.refuse(
        line_,
        "no line of setdest: expected '$node_(N) set X_ NUMBER' (or Y_, Z_), '$ns_ at TIME "
        "\"$node_(N) setdest X Y SPEED\"', a line of $god_ or a comment");
  }
  double number(std::string_view word) const {
    const auto read = number_in(word);
    if (!read || !std::isfinite(*read))
      builder_.refuse(line_, "'" + std::string(word) + "': expected a finite number");
    return *read;
  }
  Node& node(std::string_view word) {
    constexpr std::string_view begin = "$node_(";
    const bool is_node = word.starts_with(begin) && word.ends_with(')');
    const auto read = is_node ? number_in(word.substr(begin.size(), word.size() - begin.size() - 1))
                              : std::nullopt;
    if (!read || !(*read >= 0.0 && *read < 1e9) || *read != std::floor(*read)) refuse_line();
    Node& found = nodes_[static_cast<std::uint32_t>(*read)];
    if (found.line == 0) found.line = line_;
    return found;
  }

  void read_place() {
    Node& named = node(words_[0]);
    const double value = number(words_[3]);
    std::optional<double>& axis = words_[2] == "X_" ? named.x : named.y;
    if (words_[2] == "Z_") return;
    if (words_[2] != "X_" && words_[2] != "Y_") refuse_line();
    if (axis)
      builder_.refuse(line_, std::string(words_[0]) + " has a " + std::string(words_[2]) +
                                 " already: expected it once");
    axis = value;
  }

  void read_order() {
    if (words_[3] == "$god_") return;
    if (words_.size() != 8 || words_[4] != "setdest") refuse_line();
    Node& named = node(words_[3]);
    const Order order{.time_s = number(words_[2]),
                      .place = {number(words_[5]), number(words_[6])},
                      .speed = number(words_[7]),
                      .line = line_};
    if (order.time_s < 0.0)
      builder_.refuse(line_, "at " + std::string(words_[2]) + ": expected a time from 0 on");
    if (order.speed < 0.0 || order.speed > agent_speed_max)
      builder_.refuse(line_, "a speed of " + std::string(words_[7]) +
                                 " m/s: expected one from 0 to " +
                                 std::to_string(static_cast<int>(agent_speed_max)));
    if (!named.orders.empty() && order.time_s <= named.orders.back().time_s)
      builder_.refuse(line_, std::string(words_[3]) + " is ordered at " + std::string(words_[2]) +
                                 " s after line " + std::to_string(named.orders.back().line) +
                                 ": expected times of a node that rise");
    named.orders.push_back(order);
  }

  /// From order to order, each of which ends the way of the one before.
  void walk(std::uint32_t number, const Node& node) {
    const std::string name = std::to_string(number);
    if (!node.x || !node.y)
      builder_.refuse(node.line, "node " + name + " has no " + (node.x ? "Y_" : "X_") +
                                     ": expected '$node_(" + name + ") set X_ NUMBER' and Y_");
    const std::uint32_t agent = builder_.agent(name, node.line);
    TracePoint here{0.0, *node.x, *node.y};
    builder_.add(agent, here, node.line);
    for (std::size_t k = 0; k < node.orders.size(); ++k) {
      const Order& order = node.orders[k];
      const Vector2 way = order.place - Vector2(here.x, here.y);
      here.time_s = order.time_s;
      builder_.add(agent, here, order.line);
      const double distance = way.norm();
      if (distance == 0.0 || order.speed == 0.0) continue;
      const double wait_s = distance / order.speed, arrives_s = order.time_s + wait_s;
      const bool is_cut_short = k + 1 < node.orders.size() && node.orders[k + 1].time_s < arrives_s;
      const double until_s = is_cut_short ? node.orders[k + 1].time_s : arrives_s;
      const double part = is_cut_short ? (until_s - order.time_s) / wait_s : 1.0;
      if (until_s <= order.time_s) continue;  // nearer than a clock in doubles tells
      here = {until_s, is_cut_short ? here.x + part * way.x() : order.place.x(),
              is_cut_short ? here.y + part * way.y() : order.place.y()};
      builder_.add(agent, here, order.line);
    }
  }

  TraceBuilder& builder_;
  std::map<std::uint32_t, Node> nodes_;
  std::vector<std::string_view> words_;
  std::size_t line_ = 0;
};

}  // namespace

void read_setdest(std::string_view text, TraceBuilder& builder) {
  SetdestReader(builder).read(text);
}

}  // namespace rink::loadgen
