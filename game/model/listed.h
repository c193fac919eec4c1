// Lists in words, for messages and texts.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rink::game {

/// Adds `word` to `list`, after a comma unless it is the first.
inline void add_to_list(std::string& list, std::string_view word) {
  if (!list.empty()) list += ", ";
  list += word;
}

/// What `word_of` makes of each of `items`, with commas between them: "tcp, udp, shm".
template <class Items, class WordOf = std::identity>
std::string listed(const Items& items, const WordOf& word_of = {}) {
  std::string list;
  for (const auto& item : items) add_to_list(list, word_of(item));
  return list;
}

}  // namespace rink::game
