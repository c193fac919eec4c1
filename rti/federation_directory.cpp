// Routes each connection to the federation execution that it asks for.
#include "rti/federation_directory.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "rti/federation/oldest_stranger.h"
#include "rti/refusal_words.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

/// Passes on what executions send, and forgets whom they drop.
class FederationDirectory::JoinRouter final : public Outlet {
 public:
  JoinRouter(FederationDirectory& directory, Outlet& outlet)
      : directory_(directory), outlet_(outlet) {}
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    outlet_.send(connection, parts);
  }
  std::size_t waiting_bytes(ConnectionId connection) const override {
    return outlet_.waiting_bytes(connection);
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return outlet_.datagram_max(connection);
  }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    outlet_.send_datagrams(connection, datagrams);
  }
  void drop(ConnectionId connection, std::string_view why) override {
    directory_.connections_[connection] = {};
    outlet_.drop(connection, why);
  }

 private:
  FederationDirectory& directory_;
  Outlet& outlet_;
};

FederationDirectory::FederationDirectory(DirectorySettings settings)
    : settings_(std::move(settings)) {}
FederationDirectory::~FederationDirectory() = default;

void FederationDirectory::offer(const Fom& fom) { models_.push_back(&fom); }

FederationExecution* FederationDirectory::find(std::string_view federation) const {
  for (const auto& execution : executions_)
    if (execution->name() == federation) return execution.get();
  return nullptr;
}

HlaError FederationDirectory::create(std::string_view federation, std::uint64_t fom_hash) {
  if (federation.empty()) return HlaError::illegal_name;
  if (find(federation) != nullptr) return HlaError::federation_execution_already_exists;
  if (executions_.size() >= settings_.execution_max) return HlaError::rti_internal_error;
  const auto model = std::find_if(models_.begin(), models_.end(),
                                  [&](const Fom* each) { return each->hash() == fom_hash; });
  if (model == models_.end()) return HlaError::could_not_open_fdd;
  FederationSettings settings = settings_.federation;
  settings.federation = federation;
  executions_.push_back(
      std::make_unique<FederationExecution>(**model, settings, settings_.services));
  executions_.back()->advance_clock(now_);
  return HlaError::none;
}

HlaError FederationDirectory::destroy(std::string_view federation) {
  const auto place = std::find_if(executions_.begin(), executions_.end(),
                                  [&](const auto& each) { return each->name() == federation; });
  if (place == executions_.end()) return HlaError::federation_execution_does_not_exist;
  if ((*place)->federate_count() > 0) return HlaError::federates_currently_joined;
  destroyed_.push_back(std::move(*place));  // the last bytes to it go out with the next flush
  executions_.erase(place);
  return HlaError::none;
}

std::vector<FederationExecutionInformation> FederationDirectory::list() const {
  std::vector<FederationExecutionInformation> list;
  for (const auto& execution : executions_)
    list.push_back({execution->name(), execution->fom().name(),
                    static_cast<std::uint32_t>(execution->federate_count())});
  return list;
}

void FederationDirectory::connect(ConnectionId id) {
  if (id >= connections_.size()) connections_.resize(id + 1);
  connections_[id] = {};
  connections_[id].is_connected = true;
  connections_[id].since = now_;
}

std::optional<ConnectionId> FederationDirectory::oldest_stranger(const ConnectionTest& test) const {
  return oldest_stranger_of(connections_, now_, [&](ConnectionId id) {
    return connections_[id].is_connected && connections_[id].execution == nullptr && test(id);
  });
}

void FederationDirectory::receive(ConnectionId id, Bytes bytes) {
  if (id >= connections_.size() || !connections_[id].is_connected) return;
  Connection& connection = connections_[id];
  if (connection.execution != nullptr) return connection.execution->receive(id, bytes);
  connection.waiting.insert(connection.waiting.end(), bytes.begin(), bytes.end());
  if (!handle_waiting(id)) drop(id);
}

/// False if a frame broke a rule. The transport bounds a batch of bytes, and an incomplete frame is
/// kept only up to the length that an unjoined connection may send.
bool FederationDirectory::handle_waiting(ConnectionId id) {
  Connection& connection = connections_[id];
  std::size_t taken = 0;
  while (connection.is_connected && connection.execution == nullptr) {
    const Bytes rest = Bytes(connection.waiting).subspan(taken);
    const std::optional<FrameHead> head = read_frame_head(rest);
    if (!head) break;
    if (head->length == 0 || head->length > frame_max_to_join) return false;
    const std::size_t size = head->size + head->length;
    if (rest.size() < size) break;
    const Bytes frame = rest.subspan(head->size, head->length);
    connection.silence.broken();  // by a whole frame: a byte now and then is no sign of life
    const bool is_join = static_cast<MessageKind>(frame[0]) == MessageKind::join;
    if (is_join ? !lead(id, frame) : !handle_frame(id, frame)) return false;
    if (!is_join) taken += size;
  }
  std::vector<std::byte> waiting = std::move(connection.waiting);
  connection.waiting.clear();
  waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(taken));
  if (connection.execution != nullptr) connection.execution->receive(id, waiting);
  else if (connection.is_connected) connection.waiting = std::move(waiting);
  return true;
}

