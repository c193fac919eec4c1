// What a host is asked about its federation executions, and what it reports of them (IEEE
// 1516.1-2010, 4.5 to 4.8).
#pragma once

#include <string_view>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// Asked before the join; `query_management` after it too, of one's own execution.
class HostQuestions {
 public:
  explicit HostQuestions(const AmbassadorBasis& basis) : basis_(basis) {}

  /// These throw FederateAlreadyExecutionMember.
  void create_federation_execution(std::string_view federation, const Fom& model);
  void destroy_federation_execution(std::string_view federation);
  void list_federation_executions();
  void query_management();
  /// Whether there is a host that may answer, and may be lost.
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
  std::vector<FederationExecutionInformation> executions_;  ///< of the list that is being told
  std::vector<FederationReport> reports_;                   ///< of those that are being told
  bool has_asked_ = false;
};

}  // namespace rink::rti
