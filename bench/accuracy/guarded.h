// Work in a process of its own, so that what crashes or hangs there is a result and not the end.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace rink::accuracy {

/// What became of guarded work: its output, or why there is none.
struct Outcome {
  std::optional<std::string> output;
  std::string why_not;  ///< e.g. "longer than 5 s", "signal 11 (Segmentation fault)", "interrupted"
};

/// Runs `work` in a child process that is ended after `limit_s` [s], when `is_interrupted` gets
/// true, or with this process. What it says on standard error is dropped, and it may use 4 GB of
/// memory. There must be no other thread. Throws std::system_error if no process can be had.
Outcome guarded(const std::function<std::string()>& work, double limit_s,
                const std::atomic<bool>* is_interrupted = nullptr);

/// The bytes of a plain value, to come through a pipe and back.
template <class Value>
std::string to_bytes(const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}
/// Nothing if `bytes` are not of one Value.
template <class Value>
std::optional<Value> from_bytes(const std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  if (bytes.size() != sizeof(Value)) return std::nullopt;
  Value value;
  bytes.copy(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

}  // namespace rink::accuracy
