// Composes the services, and notifies them in a fixed order when federates join or leave.
#include "rti/federation/federation_parts.h"

#include <cassert>
#include <utility>

namespace rink::rti {

FederationParts::FederationParts(const Fom& fom, const FederationSettings& settings,
                                 const FederationServices& services,
                                 std::unique_ptr<im::Filter> filter)
    : ground(fom, settings, services, std::move(filter)),
      objects(ground),
      interactions(ground.basis(), *ground.groups, *ground.distribution, objects.publications),
      regions(ground.basis(),
              {*ground.distribution, ground.ownership, objects.known, objects.requests}),
      synchronization(ground.federates),
      owners(ground.basis(), {ground.ownership, *ground.distribution, objects.publications,
                              objects.known, objects.newest, objects.objects}),
      declarations(ground.basis(), {*ground.distribution, ground.ownership, objects.publications,
                                    interactions, owners}),
      announcements(ground.basis(),
                    {*ground.distribution, owners, objects.requests, objects.newest}),
      periodic(ground.basis()),
      turns(ground.basis(), *ground.distribution, objects.newest),
      residuals(ground.basis(), objects.residuals.model()),
      entries(ground.basis(), {announcements, residuals, objects.residuals, objects.newest}),
      sender(ground.basis(),
             {*ground.distribution, *ground.buffering, objects.newest, announcements, entries,
              periodic, turns, residuals, objects.sender, objects.receiver, rates},
             expulsion()),
      time(ground.basis(),
           {objects.publications,
            ground.ownership,
            objects.known,
            {*ground.distribution, interactions, objects.objects, objects.newest, announcements,
             objects.residuals}},
           services.time_management, expulsion()),
      management_objects(ground.basis(),
                         {*ground.distribution, ground.ownership, declarations, objects.objects,
                          objects.requests, time, *ground.buffering},
                         ManagementHandles(fom)),
      management_interactions(ground.basis(),
                              {*ground.distribution, objects.publications, synchronization,
                               interactions, objects.requests, management_objects},
                              ManagementHandles(fom)),
      membership(ground.basis()),
      saves(ground.basis(), {ground.save_phase, time, services.save_store.get()}),
      connections(ground.basis(), membership,
                  FederationCensus(ground.basis(), *ground.distribution, ground.ownership, time),
                  *this) {}

Expulsion FederationParts::expulsion() {
  return
      [this](std::uint32_t slot, Violation violation, ResignReason reason, std::string_view why) {
        connections.expel(ground.federates[slot].connection, violation, reason, why);
      };
}

void FederationParts::advance_clock(double now, bool is_behind) {
  assert(now >= ground.now);
  ground.now = now;
  connections.advance_clock(is_behind);
}

/// What belongs to the connection and not to the federate goes on as it was.
void FederationParts::take_over(FederationParts& former) {
  ground.now = former.ground.now;
  ground.counters = former.ground.counters;
  const std::vector<std::uint32_t>& slots = former.saves.mapping();
  for (std::uint32_t slot = 0; slot < slots.size(); ++slot) {
    if (slots[slot] == no_federate) continue;
    JoinedFederate& from = former.ground.federates[slot];
    JoinedFederate& to = ground.federates[slots[slot]];
    to.connection = from.connection;
    to.has_notice = from.has_notice;
    to.last_sent = from.last_sent;
    to.counts = from.counts;
    to.frames = from.frames;
    to.stamp_steps = from.stamp_steps;
    to.entry_values = std::move(from.entry_values);
    to.entry_header = from.entry_header;
    to.has_stream_only = to.was_restored = true;
  }
  connections.take_over(former.connections, slots);
  saves.announce_restored(former.saves.saved());
}

void FederationParts::match() {
  if (ground.save_phase != SavePhase::idle) return;  // nobody is told before the end
  rates.begin_match();
  ground.distribution->match();
  ground.counters.scope_entries = ground.distribution->counters().entries;
  ground.counters.scope_exits = ground.distribution->counters().exits;
}

/// Requests to owners that announcements cause are sent by the next flush, since requests are
/// settled before announcements; those of objects that a message in time-stamp order needs now are
/// sent by this one.
void FederationParts::flush(Outlet& outlet) {
  if (saves.takes_flush()) {
    connections.send_answers(outlet);
    saves.flush(outlet);
    if (saves.is_early()) {
      objects.requests.flushed();
      interactions.flushed();
    }
    return connections.close_pending(outlet);
  }
  time.settle();
  declarations.advise_object_relevance();
  management_objects.notify();
  connections.send_answers(outlet);
  objects.requests.settle();
  saves.begin_due();
  sender.flush(outlet);
  objects.requests.flushed();
  interactions.flushed();
  ground.objects.recycle();
  connections.close_pending(outlet);
}

/// The federate is sent the objects that it has missed in full, and no others: a server that is
/// late tells all its clients less often, and has no time to send everything to everybody.
void FederationParts::set_update_rate(std::uint32_t slot, UpdateRate rate) {
  Bitmap missed;
  rates.list_missed(slot, missed);
  rates.set_rate(slot, rate);
  FederateInterest& interest = ground.distribution->of(slot);
  for (std::size_t i = 0; i < missed.word_count(); ++i) {
    const std::uint64_t in_scope = missed.word(i) & interest.in_scope.word(i);
    interest.needs_full_state.insert_word(i, in_scope);
    interest.needs_any_full_state |= in_scope != 0;
  }
  interest.holds_former.clear();
  if (interest.turns) interest.turns->number = 0;
}

std::uint32_t FederationParts::admit(ConnectionId connection, const JoinMessage& message) {
  const std::uint32_t slot = ground.federates.admit(connection, message.name, message.type);
  objects.joined(slot);
  interactions.joined(slot);
  owners.joined(slot);
  declarations.joined(slot);
  time.joined(slot);
  ground.distribution->add_federate(slot);
  rates.joined(slot);
  rates.set_rate(slot, ground.settings.update_rate);
  membership.joined(slot);
  synchronization.joined(slot);
  management_objects.joined(slot);
  return slot;
}

/// The order shows on the wire: objects are removed before watchers of federates are notified, and
/// blocks are free before the RTI's own objects may take one.
void FederationParts::remove(std::uint32_t slot, ResignReason reason) {
  owners.left(slot);
  ground.distribution->remove_federate(slot);
  objects.requests.left(slot);
  ground.buffering->remove_federate(slot);
  periodic.left(slot);
  rates.left(slot);
  objects.objects.left(slot);
  ground.federates.retire(slot);
  subscriptions_changed(slot);
  management_objects.left(slot);
  interactions.left(slot);
  objects.names.left(slot);
  synchronization.left(slot);
  membership.left(slot, reason);
  saves.left(slot);
  time.left(slot);
  objects.left(slot);
  declarations.left(slot);
  ground.federates.release(slot);
}

void FederationParts::begin_frame(std::uint32_t slot) {
  objects.updates.begin_frame(slot);
  objects.arrivals.count_frame(slot);
}

void FederationParts::subscriptions_changed(std::uint32_t slot) {
  declarations.subscriptions_changed(slot);
  management_objects.subscribed(slot);
}

Status FederationParts::send(std::uint32_t slot, InteractionMessage& message,
                             std::span<const RegionHandle> sent_within) {
  Interactions::Receivers receivers;
  if (const Status status = interactions.accept(slot, message, receivers)) return status;
  if (ground.fom.is_management(InteractionClassHandle{message.interaction_class}))
    if (const Status status = management_interactions.take(slot, message)) return status;
  return interactions.deliver(slot, message, receivers, sent_within);
}

}  // namespace rink::rti
