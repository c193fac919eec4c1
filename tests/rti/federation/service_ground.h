// Services of a federation execution by themselves: what a federate says is handed to one of them,
// and what it says to others waits in their outboxes. No connections, frames or flushes.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rti/federation/federation_ground.h"
#include "rti/federation/services/object_services.h"
#include "rti/wire/message.h"
#include "rti/wire/object_block.h"
#include "tests/rti/distribution/told_filter.h"

namespace rink::rti {

/// A message without its kind, as a service reads it.
template <class Message>
std::vector<std::byte> words_of(Message message) {
  std::vector<std::byte> bytes;
  Writer writer(bytes);
  exchange(writer, message);
  return bytes;
}

/// Hands `message` to `handle(reader)`.
template <class Message, class Handle>
Status hand_in(Message message, Handle handle) {
  const std::vector<std::byte> words = words_of(message);
  Reader reader(words);
  return handle(reader);
}

/// Calls `visit(message)` for each that was said to the federate since it was asked last, before
/// the updates and after them. They must all be of that kind.
template <class Message, class Visit>
void for_each_said_to(JoinedFederate& federate, Visit visit) {
  std::vector<std::byte> bytes = federate.outbox.head();
  bytes.insert(bytes.end(), federate.outbox.tail().begin(), federate.outbox.tail().end());
  for (Reader reader(bytes); !reader.is_at_end();) {
    std::uint8_t kind = 0;
    Message message;
    ASSERT_TRUE(reader.number(kind));
    ASSERT_EQ(kind, static_cast<std::uint8_t>(Message::kind));
    ASSERT_TRUE(exchange(reader, message));
    visit(message);
  }
  federate.outbox.clear();
}

/// The ground that all services stand on, with those that keep objects.
struct ServiceGround {
  explicit ServiceGround(const FederationSettings& settings = {})
      : ServiceGround(settings, std::make_unique<ToldFilter>()) {}

  std::uint32_t admit(std::string_view name) {
    const std::uint32_t slot = ground.federates.admit(++connection_count, name, "tester");
    objects.joined(slot);
    ground.distribution->add_federate(slot);
    return slot;
  }
  /// Of the class that `owner` publishes whole from now on.
  ObjectSlot add_object(std::uint32_t owner, std::uint16_t object_class) {
    objects.publications.set_class(owner, object_class, plain_fom().attributes({object_class}));
    const ObjectHandle handle{ground.federates[owner].block * object_block +
                              object_counts[owner]++};
    const ObjectSlot slot = ground.objects.insert(handle, owner, object_class, "");
    ground.distribution->object_registered(slot);
    return slot;
  }
  std::uint32_t number_of(ObjectSlot object) const { return ground.objects[object].handle.value; }
  JoinedFederate& federate(std::uint32_t slot) { return ground.federates[slot]; }

  ToldFilter* filter;  ///< of the ground's
  FederationGround ground;
  ObjectServices objects{ground};
  ConnectionId connection_count = 0;
  std::map<std::uint32_t, std::uint32_t> object_counts;  ///< by owner
  const AttributeSet both = plain_fom().attributes({body_class}), position{AttributeHandle{0}},
                     colour{AttributeHandle{1}};

 private:
  ServiceGround(const FederationSettings& settings, std::unique_ptr<ToldFilter> made)
      : filter(made.get()), ground(plain_fom(), settings, {}, std::move(made)) {}
};

}  // namespace rink::rti
