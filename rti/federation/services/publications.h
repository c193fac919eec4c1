// Each federate's publications, which most services read and only `Declarations` changes.
#pragma once

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/types.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class Publications {
 public:
  explicit Publications(const Fom& fom)
      : object_classes_(fom.object_classes().size()),
        interaction_classes_(fom.interaction_classes().size()) {}

  /// The federate publishes nothing yet.
  void joined(std::uint32_t slot) {
    if (slot >= federates_.size()) federates_.resize(slot + 1);
    federates_[slot].objects.assign(object_classes_, {});
    federates_[slot].interactions.assign(interaction_classes_, false);
  }
  void left(std::uint32_t slot) {
    assert(slot < federates_.size());
    federates_[slot] = {};
  }

  AttributeSet of_class(std::uint32_t slot, std::uint32_t object_class) const {
    assert(object_class < object_classes_);
    return federates_[slot].objects[object_class];
  }
  bool has_interaction(std::uint32_t slot, std::uint32_t interaction_class) const {
    assert(interaction_class < interaction_classes_);
    return federates_[slot].interactions[interaction_class];
  }
  /// Returns what the federate published of the class before.
  AttributeSet set_class(std::uint32_t slot, std::uint32_t object_class, AttributeSet attributes) {
    assert(object_class < object_classes_);
    return std::exchange(federates_[slot].objects[object_class], attributes);
  }
  void set_interaction(std::uint32_t slot, std::uint32_t interaction_class, bool is_published) {
    assert(interaction_class < interaction_classes_);
    federates_[slot].interactions[interaction_class] = is_published;
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_);
  }

 private:
  struct Published {
    std::vector<AttributeSet> objects;  ///< by class
    std::vector<bool> interactions;     ///< by class
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, objects, interactions);
    }
  };
  std::size_t object_classes_, interaction_classes_;
  std::vector<Published> federates_;  ///< by slot
};

}  // namespace rink::rti
