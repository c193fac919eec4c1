// Transportation types, reliable or best effort, as the model states and federates change them
// (IEEE 1516.1-2010, 6.23 to 6.30).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/objects/object_map.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class TransportationTypes {
 public:
  TransportationTypes(const FederationBasis& basis, const Ownership& ownership,
                      const Publications& publications, KnownObjects& known);

  Status handle_change(std::uint32_t slot, Reader& reader);
  Status handle_query(std::uint32_t slot, Reader& reader);

  /// The best-effort attributes of a class in the model.
  AttributeSet best_effort(std::uint16_t object_class) const { return best_effort_[object_class]; }
  bool has_best_effort() const { return has_best_effort_; }
  /// The attributes that may travel by datagram: best-effort in the model and not changed to
  /// reliable.
  AttributeSet by_datagram(ObjectSlot object) const {
    return chosen(object) & best_effort_[basis_.objects[object].object_class];
  }
  /// True if the type of any object's attributes has changed.
  bool has_changed() const { return objects_.size() > 0; }
  void forget(ObjectHandle object) {
    if (has_changed()) objects_.erase(object);
  }
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot) { interactions_[slot].clear(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, objects_, interactions_);
  }

 private:
  using ChangedInteractions = std::vector<std::pair<std::uint16_t, Transportation>>;
  /// The object's best-effort attributes, whether datagrams carry them or not.
  AttributeSet chosen(ObjectSlot object) const {
    const AttributeSet* changed =
        has_changed() ? objects_.find(basis_.objects[object].handle) : nullptr;
    return changed != nullptr ? *changed : best_effort_[basis_.objects[object].object_class];
  }
  Status change_object(std::uint32_t slot, const ChangeTransportationMessage& message);
  Status change_interaction(std::uint32_t slot, const ChangeTransportationMessage& message);
  Transportation of_interaction(std::uint16_t interaction_class, FederateHandle sender) const;

  FederationBasis basis_;
  const Ownership& ownership_;
  const Publications& publications_;
  KnownObjects& known_;
  std::vector<AttributeSet> best_effort_;  ///< by class
  bool has_best_effort_ = false;           ///< any at all
  ObjectMap<AttributeSet> objects_;  ///< objects with changed types: their best-effort attributes
  std::vector<ChangedInteractions> interactions_;  ///< by sender's slot: changed types
};

}  // namespace rink::rti
