// A copy of each byte that passes goes to the reader of its conversation.
#include "rti/transport/staged/ledger_stage.h"

#include <utility>

namespace rink::rti {

LedgerStage::LedgerStage(const Fom& fom, MakeHostContent make_content)
    : fom_(fom), residuals_(fom), make_content_(std::move(make_content)) {}

void LedgerStage::on_open(ConnectionId connection) {
  if (connection >= conversations_.size()) conversations_.resize(connection + 1);
  const ConversationFields::Uses uses{fom_, residuals_, ledger_};
  conversations_[connection] = std::make_unique<Conversation>(
      Conversation{{uses, LedgerDirection::down, make_content_ ? make_content_() : nullptr},
                   {uses, LedgerDirection::up, nullptr}});
  TransportStage::on_open(connection);
}

void LedgerStage::on_bytes(ConnectionId connection, Bytes bytes) {
  if (Conversation* conversation = find(connection)) conversation->up.read(bytes);
  else
    ledger_.add({LedgerDirection::up, LedgerChannel::stream, "unread", {}, "bytes"},
                8 * bytes.size());
  TransportStage::on_bytes(connection, bytes);
}

void LedgerStage::on_datagram(ConnectionId connection, Bytes datagram) {
  if (Conversation* conversation = find(connection)) conversation->up.read_datagram(datagram);
  TransportStage::on_datagram(connection, datagram);
}

void LedgerStage::on_close(ConnectionId connection, CloseReason reason, const std::string& detail) {
  end(connection);
  TransportStage::on_close(connection, reason, detail);
}

void LedgerStage::send(ConnectionId connection, std::span<const Bytes> parts) {
  if (Conversation* conversation = find(connection))
    for (const Bytes part : parts) conversation->down.read(part);
  TransportStage::send(connection, parts);
}

void LedgerStage::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  Conversation* conversation = find(connection);
  if (conversation != nullptr && datagram_max(connection) > 0)
    for (const Datagram& each : datagrams) {
      datagram_.assign(each.head.begin(), each.head.end());
      datagram_.insert(datagram_.end(), each.body.begin(), each.body.end());
      conversation->down.read_datagram(datagram_);
    }
  TransportStage::send_datagrams(connection, datagrams);
}

/// What the user sends after that is sent to nobody.
void LedgerStage::close(ConnectionId connection) {
  end(connection);
  TransportStage::close(connection);
}

void LedgerStage::end(ConnectionId connection) {
  Conversation* conversation = find(connection);
  if (conversation == nullptr) return;
  conversation->down.end();
  conversation->up.end();
  conversations_[connection].reset();
}

std::vector<LedgerRow> LedgerStage::rows() const {
  std::vector<LedgerRow> rows = ledger_.rows();
  LedgerRow down{LedgerDirection::down, LedgerChannel::stream, "unfinished", "bytes", {}},
      up{LedgerDirection::up, LedgerChannel::stream, "unfinished", "bytes", {}};
  for (const auto& each : conversations_) {
    if (!each) continue;
    down.amount.bits += 8 * static_cast<std::int64_t>(each->down.waiting_bytes());
    up.amount.bits += 8 * static_cast<std::int64_t>(each->up.waiting_bytes());
  }
  rows.push_back(std::move(down));
  rows.push_back(std::move(up));
  return rows;
}

}  // namespace rink::rti
