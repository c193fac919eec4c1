// The services by which a federate reserves and looks up names of object instances (IEEE
// 1516.1-2010, 6.2 to 6.7).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/object_book.h"
#include "rti/objects/name_book.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class InstanceNames {
 public:
  InstanceNames(const AmbassadorBasis& basis, const ObjectBook& objects)
      : basis_(basis), objects_(objects) {}

  /// These throw IllegalName, NameSetWasEmpty, ObjectInstanceNameNotReserved.
  void reserve(std::string_view name);
  void reserve_set(std::span<const std::string_view> names);
  void release_set(std::span<const std::string_view> names);
  /// Throw ObjectInstanceNotKnown.
  ObjectHandle handle_of(std::string_view name) const;
  std::string name_of(ObjectHandle object) const;

  /// Throws IllegalName or ObjectInstanceNameInUse unless an object may be registered by the name.
  void require_free(std::string_view name) const;
  /// Gives the name to an own object, which uses up its reservation, if any.
  void give_own(ObjectHandle object, std::string_view name);
  /// Notes the name of a discovered object; an empty name is the default one.
  void give(ObjectHandle object, std::string_view name) { names_.give(object, name); }
  void forget(ObjectHandle object) { names_.forget(object); }

  bool handle_answer(Reader& reader);
  std::size_t memory_bytes() const { return names_.memory_bytes(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, names_);
  }

 private:
  void ask(NameRequest request, std::span<const std::string_view> names);
  void call_back(NameAnswer answer, const std::vector<std::string>& names);

  AmbassadorBasis basis_;
  const ObjectBook& objects_;
  NameBook names_;
};

}  // namespace rink::rti
