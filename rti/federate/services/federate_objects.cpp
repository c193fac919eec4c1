// Registers, discovers and deletes objects at their federate's side.
#include "rti/federate/services/federate_objects.h"

#include "rti/federate/books/require.h"
#include "rti/federate/services/require_declared.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/object_block.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

namespace {

void require_tag(Bytes tag) {
  if (tag.size() > request_tag_max)
    throw RtiException(HlaError::rti_internal_error, "a request's tag has at most 1,024 bytes");
}

}  // namespace

ObjectHandle FederateObjects::register_instance(ObjectClassHandle object_class,
                                                std::string_view name) {
  basis_.phase.require_joined();
  require_class(basis_.fom, object_class, {});
  if (uses_.classes.published(object_class).is_empty())
    throw RtiException(HlaError::object_class_not_published,
                       "class " + basis_.fom.at(object_class).name);
  uses_.names.require_free(name);
  if (!uses_.book.has_handle()) return {};
  const ObjectHandle object = uses_.book.add(object_class);
  uses_.names.give_own(object, name);
  basis_.frames.enqueue(
      RegisterObjectMessage{object.value, static_cast<std::uint16_t>(object_class.value), name});
  return object;
}

/// Forgets all that is kept of an object beside its entry in `ObjectBook`.
void FederateObjects::forget(ObjectHandle object) {
  uses_.ownership.forget(object);
  uses_.regions.forget(object);
  uses_.sparing.forget(object);
  uses_.names.forget(object);
  uses_.sender.forget(object);
}

void FederateObjects::delete_instance(ObjectHandle object) {
  const KnownObject& known = uses_.ownership.require_known(object, {});
  if (!uses_.ownership.owned_of(object, known).contains(privilege_to_delete_object))
    throw RtiException(HlaError::delete_privilege_not_held, name_of(object));
  forget(object);
  uses_.book.leave(object);
  basis_.frames.enqueue(DeleteObjectMessage{object.value});
}

void FederateObjects::forget_instance(ObjectHandle object) {
  const KnownObject& known = uses_.ownership.require_known(object, {});
  require(uses_.ownership.owned_of(object, known).is_empty(), HlaError::federate_owns_attributes,
          object, "an object with owned attributes cannot be forgotten");
  require(uses_.ownership.pending_of(object).is_empty(), HlaError::ownership_acquisition_pending,
          object, "cancel the acquisition first");
  uses_.arrivals.leave(object);
  forget(object);
  uses_.book.leave(object);
  basis_.frames.enqueue(LocalDeleteMessage{object.value});
}

void FederateObjects::request_update(ObjectClassHandle object_class, AttributeSet attributes,
                                     Bytes tag) {
  require_class(basis_.fom, object_class, attributes);
  require_tag(tag);
  basis_.frames.enqueue(RequestUpdateMessage{1, object_class.value, attributes.bits, tag});
}

void FederateObjects::request_update(ObjectHandle object, AttributeSet attributes, Bytes tag) {
  uses_.ownership.require_known(object, attributes);
  require_tag(tag);
  basis_.frames.enqueue(RequestUpdateMessage{0, object.value, attributes.bits, tag});
}

ObjectClassHandle FederateObjects::class_of(ObjectHandle object) const {
  const KnownObject* known = uses_.book.find(object);
  if (known == nullptr) throw RtiException(HlaError::object_instance_not_known, name_of(object));
  return {known->object_class};
}

bool FederateObjects::handle_further_block(Reader& reader) {
  FurtherBlockMessage message;
  return exchange(reader, message) && uses_.book.add_block(message.object_block);
}

bool FederateObjects::handle_removal(Reader& reader, const ReadContext& context) {
  RemoveObjectMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  uses_.residuals.forget(object);
  if (uses_.book.find(object) == nullptr) {
    uses_.book.settle_gone(object);
    return uses_.book.is_gone(object);
  }
  uses_.arrivals.leave(object);
  forget(object);
  uses_.book.remove(object);
  ++basis_.counters.objects_removed;
  if (context.timed != nullptr)
    basis_.callbacks.remove_object_instance_with_time(object, *context.timed);
  else basis_.callbacks.remove_object_instance(object);
  return true;
}

bool FederateObjects::handle_discovery(Reader& reader) {
  DiscoverObjectMessage message;
  return exchange(reader, message) &&
         discover({message.object}, message.object_class, message.name);
}

bool FederateObjects::discover(ObjectHandle object, std::uint16_t number, std::string_view name) {
  const ObjectClassHandle object_class{number};
  if (number >= basis_.fom.object_classes().size() || !uses_.book.discover(object, object_class))
    return false;
  ++basis_.counters.objects_discovered;
  uses_.names.give(object, name);
  if (!name.empty()) basis_.callbacks.discover_object_instance(object, object_class, name);
  else
    basis_.callbacks.discover_object_instance(object, object_class, NameBook::default_name(object));
  return true;
}

bool FederateObjects::handle_scope(Reader& reader, bool is_in) {
  const bool is_read = read_objects(
      reader,
      [&](ObjectHandle object) {
        const KnownObject* known = uses_.book.find(object);
        if (known == nullptr) return uses_.book.is_gone(object);
        change_scope(object, known->object_class, is_in);
        return basis_.phase.is_joined();
      },
      first_in_scope_block);
  return is_read || !basis_.phase.is_joined();
}

void FederateObjects::change_scope(ObjectHandle object, std::uint16_t object_class, bool is_in) {
  ++basis_.counters.scope_changes;
  if (is_in) uses_.arrivals.enter(object, object_class);
  else uses_.arrivals.leave(object);
  if (!uses_.declarations.is_on(Advisory::attribute_scope)) return;
  if (is_in) basis_.callbacks.attributes_in_scope(object);
  else basis_.callbacks.attributes_out_of_scope(object);
}

bool FederateObjects::handle_request(Reader& reader) {
  ProvideUpdateMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  const KnownObject* known = uses_.book.find(object);
  const AttributeSet attributes{message.attributes};
  if (known == nullptr) return uses_.book.is_gone(object);
  if (!basis_.fom.attributes(ObjectClassHandle{known->object_class}).includes(attributes))
    return false;
  basis_.callbacks.provide_attribute_value_update(object, attributes, message.tag);
  return true;
}

}  // namespace rink::rti
