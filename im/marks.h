// A set of ids, one bit each.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::im {

/// Takes no memory until one is set.
class Marks {
 public:
  bool has(std::uint32_t id) const { return id < marks_.size() && marks_[id] != 0; }
  /// Returns whether the mark changed.
  bool set(std::uint32_t id, bool is_wanted = true) {
    if (has(id) == is_wanted) return false;
    if (id >= marks_.size()) marks_.resize(id + std::size_t{1});
    marks_[id] = is_wanted ? 1 : 0;
    return true;
  }
  bool unset(std::uint32_t id) { return set(id, false); }

 private:
  std::vector<std::uint8_t> marks_;
};

}  // namespace rink::im
