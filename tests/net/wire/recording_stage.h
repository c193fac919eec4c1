// Writes down every byte that passes, as the second reader of docs/wire.md takes it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rti/transport/staged/staged_transport.h"
#include "rti/wire/stream.h"

namespace rink::game {

class RecordingStage final : public rti::TransportStage {
 public:
  void send(rti::ConnectionId connection, std::span<const rti::Bytes> parts) override {
    for (const rti::Bytes part : parts) keep('d', connection, part);
    TransportStage::send(connection, parts);
  }
  const std::string& record() const { return record_; }
  std::uint64_t bytes_of(char direction) const { return direction == 'd' ? down_ : up_; }

 private:
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override {
    keep('u', connection, bytes);
    TransportStage::on_bytes(connection, bytes);
  }
  void keep(char direction, rti::ConnectionId connection, rti::Bytes bytes) {
    (direction == 'd' ? down_ : up_) += bytes.size();
    std::vector<std::byte> head;
    rti::Writer writer(head);
    auto size = static_cast<std::uint32_t>(bytes.size());
    writer.number(connection), writer.number(size);
    record_ += direction;
    for (const rti::Bytes part : {rti::Bytes(head), bytes})
      record_.append(reinterpret_cast<const char*>(part.data()), part.size());
  }

  std::string record_;
  std::uint64_t down_ = 0, up_ = 0;
};

}  // namespace rink::game
