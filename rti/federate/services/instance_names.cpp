// Sends requests about names to the RTI, and handles the answers.
#include "rti/federate/services/instance_names.h"

#include "rti/federate/books/require.h"

namespace rink::rti {

namespace {

void require_name(std::string_view name) {
  if (name.empty() || name.size() > text_max || name.starts_with(NameBook::own_prefix))
    throw RtiException(HlaError::illegal_name,
                       "'" + std::string(name) +
                           "': an object's name has 1 to 255 bytes and does not begin with HLA");
}

}  // namespace

void InstanceNames::ask(NameRequest request, std::span<const std::string_view> names) {
  basis_.phase.require_joined();
  if (names.empty())
    throw RtiException(HlaError::name_set_was_empty, "a set of names has one at least");
  std::vector<std::byte> texts;
  Writer writer(texts);
  for (std::string_view name : names) {
    require_name(name);
    writer.text(name, text_max);
  }
  if (texts.size() > names_size_max)
    throw RtiException(HlaError::rti_internal_error, "a set of names takes at most 32,768 bytes");
  basis_.frames.enqueue(InstanceNamesMessage{static_cast<std::uint8_t>(request), texts});
}

void InstanceNames::reserve(std::string_view name) {
  ask(NameRequest::reserve, std::span(&name, 1));
  names_.reserve(name);
}

void InstanceNames::reserve_set(std::span<const std::string_view> names) {
  ask(NameRequest::reserve_set, names);
  for (const std::string_view name : names) names_.reserve(name);
}

void InstanceNames::release_set(std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    if (!names_.is_reserved(name))
      throw RtiException(HlaError::object_instance_name_not_reserved,
                         "'" + std::string(name) + "'");
  ask(NameRequest::release, names);
  for (const std::string_view name : names) names_.end_reservation(name);
}

ObjectHandle InstanceNames::handle_of(std::string_view name) const {
  const std::optional<ObjectHandle> object = names_.find(name);
  if (!object || objects_.find(*object) == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "no object is called '" + std::string(name) + "'");
  return *object;
}

std::string InstanceNames::name_of(ObjectHandle object) const {
  if (objects_.find(object) == nullptr)
    throw RtiException(HlaError::object_instance_not_known, rti::name_of(object));
  return names_.name_of(object);
}

void InstanceNames::require_free(std::string_view name) const {
  if (name.empty()) return;
  require_name(name);
  if (names_.find(name))
    throw RtiException(HlaError::object_instance_name_in_use, "'" + std::string(name) + "'");
}

void InstanceNames::give_own(ObjectHandle object, std::string_view name) {
  assert(objects_.find(object) != nullptr);
  names_.end_reservation(name);
  names_.give(object, name);
}

bool InstanceNames::handle_answer(Reader& reader) {
  InstanceNamesAnswerMessage message;
  std::vector<std::string> names;
  if (!exchange(reader, message) ||
      !for_each_name(message.names, [&](std::string_view name) { names.emplace_back(name); }))
    return false;
  const auto answer = static_cast<NameAnswer>(message.word);
  const bool is_set = answer == NameAnswer::set_granted || answer == NameAnswer::set_refused;
  if (!is_set && names.size() != 1) return false;
  if (answer == NameAnswer::registration_refused) {
    const std::optional<ObjectHandle> object = names_.find(names[0]);
    if (object && objects_.was_registered_here(*object)) names_.forget(*object);
  }
  const bool is_granted = answer == NameAnswer::granted || answer == NameAnswer::set_granted;
  for (const std::string& name : names) {
    if (is_granted) names_.granted(name);
    else if (!names_.is_reserved(name))
      names_.end_reservation(name);  // not one that was granted before
  }
  call_back(answer, names);
  return true;
}

void InstanceNames::call_back(NameAnswer answer, const std::vector<std::string>& names) {
  assert(!names.empty() || answer == NameAnswer::set_granted || answer == NameAnswer::set_refused);
  if (answer == NameAnswer::set_granted)
    basis_.callbacks.multiple_object_instance_name_reservation_succeeded(names);
  else if (answer == NameAnswer::set_refused)
    basis_.callbacks.multiple_object_instance_name_reservation_failed(names);
  else if (answer == NameAnswer::granted)
    basis_.callbacks.object_instance_name_reservation_succeeded(names[0]);
  else basis_.callbacks.object_instance_name_reservation_failed(names[0]);
}

}  // namespace rink::rti
