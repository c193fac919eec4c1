// Lays out the tree, and writes and reads what goes along it.
#include "game/peer/verdict_tree.h"

#include <algorithm>

#include "game/peer/message_bytes.h"

namespace rink::peer {

namespace {

constexpr std::size_t bundle_checksum = 4;

}  // namespace

std::vector<std::uint8_t> written(VerdictBundle message) {
  return bytes_from(message, bundle_checksum);
}
bool read(std::span<const std::uint8_t> bytes, VerdictBundle& message) {
  return read_whole(bytes, message, bundle_checksum);
}

std::vector<std::size_t> VerdictTree::children(std::size_t place) const {
  assert(place < count_);
  std::vector<std::size_t> all;
  for (std::size_t child = degree_ * place + 1;
       child <= degree_ * place + degree_ && child < count_; ++child)
    all.push_back(child);
  return all;
}

std::vector<std::size_t> VerdictTree::branch(std::size_t place) const {
  std::vector<std::size_t> all{place};
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::vector<std::size_t> below = children(all[k]);
    all.insert(all.end(), below.begin(), below.end());
  }
  assert(std::ranges::is_sorted(all));
  return all;
}

std::size_t VerdictTree::depth() const {
  std::size_t links = 0;
  for (std::size_t place = count_ - 1; place > 0; place = parent(place)) ++links;
  return links;
}

}  // namespace rink::peer
