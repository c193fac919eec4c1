// How updates share stamps and headers in the frames of a federate.
#include "rti/federate/delivery/frame_outbox.h"

#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Stamp, and a header with two numbers of at most 5 bytes.
constexpr std::size_t header_size_max = StampMessage::size_max + 1 + 5 + 5;
/// The step to the handle, and the end.
constexpr std::size_t rest_max = 5 + 1;

}  // namespace

void FrameOutbox::begin_updates(const UpdateHeader& header) {
  if (!frames_.is_open() || stamped_frame_ != frames_.frame_count() || stamp_ != header.stamp)
    enqueue(StampMessage{header.stamp});
  stamp_ = header.stamp;
  stamped_frame_ = frames_.frame_count();
  enqueue(UpdatesMessage{static_cast<std::uint16_t>(header.object_class.value),
                         header.attributes.bits});
  frames_.buffer().push_back(std::byte{0});
  open_ = header;
  has_open_updates_ = true;
  last_object_ = 0;
}

bool FrameOutbox::enqueue_update(const UpdateHeader& header, ObjectHandle object, Bytes values) {
  assert(values.size() <= values_max && !header.attributes.is_empty());
  const bool begins =
      !has_open_updates_ || open_ != header || !frames_.has_room(rest_max + values.size());
  if (begins) {
    if (!frames_.has_room(header_size_max + rest_max + values.size())) frames_.close_frame();
    begin_updates(header);
  }
  std::vector<std::byte>& bytes = frames_.buffer();
  assert(!bytes.empty() && bytes.back() == std::byte{0});
  bytes.pop_back();  // the zero that ends the block
  write_handle(bytes, last_object_, object.value);
  last_object_ = object.value;
  bytes.insert(bytes.end(), values.begin(), values.end());
  bytes.push_back(std::byte{0});
  frames_.appended();
  return begins;
}

void FrameOutbox::close_frame() {
  frames_.close_frame();
  object_block_.close();
  has_open_updates_ = false;
}

void FrameOutbox::clear() {
  frames_.clear();
  object_block_.close();
  has_open_updates_ = false;
}

}  // namespace rink::rti
