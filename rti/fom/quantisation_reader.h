// What an object model says of the resolution of its data types.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "rti/fom/quantised_codec.h"

namespace rink::rti {

/// What is wrong with an element; the reader of the file says where it stands.
struct QuantisationError {
  pugi::xml_node node;
  std::string what;
};

/// Finds the codecs of data types: of a simple type whose <resolution> is a number and that has a
/// note "range LOW HIGH", and of fixed records that hold such a type. A field of a record whose
/// note says "rate of FIELD" is that field's change per second, by which receivers of periodic
/// state look ahead.
class QuantisationReader {
 public:
  using Types = std::map<std::string, pugi::xml_node>;
  /// How values of fixed size lie in memory.
  struct Layout {
    std::function<std::uint32_t(const std::string& data_type)> size_of;  ///< [bytes]
    /// Before each field [bytes].
    std::function<std::vector<std::uint32_t>(const pugi::xml_node& record)> padding_of;
  };
  /// Of a type of fixed size; null if every bit of its values travels. Throws QuantisationError.
  static std::shared_ptr<const QuantisedCodec> codec_of(const std::string& data_type,
                                                        const Types& types, const Layout& layout);
};

}  // namespace rink::rti
