// The seam to where saved federations are kept.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

/// A save replaces one of the same federation and label, whole or not at all.
class SaveStore {
 public:
  virtual ~SaveStore() = default;
  /// Empty, or why it failed: then what was there before is untouched.
  virtual std::string write(std::string_view federation, std::string_view label, Bytes bytes) = 0;
  /// The bytes, or why there are none.
  struct Found {
    std::optional<std::vector<std::byte>> bytes;
    std::string why;
  };
  virtual Found read(std::string_view federation, std::string_view label) = 0;
};

}  // namespace rink::rti
