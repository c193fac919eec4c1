// What a federate has declared, which the core takes whole and the standard's services change by
// parts, and by which classes a federate knows what it receives.
#pragma once

#include <map>
#include <set>

#include "rti/fom/fom.h"
#include "rti/wire/state_stream.h"

namespace rink::standard {

/// The declarations for one class of objects.
struct ObjectClassDeclaration {
  rti::AttributeSet published;
  rti::AttributeSet active, passive;  ///< subscribed without a region
  std::map<rti::RegionHandle, rti::AttributeSet> regional{};

  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, published, active, passive, regional);
  }

  rti::AttributeSet subscribed() const {
    rti::AttributeSet all = active | passive;
    for (const auto& [region, attributes] : regional) all = all | attributes;
    return all;
  }
};
struct InteractionClassDeclaration {
  bool is_subscribed = false;  ///< without a region
  std::set<rti::RegionHandle> regions{};

  bool is_wanted() const { return is_subscribed || !regions.empty(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, is_subscribed, regions);
  }
};

struct Declarations {
  std::map<rti::ObjectClassHandle, ObjectClassDeclaration> objects{};
  std::map<rti::InteractionClassHandle, InteractionClassDeclaration> interactions{};

  template <class Stream>
  bool keep(Stream& stream) {
    return rti::keep_all(stream, objects, interactions);
  }
  rti::AttributeSet subscribed(rti::ObjectClassHandle object_class) const {
    const auto found = objects.find(object_class);
    return found == objects.end() ? rti::AttributeSet() : found->second.subscribed();
  }
  /// The class by which the federate discovers an object of `registered`: the nearest that it
  /// subscribes to. Empty if there is none.
  rti::ObjectClassHandle known_class(const rti::Fom& fom, rti::ObjectClassHandle registered) const {
    rti::ObjectClassHandle known = registered;
    while (known && subscribed(known).is_empty()) known = fom.at(known).parent;
    return known;
  }
  rti::InteractionClassHandle known_class(const rti::Fom& fom,
                                          rti::InteractionClassHandle sent) const {
    const auto is_wanted = [this](rti::InteractionClassHandle each) {
      const auto found = interactions.find(each);
      return found != interactions.end() && found->second.is_wanted();
    };
    rti::InteractionClassHandle known = sent;
    while (known && !is_wanted(known)) known = fom.at(known).parent;
    return known;
  }
};

}  // namespace rink::standard
