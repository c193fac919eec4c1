// Federates' publications and subscriptions, and advice to publishers whether anybody subscribes
// (IEEE 1516.1-2010, clause 5; docs/rti.md, "Nobody listens").
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/distribution/relevance.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/ownership_service.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/objects/object_map.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class Declarations {
 public:
  struct Uses {
    DataDistribution& distribution;
    const Ownership& ownership;
    Publications& publications;
    const Interactions& interactions;
    OwnershipService& owners;
  };
  Declarations(const FederationBasis& basis, const Uses& uses);

  Status handle_publish_class(std::uint32_t slot, Reader& reader);
  Status handle_subscribe_class(std::uint32_t slot, Reader& reader);
  Status handle_publish_interaction(std::uint32_t slot, Reader& reader);
  Status handle_advisory_switch(std::uint32_t slot, Reader& reader);

  /// Notes the federate's present subscriptions, and advises the publishers concerned at once:
  /// later messages of the subscriber reach them after that.
  void subscriptions_changed(std::uint32_t slot);
  /// Notes the present subscriptions of all federates of a restored federation, then advises
  /// publishers that were advised otherwise.
  void restored();
  /// True if anybody subscribes to the class.
  bool is_subscribed(ObjectClassHandle object_class) const {
    return !relevance_.of_others(no_federate, object_class.value).subscribed.is_empty();
  }
  /// Notifies owners that asked for it which of their attributes are in the scope of an active
  /// subscriber now. Costs nothing where none asked.
  void advise_object_relevance();
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot) { advised_[slot] = {}; }
  /// What publishers were last advised; subscriptions are noted anew by `subscriptions_changed`.
  template <class Stream>
  bool keep(Stream& stream) {
    if (!keep_all(stream, advised_)) return false;
    if (Stream::is_reading) uses_.distribution.watch_scope(is_any_advised());
    return true;
  }

 private:
  /// The last advice to a publisher about its subscribers.
  struct Advised {
    std::vector<Subscription> classes;                 ///< by row of `Relevance`
    std::unique_ptr<ObjectMap<AttributeSet>> objects;  ///< if it asked for it: those in others'
                                                       ///< scope
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, classes, objects);
    }
  };
  Subscription subscribed(std::uint32_t slot, std::size_t row) const;
  Subscription others_subscribe(std::uint32_t slot, std::size_t row) const;
  bool publishes(std::uint32_t slot, std::size_t row) const;
  void advise_publishers(std::size_t row);
  void advise(std::uint32_t slot, std::size_t row);
  void advise_owners_of(ObjectSlot object);
  /// True if some owner asked which of its objects are in others' scope.
  bool is_any_advised() const;
  AttributeSet subscribed_of(std::uint32_t owner, ObjectSlot object) const;
  /// Rows of interaction classes follow those of object classes.
  bool is_interaction(std::size_t row) const { return row >= basis_.fom.object_classes().size(); }
  std::uint16_t number_of(std::size_t row) const {
    return static_cast<std::uint16_t>(is_interaction(row) ? row - basis_.fom.object_classes().size()
                                                          : row);
  }

  FederationBasis basis_;
  Uses uses_;
  Relevance relevance_;
  std::vector<Advised> advised_;  ///< by slot
};

}  // namespace rink::rti
