// A short summary of a model, element by element, by which a refused federate finds out where its
// own differs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rti/fom/fom.h"

namespace rink::rti {

/// Hashes (FNV-1a, 32 bits) of an element's name and of its content that both ends must agree on.
struct FomDigestEntry {
  std::uint32_t name = 0, content = 0;
  friend auto operator<=>(const FomDigestEntry&, const FomDigestEntry&) = default;
};

/// Classes, their own attributes or parameters, and dimensions, in the model's order.
std::vector<FomDigestEntry> digest(const Fom& fom);
/// Describes how `own` differs from the model whose digest is `other`: "attribute 'speed' of object
/// class 'Vessel' differs (and 2 more)". Empty if it does not.
std::string difference(const Fom& own, std::span<const FomDigestEntry> other);

}  // namespace rink::rti
