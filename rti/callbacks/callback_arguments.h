// Stores the arguments of a callback in a buffer of bytes and reads them again.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rti/federate_ambassador.h"
#include "rti/management/federation_report.h"

namespace rink::rti {

/// Appends arguments, each at a multiple of `alignment`, so that a view of them needs no copy.
class ArgumentWriter {
 public:
  static constexpr std::size_t alignment = alignof(std::max_align_t);
  explicit ArgumentWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void put(const Value& value) { append(&value, sizeof value); }
  template <class Value>
  void put(std::span<const Value> values) {
    put(values.size());
    append(values.data(), values.size_bytes());
  }
  void put(std::string_view text) { put(std::span(text.data(), text.size())); }
  void put(const std::vector<FederationExecutionInformation>& executions) {
    put(executions.size());
    for (const FederationExecutionInformation& each : executions)
      put_all(each.federation, each.model, each.federates);
  }
  void put(const std::vector<std::string>& texts) {
    put(texts.size());
    for (const std::string& each : texts) put(each);
  }
  void put(const std::vector<FederationReport>& reports) {
    put(reports.size());
    for (const FederationReport& report : reports) {
      put_all(report.federation, report.model, report.filter, report.objects, report.drops,
              report.federates.size());
      for (const FederateReport& each : report.federates)
        put_all(each.federate, each.name, each.type, each.counts);
    }
  }

 private:
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class... Values>
  void put_all(const Values&... values) {
    (put(values), ...);
  }
  void append(const void* from, std::size_t size) {
    const std::size_t end = bytes_.size();
    assert(end % alignment == 0);
    bytes_.resize(end + (size + alignment - 1) / alignment * alignment);
    if (size > 0) std::memcpy(bytes_.data() + end, from, size);
  }
  std::vector<std::byte>& bytes_;
};

/// Reads arguments in the same order; views are into the bytes that are read.
class ArgumentReader {
 public:
  explicit ArgumentReader(const std::byte* at) : at_(at) {}

  template <class Value>
  Value take() {
    return take(static_cast<std::type_identity<Value>*>(nullptr));
  }

 private:
  template <class Value>
  Value take(std::type_identity<Value>*) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::array<std::byte, sizeof(Value)> bytes;  // a value may have no default
    std::memcpy(bytes.data(), advance(sizeof bytes), sizeof bytes);
    return std::bit_cast<Value>(bytes);
  }
  template <class Value>
  std::span<const Value> take(std::type_identity<std::span<const Value>>*) {
    const auto count = take<std::size_t>();
    return {reinterpret_cast<const Value*>(advance(count * sizeof(Value))), count};
  }
  std::string_view take(std::type_identity<std::string_view>*) {
    const auto text = take<std::span<const char>>();
    return {text.data(), text.size()};
  }
  std::vector<FederationExecutionInformation> take(
      std::type_identity<std::vector<FederationExecutionInformation>>*) {
    std::vector<FederationExecutionInformation> executions(take<std::size_t>());
    for (FederationExecutionInformation& each : executions)
      take_all(each.federation, each.model, each.federates);
    return executions;
  }
  std::vector<std::string> take(std::type_identity<std::vector<std::string>>*) {
    std::vector<std::string> texts(take<std::size_t>());
    for (std::string& each : texts) each = take<std::string>();
    return texts;
  }
  std::vector<FederationReport> take(std::type_identity<std::vector<FederationReport>>*) {
    std::vector<FederationReport> reports(take<std::size_t>());
    for (FederationReport& report : reports) {
      std::size_t federates = 0;
      take_all(report.federation, report.model, report.filter, report.objects, report.drops,
               federates);
      report.federates.resize(federates);
      for (FederateReport& each : report.federates)
        take_all(each.federate, each.name, each.type, each.counts);
    }
    return reports;
  }
  std::string take(std::type_identity<std::string>*) {
    return std::string(take<std::string_view>());
  }
  template <class... Values>
  void take_all(Values&... values) {
    ((values = take<Values>()), ...);
  }
  const std::byte* advance(std::size_t size) {
    const std::byte* here = at_;
    assert(reinterpret_cast<std::uintptr_t>(here) % ArgumentWriter::alignment == 0);
    at_ += (size + ArgumentWriter::alignment - 1) / ArgumentWriter::alignment *
           ArgumentWriter::alignment;
    return here;
  }
  const std::byte* at_;
};

}  // namespace rink::rti
