// The elements of an array or record: each a copy of its own, or one of the user's.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "rti/standard/encoding/octets.h"

namespace rink::standard {

/// One element.
class ElementSlot {
 public:
  explicit ElementSlot(const rti1516e::DataElement& element)
      : own_(element.clone().release()), element_(own_.get()) {}
  explicit ElementSlot(rti1516e::DataElement* external) : element_(external) {
    if (external == nullptr)
      throw rti1516e::EncoderException(L"the pointer to the element is null");
  }
  /// A copy owns what it holds.
  ElementSlot(const ElementSlot& other) : ElementSlot(*other.element_) {}
  ElementSlot& operator=(const ElementSlot&) = delete;
  ElementSlot(ElementSlot&&) = default;
  ElementSlot& operator=(ElementSlot&&) = default;

  const rti1516e::DataElement& get() const { return *element_; }
  rti1516e::DataElement& get() { return *element_; }
  /// Throw EncoderException if the element is of another type. Values go into what is held: where
  /// that is the user's, the user sees them.
  void set(const rti1516e::DataElement& element) {
    check(element);
    Octets buffer;
    element.encodeInto(buffer);
    element_->decodeFrom(buffer, 0);
  }
  void set_pointer(rti1516e::DataElement* external) {
    ElementSlot slot(external);
    check(*external);
    *this = std::move(slot);
  }

 private:
  void check(const rti1516e::DataElement& element) const {
    if (!element_->isSameTypeAs(element))
      throw rti1516e::EncoderException(L"the element is of another type");
  }

  std::unique_ptr<rti1516e::DataElement> own_;
  rti1516e::DataElement* element_;
};

/// Elements one after the other, each at a multiple of its octet boundary from the first octet of
/// what they are in (IEEE 1516.2-2010, 4.13.9).
class ElementSlots {
 public:
  std::size_t size() const { return slots_.size(); }
  ElementSlot& at(std::size_t index) {
    check(index);
    return slots_[index];
  }
  const ElementSlot& at(std::size_t index) const {
    check(index);
    return slots_[index];
  }
  template <class Element>
  void add(Element&& element) {
    slots_.emplace_back(std::forward<Element>(element));
  }
  /// Makes `count` elements of it, new ones like `prototype`.
  void resize(std::size_t count, const rti1516e::DataElement& prototype) {
    slots_.erase(slots_.begin() + static_cast<std::ptrdiff_t>(std::min(count, size())),
                 slots_.end());
    slots_.reserve(count);
    while (size() < count) add(prototype);
  }
  unsigned boundary() const {
    unsigned most = 1;
    for (const ElementSlot& each : slots_) most = std::max(most, each.get().getOctetBoundary());
    return most;
  }
  /// `begin` is where in the buffer the array or record begins.
  void encode(Octets& buffer, std::size_t begin) const {
    for (const ElementSlot& each : slots_) {
      buffer.resize(buffer.size() + padding(buffer.size() - begin, each.get().getOctetBoundary()));
      each.get().encodeInto(buffer);
    }
  }
  std::size_t decode(const Octets& buffer, std::size_t begin, std::size_t index) {
    for (ElementSlot& each : slots_) {
      index += padding(index - begin, each.get().getOctetBoundary());
      index = each.get().decodeFrom(buffer, index);
    }
    return index;
  }
  bool is_same_type(const ElementSlots& other) const {
    return std::equal(slots_.begin(), slots_.end(), other.slots_.begin(), other.slots_.end(),
                      [](const ElementSlot& one, const ElementSlot& two) {
                        return one.get().isSameTypeAs(two.get());
                      });
  }

 private:
  void check(std::size_t index) const {
    if (index >= size())
      throw rti1516e::EncoderException(L"there is no element " + std::to_wstring(index) + L" of " +
                                       std::to_wstring(size()));
  }

  std::vector<ElementSlot> slots_;
};

}  // namespace rink::standard
