// Sends questions to a host, each in a frame of its own, and handles the answers.
#include "rti/federate/services/host_questions.h"

#include <string>
#include <utility>

#include "rti/federate/books/require.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

template <class Message>
void HostQuestions::ask(Message message) {
  if (!basis_.phase.is_idle())
    throw RtiException(HlaError::federate_already_execution_member,
                       "a host is asked before the join, or by another ambassador");
  has_asked_ = true;
  basis_.frames.enqueue_alone(message);
}

void HostQuestions::create_federation_execution(std::string_view federation, const Fom& model) {
  require_text(federation, "the federation execution's name");
  if (federation.empty())
    throw RtiException(HlaError::illegal_name, "a federation execution needs a name");
  ask(CreateFederationExecutionMessage{federation, model.hash()});
}

void HostQuestions::destroy_federation_execution(std::string_view federation) {
  require_text(federation, "the federation execution's name");
  ask(DestroyFederationExecutionMessage{federation});
}

void HostQuestions::list_federation_executions() { ask(ListFederationExecutionsMessage{}); }

void HostQuestions::query_management() {
  if (basis_.phase.is_idle()) ask(QueryManagementMessage{});
  else basis_.frames.enqueue(QueryManagementMessage{});
}

void HostQuestions::notify_host() {
  if (!basis_.phase.is_joined())
    throw RtiException(HlaError::federate_not_execution_member, "a host hears its members alone");
  basis_.frames.enqueue(NotifyHostMessage{});
}

bool HostQuestions::handle_created(Reader& reader) {
  FederationExecutionCreatedMessage message;
  if (!has_asked_ || !exchange(reader, message)) return false;
  basis_.callbacks.federation_execution_created(message.federation,
                                                static_cast<HlaError>(message.error));
  return true;
}

bool HostQuestions::handle_destroyed(Reader& reader) {
  FederationExecutionCreatedMessage message;  // the two outcomes differ in their kind only
  if (!has_asked_ || !exchange(reader, message)) return false;
  basis_.callbacks.federation_execution_destroyed(message.federation,
                                                  static_cast<HlaError>(message.error));
  return true;
}

bool HostQuestions::handle_execution(Reader& reader) {
  FederationExecutionMessage message;
  if (!has_asked_ || !exchange(reader, message)) return false;
  if (message.is_end == 0) {
    executions_.push_back(
        {std::string(message.federation), std::string(message.model), message.federates});
    return true;
  }
  const std::vector<FederationExecutionInformation> executions = std::exchange(executions_, {});
  basis_.callbacks.report_federation_executions(executions);
  return true;
}

bool HostQuestions::handle_federation_report(Reader& reader) {
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

bool HostQuestions::handle_federate_report(Reader& reader) {
  FederateReportMessage message;
  if (!exchange(reader, message) || reports_.empty()) return false;
  reports_.back().federates.push_back(
      {{message.federate}, std::string(message.name), std::string(message.type), message.counts});
  return true;
}

bool HostQuestions::handle_report_end() {
  const std::vector<FederationReport> reports = std::exchange(reports_, {});
  basis_.callbacks.report_management(reports);
  return true;
}

}  // namespace rink::rti
