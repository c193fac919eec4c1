// Questions to a host about its federation executions, and its reports (IEEE 1516.1-2010, 4.5 to
// 4.8).
#pragma once

#include <string_view>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/management/federation_report.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// Questions come before the join; `query_management` may follow it too, about the own execution.
class HostQuestions {
 public:
  explicit HostQuestions(const AmbassadorBasis& basis) : basis_(basis) {}

  /// These throw FederateAlreadyExecutionMember.
  void create_federation_execution(std::string_view federation, const Fom& model);
  void destroy_federation_execution(std::string_view federation);
  void list_federation_executions();
  void query_management();
  /// Only once joined.
  void notify_host();
  /// True once a question was sent: a host may answer, and may be lost.
  bool has_asked() const { return has_asked_; }

  bool handle_created(Reader& reader);
  bool handle_destroyed(Reader& reader);
  bool handle_execution(Reader& reader);
  bool handle_federation_report(Reader& reader);
  bool handle_federate_report(Reader& reader);
  bool handle_report_end();

 private:
  template <class Message>
  void ask(Message message);

  AmbassadorBasis basis_;
  std::vector<FederationExecutionInformation> executions_;  ///< of the list that is being received
  std::vector<FederationReport> reports_;                   ///< of the reports that are being
                                                            ///< received
  bool has_asked_ = false;
};

}  // namespace rink::rti
