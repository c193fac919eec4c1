// A federate's own record of its part in one object's ownership.
#pragma once

#include <cstdint>

#include "rti/types.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// True if objects that a federate owns whole are deleted when it leaves.
constexpr bool deletes(ResignAction action) {
  return action == ResignAction::delete_objects ||
         action == ResignAction::delete_objects_then_divest ||
         action == ResignAction::cancel_then_delete_then_divest;
}

/// Kept only while a federate owns some but not all of an object, or negotiates about it.
/// Attributes that it asked to give up it holds no longer, whatever the RTI answers; if no federate
/// took them after all, the RTI gives them back.
struct Holding {
  AttributeSet owned;
  AttributeSet offered;      ///< negotiated divestiture under way
  AttributeSet confirmable;  ///< of those: the RTI asked for the confirmation
  AttributeSet acquiring;    ///< by attribute ownership acquisition
  AttributeSet acquiring_if_available;
  AttributeSet pending() const { return acquiring | acquiring_if_available; }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, owned, offered, confirmable, acquiring, acquiring_if_available);
  }

  void gain(AttributeSet attributes) {
    owned = owned | attributes;
    offered = offered.without(attributes);
    confirmable = confirmable.without(attributes);
    end_acquisition(attributes);
  }
  void lose(AttributeSet attributes) {
    owned = owned.without(attributes);
    offered = offered.without(attributes);
    confirmable = confirmable.without(attributes);
  }
  void end_acquisition(AttributeSet attributes) {
    acquiring = acquiring.without(attributes);
    acquiring_if_available = acquiring_if_available.without(attributes);
  }
};

}  // namespace rink::rti
