// The names of object instances that one federate has reserved, given or received.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "rti/objects/object_map.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// An object without a name of its own is called by its handle, "HLAobject 17", which nobody may
/// reserve; so every object has a unique name and most names cost nothing.
class NameBook {
 public:
  static constexpr std::string_view own_prefix =
      "HLA";  ///< of names that are the RTI's to give (IEEE 1516.1-2010, 6.2)
  static std::string default_name(ObjectHandle object) {
    return "HLAobject " + std::to_string(object.value);
  }

  void reserve(std::string_view name) { reserved_.emplace(name, false); }
  void granted(std::string_view name) {
    if (const auto found = reserved_.find(name); found != reserved_.end()) found->second = true;
  }
  /// A reservation ends: it failed, was released or used. False if there is none, or
  /// `is_granted_only` and it is not granted yet.
  bool end_reservation(std::string_view name, bool is_granted_only = false) {
    const auto found = reserved_.find(name);
    if (found == reserved_.end() || (is_granted_only && !found->second)) return false;
    reserved_.erase(found);
    return true;
  }
  bool is_reserved(std::string_view name) const {
    const auto found = reserved_.find(name);
    return found != reserved_.end() && found->second;
  }

  void give(ObjectHandle object, std::string_view name) {
    if (name.empty()) return;
    names_[object] = name;
    objects_[std::string(name)] = object;
  }
  void forget(ObjectHandle object) {
    const std::string* name = names_.find(object);
    if (name == nullptr) return;
    objects_.erase(*name);
    names_.erase(object);
  }
  std::string name_of(ObjectHandle object) const {
    const std::string* name = names_.find(object);
    return name != nullptr ? *name : default_name(object);
  }
  /// The object of a given or default name; the caller checks that a default name's object exists.
  std::optional<ObjectHandle> find(std::string_view name) const {
    if (const auto found = objects_.find(name); found != objects_.end()) return found->second;
    const std::string_view start = "HLAobject ";
    if (!name.starts_with(start) || name.size() > start.size() + 10) return std::nullopt;
    ObjectHandle object{0};
    std::uint64_t number = 0;
    for (const char digit : name.substr(start.size())) {
      if (digit < '0' || digit > '9') return std::nullopt;
      number = 10 * number + static_cast<std::uint64_t>(digit - '0');
    }
    object.value = static_cast<std::uint32_t>(number);
    if (number > 0xffffffffu || default_name(object) != name || names_.find(object) != nullptr)
      return std::nullopt;
    return object;
  }
  std::size_t memory_bytes() const {
    return names_.memory_bytes() + objects_.size() * (sizeof(std::string) + 64);
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, reserved_, names_, objects_);
  }

 private:
  std::map<std::string, bool, std::less<>> reserved_;  ///< by name: granted, or only asked for
  ObjectMap<std::string> names_;
  std::map<std::string, ObjectHandle, std::less<>> objects_;  ///< those with a name of their own
};

}  // namespace rink::rti
