// The attributes of each class that a federate has sent, and its newest stamp.
#pragma once

#include <cassert>
#include <vector>

#include "rti/federate/delivery/frame_outbox.h"
#include "rti/fom/fom.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class SentUpdates {
 public:
  explicit SentUpdates(const Fom& fom) : attributes_(fom.object_classes().size()) {}

  void note(const UpdateHeader& header) {
    assert(header.object_class.value < attributes_.size());
    AttributeSet& sent = attributes_[header.object_class.value];
    sent = sent | header.attributes;
    newest_ = header.stamp;
  }
  /// Notes an update that was kept back.
  void note_spared(const Stamp& stamp) { newest_ = stamp; }
  /// The attributes of which an update was sent once: the RTI may hold a value.
  AttributeSet of(ObjectClassHandle object_class) const {
    assert(object_class.value < attributes_.size());
    return attributes_[object_class.value];
  }
  const Stamp& newest() const { return newest_; }  ///< of the latest update, be it kept back
  std::size_t memory_bytes() const { return attributes_.capacity() * sizeof attributes_[0]; }
  template <class Stream>
  bool keep(Stream& stream) {
    const std::size_t classes = attributes_.size();
    return keep_all(stream, attributes_, newest_) && attributes_.size() == classes;
  }

 private:
  std::vector<AttributeSet> attributes_;  ///< by class
  Stamp newest_;
};

}  // namespace rink::rti
