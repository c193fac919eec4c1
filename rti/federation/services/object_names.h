// Names of objects: which are reserved by whom, and which are in use (IEEE 1516.1-2010, 6.2 to
// 6.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rti/federation/federate_table.h"
#include "rti/federation/status.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class ObjectNames {
 public:
  /// No more than `name_max` names are reserved or in use at once.
  ObjectNames(FederateTable& federates, std::size_t name_max)
      : federates_(federates), name_max_(name_max) {}

  Status handle(std::uint32_t slot, Reader& reader);
  /// Takes a name for an object that is being registered: the sender's reservation, or a free name.
  /// If it is neither, notifies the sender and returns false.
  bool take(std::uint32_t slot, std::string_view name);
  /// Frees the name of an object that is gone.
  void give_back(const std::string& name) { names_.erase(name); }
  /// Frees the names that the federate reserved and did not use.
  void left(std::uint32_t slot);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, names_);
  }

 private:
  bool reserve(FederateHandle federate, std::vector<std::string>& names);
  Status release(FederateHandle federate, const std::vector<std::string>& names);
  void answer(std::uint32_t slot, NameAnswer answer, Bytes names);

  FederateTable& federates_;
  std::size_t name_max_;
  std::unordered_map<std::string, FederateHandle> names_;  ///< none: in use
};

}  // namespace rink::rti
