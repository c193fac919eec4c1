// Record by record: discovery, scope, values.
#include "rti/federate/delivery/entry_reader.h"

#include "rti/fom/coded_values.h"

namespace rink::rti {

bool EntryReader::handle(Reader& reader, const ReadContext& context, bool is_postponing) {
  EntriesMessage message;
  if (!exchange(reader, message) || message.object_class >= basis_.fom.object_classes().size())
    return false;
  const AttributeSet attributes{message.attributes}, repeated{message.repeated},
      recalled{message.recalled};
  if (attributes.is_empty() || !attributes.includes(repeated | recalled) ||
      !(repeated & recalled).is_empty() ||
      !basis_.fom.attributes(ObjectClassHandle{message.object_class}).includes(attributes))
    return false;
  if (context.is_released) return read_block(message, reader, context, is_postponing);
  header_ = message;
  return handle_again(reader, context, is_postponing);
}

bool EntryReader::handle_again(Reader& reader, const ReadContext& context, bool is_postponing) {
  return header_ && read_block(*header_, reader, context, is_postponing);
}

bool EntryReader::read_block(const EntriesMessage& message, Reader& reader,
                             const ReadContext& context, bool is_postponing) {
  if (!context.stamp || context.timed != nullptr) return false;
  const ObjectClass& object_class = basis_.fom.at(ObjectClassHandle{message.object_class});
  const Block block{message, object_class, AttributeSet{message.attributes},
                    AttributeSet{message.repeated}, AttributeSet{message.recalled}};
  return read_records(block, reader, context, is_postponing) || !basis_.phase.is_joined();
}

bool EntryReader::read_records(const Block& block, Reader& reader, const ReadContext& context,
                               bool is_postponing) {
  const std::uint16_t object_class = block.message.object_class;
  std::uint32_t previous = first_in_scope_block;
  EntryRecord record;
  do {
    if (!read_entry(reader, previous, record)) return false;
    const ObjectHandle object{record.handle};
    if (record.form != EntryForm::held && !read_values(block, reader)) return false;
    if (record.form == EntryForm::discovered && !uses_.objects.discover(object, object_class, {}))
      return false;
    if (!basis_.phase.is_joined()) return false;
    const KnownObject* known = uses_.book.find(object);
    if (known == nullptr && uses_.book.is_gone(object)) continue;
    if (known == nullptr || known->object_class != object_class) return false;
    if (!context.is_released) uses_.objects.change_scope(object, object_class, true);
    if (!basis_.phase.is_joined()) return false;
    if (is_postponing) {
      if (record.form == EntryForm::held)
        uses_.postponed.keep_held(*context.stamp, block.message, object);
      else uses_.postponed.keep_values(*context.stamp, block.message, object, values_);
    } else if (record.form == EntryForm::held) {
      if (!reflect_held(block, object, context)) return false;
    } else if (!uses_.updates.reflect_entry(block.message, object, values_, context)) {
      return false;
    }
  } while (!record.is_last);
  return true;
}

bool EntryReader::read_values(const Block& block, Reader& reader) {
  const std::uint16_t object_class = block.message.object_class;
  values_.clear();
  for (const AttributeHandle each : block.attributes) {
    Bytes value;
    if (block.repeated.contains(each)) {
      if (!last_.has(object_class, each)) return false;
      value = last_.last(object_class, each);
    } else if (block.recalled.contains(each)) {
      std::uint8_t number = 0;
      const auto former =
          reader.number(number) ? last_.recall(object_class, each, number) : std::optional<Bytes>();
      if (!former) return false;
      value = *former;
    } else {
      const auto size = coded_size(block.object_class, {each}, reader.rest());
      if (!size || !reader.rest(value, *size)) return false;
      last_.note(object_class, each, value);
    }
    if (values_.size() + value.size() > values_max) return false;
    values_.insert(values_.end(), value.begin(), value.end());
  }
  return true;
}

bool EntryReader::reflect_held(const Block& block, ObjectHandle object,
                               const ReadContext& context) {
  values_.clear();
  return uses_.residuals.append_held(object, block.message.object_class, block.attributes,
                                     values_) &&
         uses_.updates.reflect_held(block.message, object, values_, context);
}

}  // namespace rink::rti
