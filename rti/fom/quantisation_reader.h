// Reads the resolution of data types from an object model.
#pragma once

#include <memory>
#include <string>

#include "rti/fom/data_types.h"
#include "rti/fom/quantised_codec.h"

namespace rink::rti {

/// The codec of a type of fixed size; null if every bit of its values travels. Quantised are a
/// simple type whose <resolution> is a number and that has a note "range LOW HIGH", and fixed
/// records that hold such a type. A field of a record whose note says "rate of FIELD" is that
/// field's change per second, by which receivers of periodic state look ahead. `types` are those of
/// `modules`. Throws `FileError`.
std::shared_ptr<const QuantisedCodec> quantised_codec_of(const std::string& data_type,
                                                         DataTypes& types,
                                                         const FomModules& modules);

}  // namespace rink::rti
