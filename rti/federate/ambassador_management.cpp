// A federate's side of federation management: what it asks a host, join and resign, synchronisation
// points.
#include <algorithm>

#include "rti/federate/ambassador_services.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {

void require_text(std::string_view text, std::size_t max, const char* what) {
  if (text.size() > max)
    throw RtiException(HlaError::illegal_name,
                       std::string(what) + " has " + std::to_string(text.size()) +
                           " bytes; allowed are at most " + std::to_string(max));
}

}  // namespace

template <class Message>
void AmbassadorParts::ask(Message message) {
  if (!phase_.is_idle())
    throw RtiException(HlaError::federate_already_execution_member,
                       "a host is asked before the join, or by another ambassador");
  has_asked_ = true;
  frames_.enqueue_alone(message);
}

void AmbassadorServices::create_federation_execution(std::string_view federation,
                                                     const Fom& model) {
  require_text(federation, text_max, "the federation execution's name");
  if (federation.empty())
    throw RtiException(HlaError::illegal_name, "a federation execution needs a name");
  ask(CreateFederationExecutionMessage{federation, model.hash()});
}

void AmbassadorServices::destroy_federation_execution(std::string_view federation) {
  require_text(federation, text_max, "the federation execution's name");
  ask(DestroyFederationExecutionMessage{federation});
}

void AmbassadorServices::list_federation_executions() { ask(ListFederationExecutionsMessage{}); }

void AmbassadorServices::query_management() {
  if (phase_.is_idle()) ask(QueryManagementMessage{});
  else frames_.enqueue(QueryManagementMessage{});
}

void AmbassadorServices::join(std::string_view federation, std::string_view federate_name,
                              std::string_view federate_type) {
  if (!phase_.is_idle())
    throw RtiException(HlaError::federate_already_execution_member, "an ambassador joins once");
  require_text(federation, text_max, "the federation execution's name");
  require_text(federate_name, text_max, "the federate's name");
  require_text(federate_type, text_max, "the federate's type");
  phase_.begin_joining();
  regions_.sign(federate_name);
  federates_ = {{FederateHandle{}, std::string(federate_name)}};
  JoinMessage message;
  message.fom_hash = fom_.hash();
  message.federation = federation;
  message.name = federate_name;
  message.type = federate_type;
  frames_.enqueue_alone(message);
  frames_.count_from_here();
}

void AmbassadorServices::resign() {
  if (phase_.may_send()) frames_.enqueue(ResignMessage{});
  phase_.end();
}

void AmbassadorServices::watch_federates() { frames_.enqueue(WatchFederatesMessage{}); }

void AmbassadorServices::register_synchronization_point(std::string_view label, Bytes tag,
                                                        std::span<const FederateHandle> members) {
  require_text(label, text_max, "the synchronisation point's label");
  if (tag.size() > synchronization_tag_max)
    throw RtiException(HlaError::rti_internal_error,
                       "a synchronisation point's tag has at most 1024 bytes");
  if (members.size() > HandleList::count_max)
    throw RtiException(HlaError::rti_internal_error,
                       "a synchronisation point's set names at most 16000 federates");
  frames_.enqueue(RegisterSynchronizationPointMessage{label, tag, list_of(members)});
}

void AmbassadorServices::synchronization_point_achieved(std::string_view label, bool is_success) {
  phase_.require_joined();
  if (std::erase(announced_points_, label) == 0)
    throw RtiException(
        HlaError::synchronization_point_label_not_announced,
        "'" + std::string(label) + "' is not announced to this federate, or it has achieved it");
  frames_.enqueue(
      SynchronizationPointAchievedMessage{label, static_cast<std::uint8_t>(is_success)});
}

bool AmbassadorParts::take_synchronization(Reader& reader, MessageKind kind) {
  if (kind == MessageKind::synchronization_point_registered) {
    SynchronizationPointRegisteredMessage message;
    if (!exchange(reader, message)) return false;
    if (message.failure == 0)
      callbacks_.synchronization_point_registration_succeeded(message.label);
    else
      callbacks_.synchronization_point_registration_failed(
          message.label, static_cast<SynchronizationFailure>(message.failure));
    return true;
  }
  if (kind == MessageKind::announce_synchronization_point) {
    AnnounceSynchronizationPointMessage message;
    if (!exchange(reader, message)) return false;
    announced_points_.emplace_back(message.label);
    callbacks_.announce_synchronization_point(message.label, message.tag);
    return true;
  }
  FederationSynchronizedMessage message;
  if (!exchange(reader, message)) return false;
  callbacks_.federation_synchronized(message.label, handles_of(message.failed));
  return true;
}

bool AmbassadorParts::take_host_answer(Reader& reader, MessageKind kind) {
  if (!has_asked_) return false;
  if (kind == MessageKind::federation_execution) return take_execution(reader);
  FederationExecutionCreatedMessage message;  // the two outcomes differ in their kind only
  if (!exchange(reader, message)) return false;
  const auto error = static_cast<HlaError>(message.error);
  if (kind == MessageKind::federation_execution_created)
    callbacks_.federation_execution_created(message.federation, error);
  else callbacks_.federation_execution_destroyed(message.federation, error);
  return true;
}

bool AmbassadorParts::take_execution(Reader& reader) {
  FederationExecutionMessage message;
  if (!exchange(reader, message)) return false;
  if (message.is_end == 0) {
    executions_.push_back(
        {std::string(message.federation), std::string(message.model), message.federates});
    return true;
  }
  std::vector<FederationExecutionInformation> executions;
  executions.swap(executions_);
  callbacks_.report_federation_executions(executions);
  return true;
}

bool AmbassadorParts::take_report(Reader& reader, MessageKind kind) {
  if (kind == MessageKind::federation_report) {
    FederationReportMessage message;
    if (!exchange(reader, message)) return false;
    reports_.push_back({std::string(message.federation),
                        std::string(message.model),
                        std::string(message.filter),
                        message.objects,
                        message.drops,
                        {}});
    return true;
  }
  if (kind == MessageKind::federate_report) {
    FederateReportMessage message;
    if (!exchange(reader, message) || reports_.empty()) return false;
    reports_.back().federates.push_back(
        {{message.federate}, std::string(message.name), std::string(message.type), message.counts});
    return true;
  }
  std::vector<FederationReport> reports;
  reports.swap(reports_);
  callbacks_.report_management(reports);
  return true;
}

FederateHandle AmbassadorServices::get_federate_handle(std::string_view name) const {
  for (const auto& [federate, each] : federates_)
    if (federate && each == name) return federate;
  throw RtiException(HlaError::name_not_found, "no federate is called '" + std::string(name) + "'");
}

const std::string& AmbassadorServices::get_federate_name(FederateHandle federate) const {
  for (const auto& [each, name] : federates_)
    if (federate && each == federate) return name;
  throw RtiException(HlaError::name_not_found,
                     "no federate of handle " + std::to_string(federate.value) + " is known");
}

ObjectClassHandle AmbassadorServices::get_known_object_class_handle(ObjectHandle object) const {
  const KnownObject* known = const_cast<AmbassadorServices*>(this)->find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  return {known->object_class};
}

}  // namespace rink::rti