bool FederationDirectory::handle_frame(ConnectionId id, Bytes frame) {
  Reader reader(frame);
  PreJoinLimits& limits = connections_[id].limits;
  while (!reader.is_at_end()) {
    if (!limits.ask()) return false;
    std::uint8_t kind = 0;
    reader.number(kind);
    CreateFederationExecutionMessage creation;
    DestroyFederationExecutionMessage destruction;
    switch (static_cast<MessageKind>(kind)) {
      case MessageKind::create_federation_execution:
        if (!exchange(reader, creation)) return false;
        answer(id, FederationExecutionCreatedMessage{
                       creation.federation,
                       static_cast<std::uint8_t>(create(creation.federation, creation.fom_hash))});
        break;
      case MessageKind::destroy_federation_execution:
        if (!exchange(reader, destruction)) return false;
        answer(id, FederationExecutionDestroyedMessage{
                       destruction.federation,
                       static_cast<std::uint8_t>(destroy(destruction.federation))});
        break;
      case MessageKind::list_federation_executions:
        if (std::exchange(limits.wants_list, true)) break;
        for (const FederationExecutionInformation& each : list())
          answer(id, FederationExecutionMessage{0, each.federation, each.model, each.federates});
        answer(id, FederationExecutionMessage{1, {}, {}, 0});
        break;
      case MessageKind::query_management:
        if (!std::exchange(limits.wants_report, true)) management_queries_.push_back(id);
        break;
      default:
        return false;
    }
  }
  return true;
}

/// Hands the connection over to its execution, with the message that asks to join.
bool FederationDirectory::lead(ConnectionId id, Bytes frame) {
  Reader reader(frame.subspan(1));
  JoinMessage message;
  if (!exchange(reader, message)) return false;
  if (message.version != protocol_version)
    return refuse(id, Refusal::wrong_version, refused_version(message.version, protocol_version)),
           true;
  FederationExecution* execution = find(message.federation);
  if (execution == nullptr)
    return refuse(id, Refusal::wrong_federation, to_string(Refusal::wrong_federation)), true;
  connections_[id].execution = execution;
  execution->connect(id);
  return true;
}

void FederationDirectory::refuse(ConnectionId id, Refusal refusal, const std::string& why) {
  answer(id, RefusedMessage{static_cast<std::uint8_t>(refusal), why});
  drop(id);
}

template <class Message>
void FederationDirectory::answer(ConnectionId id, Message message) {
  if (answers_.empty() || answers_.back().connection != id || answers_.back().is_last)
    answers_.push_back({id, {}});
  const std::vector<std::byte> bytes = framed(message);
  answers_.back().bytes.insert(answers_.back().bytes.end(), bytes.begin(), bytes.end());
}

void FederationDirectory::drop(ConnectionId id) {
  ++drops_;
  connections_[id] = {};
  answers_.push_back({id, {}, true});
}

void FederationDirectory::receive_datagram(ConnectionId id, Bytes datagram) {
  if (id < connections_.size() && connections_[id].execution != nullptr)
    connections_[id].execution->receive_datagram(id, datagram);
}

void FederationDirectory::disconnect(ConnectionId id, std::string_view why) {
  if (id >= connections_.size()) return;
  if (connections_[id].execution != nullptr) connections_[id].execution->disconnect(id, why);
  connections_[id] = {};
  std::erase_if(answers_, [id](const Answer& each) { return each.connection == id; });
}

void FederationDirectory::advance_clock(double now, bool is_behind) {
  const double passed_s = now - std::exchange(now_, now),
               lost_after_s = settings_.federation.timeouts.lost_after_s;
  for (const auto& execution : executions_) execution->advance_clock(now, is_behind);
  for (ConnectionId id = 0; id < connections_.size(); ++id) {
    Connection& connection = connections_[id];
    if (!connection.is_connected || connection.execution != nullptr) continue;
    connection.silence.advance(passed_s, is_behind, lost_after_s);
    if (connection.silence.lasted_s() > lost_after_s) drop(id);
  }
}

void FederationDirectory::match() {
  for (const auto& execution : executions_) execution->match();
}

/// One answer lists every execution.
void FederationDirectory::answer_queries(Outlet& outlet) {
  if (management_queries_.empty()) return;
  FrameWriter frame(older_frame_max, FrameForm::older);
  const auto append = [&frame](auto message) {
    write(frame.begin_message(measure(message)), message);
    frame.appended();
  };
  for (const auto& execution : executions_) for_each_message(execution->report(&outlet), append);
  append(ReportEndMessage{});
  const Bytes bytes = frame.bytes();
  for (const ConnectionId id : management_queries_) connections_[id].limits = {};
  for (const ConnectionId id : management_queries_)
    if (connections_[id].is_connected) outlet.send(id, std::span(&bytes, 1));
  management_queries_.clear();
}

void FederationDirectory::flush(Outlet& outlet) {
  for (const Answer& each : answers_) {
    const Bytes bytes = each.bytes;
    if (!bytes.empty()) outlet.send(each.connection, std::span(&bytes, 1));
    connections_[each.connection].limits = {};
    if (each.is_last) outlet.drop(each.connection, "it broke the protocol or was refused");
  }
  answers_.clear();
  answer_queries(outlet);
  JoinRouter join_router(*this, outlet);
  for (const auto& execution : executions_) execution->flush(join_router);
  for (const auto& execution : destroyed_) execution->flush(join_router);
  for (ConnectionId id = 0; !destroyed_.empty() && id < connections_.size(); ++id)
    if (connections_[id].execution != nullptr &&
        std::any_of(destroyed_.begin(), destroyed_.end(),
                    [&](const auto& each) { return each.get() == connections_[id].execution; }))
      join_router.drop(id, "its federation execution was destroyed");
  destroyed_.clear();
}

}  // namespace rink::rti
