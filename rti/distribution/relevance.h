// Counts the subscribers of each class, so that publishers can be advised when there are none.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "rti/distribution/data_distribution.h"

namespace rink::rti {

/// Subscriptions of all federates, in any region. Classes of objects and of interactions are rows
/// of one table: an interaction class is one attribute, the first. A change costs a step for each
/// changed attribute, however many federates there are.
class Relevance {
 public:
  /// A subscription to an interaction class as a row has it.
  static Subscription of(Listening listening) {
    return {AttributeSet(listening != Listening::none),
            AttributeSet(listening == Listening::active)};
  }

  explicit Relevance(std::size_t rows) : rows_(rows) {}
  std::size_t row_count() const { return rows_.size(); }

  /// Replaces the subscription of `federate` to a row. True if that may matter to some other
  /// federate: an attribute to which two others subscribe is not affected by a third.
  bool set(std::uint32_t federate, std::size_t row, const Subscription& now) {
    assert(row < rows_.size() && now.subscribed.includes(now.active));
    if (federate >= federates_.size()) federates_.resize(federate + 1);
    auto& own = federates_[federate];
    if (own.empty()) own.resize(rows_.size());
    const bool is_subscribed_news =
        rows_[row].subscribed.change(own[row].subscribed, now.subscribed);
    const bool is_active_news = rows_[row].active.change(own[row].active, now.active);
    own[row] = now;
    return is_subscribed_news || is_active_news;
  }
  /// The subscriptions of federates other than `federate` to a row, together.
  Subscription of_others(std::uint32_t federate, std::size_t row) const {
    assert(row < rows_.size());
    const Subscription own = federate < federates_.size() && !federates_[federate].empty()
                                 ? federates_[federate][row]
                                 : Subscription();
    return {rows_[row].subscribed.of_others(own.subscribed),
            rows_[row].active.of_others(own.active)};
  }

 private:
  /// How many federates subscribe to each attribute.
  struct Counts {
    std::array<std::uint32_t, attribute_max> by_attribute{};
    AttributeSet any, several;  ///< attributes with at least one subscriber, and with at least two

    bool change(AttributeSet before, AttributeSet now) {
      const AttributeSet any_before = any, several_before = several;
      for (const AttributeHandle attribute : AttributeSet(before.bits ^ now.bits)) {
        std::uint32_t& count = by_attribute[attribute.value];
        assert(count > 0 || now.contains(attribute));
        count += now.contains(attribute) ? 1u : ~0u;
        const AttributeSet one{attribute};
        any = count > 0 ? any | one : any.without(one);
        several = count > 1 ? several | one : several.without(one);
      }
      return any != any_before || several != several_before;
    }
    AttributeSet of_others(AttributeSet own) const { return several | any.without(own); }
  };
  struct Row {
    Counts subscribed, active;
  };
  std::vector<Row> rows_;
  std::vector<std::vector<Subscription>>
      federates_;  ///< by slot, then by row; empty for a federate that never subscribed
};

}  // namespace rink::rti
