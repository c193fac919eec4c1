// The ambassador's books, one after the other.
#include "rti/save/kept_ambassador.h"

#include "rti/federate/ambassador_parts.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

namespace {

template <class Stream>
bool keep_books(Stream& stream, AmbassadorParts& parts) {
  AmbassadorGround& ground = parts.ground;
  return keep_all(stream, parts.session, ground.objects, ground.regions, ground.classes,
                  ground.ownership, ground.sent, ground.residuals, parts.names, parts.declarations,
                  parts.sender, parts.time, parts.synchronization, ground.postponed);
}

bool are_classes_known(const AmbassadorGround& ground) {
  bool are_known = true;
  ground.objects.for_each([&](ObjectHandle, const KnownObject& known) {
    are_known &= known.object_class < ground.fom.object_classes().size();
  });
  return are_known;
}

}  // namespace

void write_state(AmbassadorParts& parts, std::vector<std::byte>& bytes) {
  std::vector<std::byte> beside;
  parts.ground.gate.callbacks().write_state(beside);
  Writer writer(bytes);
  keep_books(writer, parts);
  keep_all(writer, beside);
}

bool read_state(AmbassadorParts& parts, Bytes bytes, std::uint32_t block) {
  Reader reader(bytes);
  parts.sparing.forget_all();
  parts.keyframes.forget_all();
  std::vector<std::byte> beside;
  return keep_books(reader, parts) && keep_all(reader, beside) && reader.is_at_end() &&
         parts.ground.objects.block() == block && are_classes_known(parts.ground) &&
         parts.ground.gate.callbacks().read_state(beside);
}

}  // namespace rink::rti
