// Where the bytes of conversations go: bits by direction, channel, form and field.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rink::rti {

enum class LedgerDirection : std::uint8_t { down, up };  ///< from the RTI, and to it
enum class LedgerChannel : std::uint8_t { stream, datagram };

/// What the bits of one row are. The texts are literals or names of the object model.
struct LedgerField {
  LedgerDirection direction = LedgerDirection::down;
  LedgerChannel channel = LedgerChannel::stream;
  std::string_view form;     ///< the message (docs/wire.md), or what is around messages
  std::string_view subject;  ///< the attribute or interaction class; empty of what is none's
  std::string_view field;
  friend auto operator<=>(const LedgerField&, const LedgerField&) = default;
};

struct LedgerAmount {
  std::int64_t bits = 0, times = 0;  ///< `times`: how many fields these are
};

/// One row, which outlives the object model.
struct LedgerRow {
  LedgerDirection direction = LedgerDirection::down;
  LedgerChannel channel = LedgerChannel::stream;
  std::string form, field;  ///< "trajectory.position": a field of the attribute "trajectory"
  LedgerAmount amount;
  friend bool operator==(const LedgerRow& a, const LedgerRow& b) {
    return a.direction == b.direction && a.channel == b.channel && a.form == b.form &&
           a.field == b.field;
  }
};

class ByteLedger {
 public:
  void add(const LedgerField& field, std::uint64_t bits) {
    LedgerAmount& amount = amounts_[field];
    amount.bits += static_cast<std::int64_t>(bits);
    ++amount.times;
  }
  /// All rows so far, by direction, channel, form and field.
  std::vector<LedgerRow> rows() const {
    std::vector<LedgerRow> rows;
    rows.reserve(amounts_.size());
    for (const auto& [key, amount] : amounts_) {
      std::string field(key.subject);
      if (!key.subject.empty() && !key.field.empty()) field += '.';
      rows.push_back(
          {key.direction, key.channel, std::string(key.form), field.append(key.field), amount});
    }
    return rows;
  }

 private:
  std::map<LedgerField, LedgerAmount> amounts_;
};

/// What came from `begin` to `end`, of which the former's rows are a part; rows without bits are
/// left out.
inline std::vector<LedgerRow> ledger_between(const std::vector<LedgerRow>& begin,
                                             std::vector<LedgerRow> end) {
  for (LedgerRow& row : end)
    for (const LedgerRow& before : begin)
      if (before == row)
        row.amount = {row.amount.bits - before.amount.bits, row.amount.times - before.amount.times};
  std::erase_if(end, [](const LedgerRow& row) { return row.amount.bits == 0; });
  return end;
}

}  // namespace rink::rti
