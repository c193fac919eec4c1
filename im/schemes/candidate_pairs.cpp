// Keeps both directions: the subscribers near an entity, and the entities near a subscriber.
#include "im/schemes/candidate_pairs.h"

namespace rink::im {
namespace {

template <class List>
void make_room(std::vector<List>& lists, std::uint32_t id) {
  if (id >= lists.size()) lists.resize(id + std::size_t{1});
}

template <class List>
std::size_t bytes_of(const std::vector<List>& lists) {
  std::size_t bytes = lists.capacity() * sizeof(List);
  for (const List& list : lists) bytes += list.capacity() * sizeof(list[0]);
  return bytes;
}

}  // namespace

void CandidatePairs::add(Subscriber subscriber, Entity entity) {
  assert(entity >> 31 == 0);  // a key has a bit beside it
  make_room(subscribers_, entity);
  subscribers_[entity].push_back(subscriber);
}

void CandidatePairs::forget(Subscriber subscriber, Entity entity) {
  assert(entity < subscribers_.size());
  Buffer<Subscriber>& near = subscribers_[entity];
  Subscriber* const place = std::find(near.data(), near.data() + near.size(), subscriber);
  assert(place != near.data() + near.size());
  *place = near[near.size() - 1];
  near.resize(near.size() - 1);
}

void CandidatePairs::remove_entity(Entity entity) {
  if (entity >= subscribers_.size()) return;
  for (const Subscriber subscriber : subscribers_[entity].span()) {
    Buffer<Entry>& entries = entries_[subscriber];
    Entry* const end = entries.data() + entries.size();
    Entry* const place =
        std::lower_bound(entries.data(), end, entity << 1,
                         [](Entry entry, std::uint32_t key) { return entry.key < key; });
    assert(place != end && entity_of(*place) == entity);
    std::copy(place + 1, end, place);
    entries.resize(entries.size() - 1);
  }
  subscribers_[entity].clear();
}

void CandidatePairs::remove_subscriber(Subscriber subscriber) {
  if (subscriber >= entries_.size()) return;
  for (const Entry entry : entries_[subscriber].span()) forget(subscriber, entity_of(entry));
  entries_[subscriber].clear();
}

void CandidatePairs::touch(Subscriber subscriber) {
  make_room(entries_, subscriber);
  if (subscriber >= is_touched_.size()) is_touched_.resize(subscriber + std::size_t{1});
  if (is_touched_[subscriber]) return;
  is_touched_[subscriber] = true;
  touched_.push_back(subscriber);
}

void CandidatePairs::wake(Subscriber subscriber) {
  if (subscriber >= entries_.size()) return;
  Buffer<Entry>& entries = entries_[subscriber];
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i].rests_until = -std::numeric_limits<float>::infinity();
}

void CandidatePairs::touch_near(Entity entity) {
  if (entity >= subscribers_.size() || touched_.size() == entries_.size()) return;
  for (const Subscriber subscriber : subscribers_[entity].span()) touch(subscriber);
}

void CandidatePairs::decide(Subscriber subscriber, std::size_t i, bool is, float rests_until) {
  assert(subscriber < entries_.size() && i < entries_[subscriber].size());
  Entry& entry = entries_[subscriber][i];
  const Entity entity = entity_of(entry);
  if (is != is_relevant(entry))
    decided_.push_back({subscriber, entity, is ? Transition::entered : Transition::left});
  entry = {entity << 1 | (is ? 1u : 0u), rests_until};
}

void CandidatePairs::report(Buffer<Change>& changes) {
  const std::size_t before = changes.size();
  changes.resize(before + left_.size() + decided_.size());
  std::merge(left_.data(), left_.data() + left_.size(), decided_.data(),
             decided_.data() + decided_.size(), changes.data() + before);
  left_.clear(), decided_.clear();
}

void CandidatePairs::check() const {
  // Sums of a function of each pair, which the same pairs have in any order.
  const auto mark = [](std::uint64_t subscriber, std::uint64_t entity) {
    return (subscriber << 32 | entity) * 0x9e3779b97f4a7c15u >> 16;
  };
  [[maybe_unused]] std::uint64_t by_subscriber = 0, by_entity = 0;
  for (std::size_t subscriber = 0; subscriber < entries_.size(); ++subscriber) {
    const std::span<const Entry> entries = entries_[subscriber].span();
    for (std::size_t i = 0; i < entries.size(); ++i) {
      assert(i == 0 || entity_of(entries[i - 1]) < entity_of(entries[i]));
      by_subscriber += mark(subscriber, entity_of(entries[i]));
    }
  }
  for (std::size_t entity = 0; entity < subscribers_.size(); ++entity)
    for (const Subscriber subscriber : subscribers_[entity].span())
      by_entity += mark(subscriber, entity);
  assert(by_subscriber == by_entity);
  assert(touched_.size() <= is_touched_.size());
  for ([[maybe_unused]] const Subscriber subscriber : touched_.span())
    assert(is_touched_[subscriber]);
}

std::size_t CandidatePairs::bytes() const {
  return bytes_of(entries_) + bytes_of(subscribers_) + sizeof(Entry) * merged_.capacity() +
         sizeof(Subscriber) * touched_.capacity() + is_touched_.capacity() / 8;
}

}  // namespace rink::im
