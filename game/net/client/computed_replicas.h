// The replicas of a client that computes them: the engine plays what the client was told, and the
// replicas are shown as those of any other client.
#pragma once

#include <cstdint>
#include <functional>

#include "game/net/client/receipt_log.h"
#include "game/replication/exact/exact_replicas.h"
#include "game/replication/object_model.h"
#include "game/replication/replica_set.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::game {

class ComputedReplicas {
 public:
  /// All must outlive it.
  ComputedReplicas(const ObjectModel& model, ReplicaSet& replicas, ReceiptLog& received)
      : model_(model), replicas_(replicas), received_(received) {}

  /// A message of the host, for who plays `player`'s bat; `before` is called with the message's
  /// stamp before anything is shown. Nothing is, unless the result is `exact`.
  ExactReplicas::Result receive(rti::Bytes message, std::uint32_t player,
                                const std::function<void(const rti::Stamp&)>& before);
  /// Shows what is computed up to the simulated `instant` [s] without news (see
  /// ExactReplicas::look_ahead).
  void look_ahead(double instant);
  /// Shows again what there is as of the last tick.
  void look_back();
  /// Shows nobody any more: the server tells all from now on.
  void withdraw();

  /// The object of the player's bat; empty before it is known.
  rti::ObjectHandle bat() const { return bat_; }
  const ExactReplicas& exact() const { return exact_; }
  std::size_t memory_bytes() const { return exact_.memory_bytes(); }

 private:
  void enter(std::uint32_t number, std::uint32_t player, const rti::Stamp& stamp);
  void show_changed(const rti::Stamp& stamp);
  void show(const ExactReplicas::Body& body, const rti::Stamp& stamp);

  const ObjectModel& model_;
  ReplicaSet& replicas_;
  ReceiptLog& received_;
  ExactReplicas exact_;
  rti::ObjectHandle bat_;
  std::uint32_t bat_number_ = 0;
};

}  // namespace rink::game
