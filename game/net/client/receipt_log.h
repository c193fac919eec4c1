// A log of the scope changes and updates that a watched client received, for measurements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rti/types.h"

namespace rink::game {

/// Off at first, when it keeps nothing.
class ReceiptLog {
 public:
  struct Scope {
    rti::ObjectHandle object;
    bool is_in = false;
  };
  struct Update {
    rti::ObjectHandle object;
    std::uint32_t bytes = 0;  ///< of its values
  };

  void watch() { is_watched_ = true; }
  void note_scope(rti::ObjectHandle object, bool is_in) {
    if (is_watched_) scopes_.push_back({object, is_in});
  }
  void note_update(rti::ObjectHandle object, std::size_t bytes) {
    if (is_watched_) updates_.push_back({object, static_cast<std::uint32_t>(bytes)});
  }

  /// Entries since the last `forget`, in order of arrival.
  const std::vector<Scope>& scopes() const { return scopes_; }
  const std::vector<Update>& updates() const { return updates_; }
  void forget() {
    scopes_.clear();
    updates_.clear();
  }

 private:
  bool is_watched_ = false;
  std::vector<Scope> scopes_;
  std::vector<Update> updates_;
};

}  // namespace rink::game
