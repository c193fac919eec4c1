// Reads blocks of objects that come into scope, with their values.
#pragma once

#include <vector>

#include "rti/baselines/entry_values.h"
#include "rti/federate/delivery/postponed_messages.h"
#include "rti/federate/delivery/update_receiver.h"
#include "rti/federate/services/federate_objects.h"
#include "rti/wire/entry_block.h"

namespace rink::rti {

class EntryReader {
 public:
  struct Uses {
    const ObjectBook& book;
    FederateObjects& objects;
    UpdateReceiver& updates;
    const ResidualReader& residuals;
    PostponedMessages& postponed;
  };
  EntryReader(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Values in receive order are put off where `is_postponing`, the changes of scope never.
  bool handle(Reader& reader, const ReadContext& context, bool is_postponing);
  /// The same of a block whose header is that of the block before it.
  bool handle_again(Reader& reader, const ReadContext& context, bool is_postponing);
  std::size_t memory_bytes() const { return last_.memory_bytes() + values_.capacity(); }

 private:
  struct Block {
    const EntriesMessage& message;
    const ObjectClass& object_class;
    AttributeSet attributes, repeated, recalled;
  };
  bool read_block(const EntriesMessage& message, Reader& reader, const ReadContext& context,
                  bool is_postponing);
  bool read_records(const Block& block, Reader& reader, const ReadContext& context,
                    bool is_postponing);
  /// Takes the values off the front; all of them, coded. False if they are malformed.
  bool read_values(const Block& block, Reader& reader);
  bool reflect_held(const Block& block, ObjectHandle object, const ReadContext& context);

  AmbassadorBasis basis_;
  Uses uses_;
  EntryValues last_;
  EntryHeader header_;             ///< of the last block
  std::vector<std::byte> values_;  ///< of one record
};

}  // namespace rink::rti
