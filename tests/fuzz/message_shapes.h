// Messages to the RTI, made by their shapes from whatever bytes a fuzzer has.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "rti/wire/message.h"
#include "rti/wire/update_block.h"
#include "tests/fuzz/harness.h"
#include "tests/rti/rig.h"

namespace rink::fuzz {

/// One message of a group: its kind, and a letter for each field (`Scribe::field`).
struct Shape {
  rti::MessageKind kind;
  std::string_view fields;
};

/// Makes messages from a fuzzer's bytes.
class Scribe {
 public:
  Scribe(Input& input, const std::vector<std::uint32_t>& objects)
      : input_(input), objects_(objects) {}
  std::vector<std::byte> message(const Shape& shape) {
    bytes_.assign(1, static_cast<std::byte>(shape.kind));
    for (const char letter : shape.fields) field(letter);
    return bytes_;
  }

 private:
  template <class Number>
  void put(Number value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }
  void varint(std::uint64_t value) { rti::Writer(bytes_).varint(value); }
  std::uint32_t object() { return objects_[input_.byte() % objects_.size()]; }
  double time() { return (static_cast<double>(input_.byte()) - 8.0) / 4.0; }
  std::uint32_t region() {
    const unsigned byte = input_.byte();
    return byte > 250 ? ~0u : byte % 6;
  }
  void regions(bool has_attributes) {
    const auto count = static_cast<std::uint16_t>(input_.byte() % 4);
    put(count);
    for (int i = 0; i < count; ++i) {
      if (has_attributes) put(std::uint32_t{input_.byte() % 8});
      put(region());
    }
  }
  void raw() {
    const rti::Bytes part = input_.part(input_.byte() % 24);
    put(static_cast<std::uint16_t>(part.size()));
    bytes_.insert(bytes_.end(), part.begin(), part.end());
  }
  void stamp(double at) {
    rti::StampMessage message{{at, 0}};
    rti::Writer writer(bytes_);
    exchange(writer, message);
  }
  /// A whole message in time-stamp order.
  void content() {
    std::vector<std::byte> outer;
    outer.swap(bytes_);
    const unsigned what = input_.byte() % 3;
    if (what == 0) {
      rti::UpdatesMessage message{static_cast<std::uint16_t>(rti::testing::vessel.value),
                                  rti::AttributeSet{rti::testing::speed}.bits};
      write(bytes_, message);
      varint(rti::handle_step(0, object()));
      put(1.0f);
      bytes_.push_back(std::byte{0});
    } else if (what == 1) {
      rti::InteractionMessage message{
          static_cast<std::uint16_t>(rti::testing::hail.value), rti::FederateHandle::none, {}, {}};
      write(bytes_, message);
    } else {
      rti::DeleteObjectMessage message{object()};
      write(bytes_, message);
    }
    outer.swap(bytes_);
    put(static_cast<std::uint16_t>(outer.size()));
    bytes_.insert(bytes_.end(), outer.begin(), outer.end());
  }
  void field(char letter) {
    switch (letter) {
      case 'b':
        return put(static_cast<std::uint8_t>(input_.byte() % 10));
      case 'w':
        return put(static_cast<std::uint16_t>(input_.byte() % 8));
      case 'd':
        return put(time());
      case 'q':
        return put(std::uint64_t{input_.byte() % 4});
      case 'v':
        return varint(input_.byte());
      case 'a':
        return put(std::uint32_t{input_.byte() % 8});
      case 'A':
        return varint(1 + input_.byte() % 7);
      case 'o':
        return varint(object());
      case 'u':
        return put(object());
      case 'r':
        return put(region());
      case 's':
        return stamp(time());
      case 't':
        return raw();
      case 'c':
        return content();
      case 'p':
        return regions(true);
      case 'l':
        return regions(false);
      case 'O': {
        std::uint32_t last = 0;
        for (unsigned left = 1 + input_.byte() % 3; left > 0; --left) {
          const std::uint32_t next = object();
          varint(rti::handle_step(last, next));
          last = next;
        }
        return varint(0);
      }
      case 'g': {
        const auto count = static_cast<std::uint8_t>(input_.byte() % 3);
        put(count);
        for (int i = 0; i < count; ++i) {
          const double low = time();
          put(low);
          put(low + std::abs(time()));
        }
        return;
      }
      default:
        require(false, "a field's letter is known");
    }
  }

  Input& input_;
  const std::vector<std::uint32_t>& objects_;
  std::vector<std::byte> bytes_;
};

}  // namespace rink::fuzz
