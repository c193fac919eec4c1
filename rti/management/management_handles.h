// The classes of the management object model in one federation object model.
#pragma once

#include <string>

#include "rti/fom/fom.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// The handles are empty where a module of the standard's gives the model management classes of its
/// own: then the RTI registers no objects.
struct ManagementHandles {
  ObjectClassHandle federation, federate;
  InteractionClassHandle set_timing, set_switches, request_publications, request_subscriptions,
      request_points;
  InteractionClassHandle report_object_publication, report_object_subscription,
      report_interaction_publication, report_interaction_subscription, report_points;

  explicit ManagementHandles(const Fom& fom) {
    const auto object = [&fom](const char* name) {
      std::string whole = "HLAobjectRoot.HLAmanager.";
      whole += name;
      return own(fom, fom.object_class(whole));
    };
    const auto interaction = [&fom](const char* name) {
      std::string whole = "HLAinteractionRoot.HLAmanager.";
      whole += name;
      return own(fom, fom.interaction_class(whole));
    };
    federation = object("HLAfederation");
    federate = object("HLAfederate");
    set_timing = interaction("HLAfederate.HLAadjust.HLAsetTiming");
    set_switches = interaction("HLAfederation.HLAadjust.HLAsetSwitches");
    request_publications = interaction("HLAfederate.HLArequest.HLArequestPublications");
    request_subscriptions = interaction("HLAfederate.HLArequest.HLArequestSubscriptions");
    request_points = interaction("HLAfederation.HLArequest.HLArequestSynchronizationPoints");
    report_object_publication =
        interaction("HLAfederate.HLAreport.HLAreportObjectClassPublication");
    report_object_subscription =
        interaction("HLAfederate.HLAreport.HLAreportObjectClassSubscription");
    report_interaction_publication =
        interaction("HLAfederate.HLAreport.HLAreportInteractionPublication");
    report_interaction_subscription =
        interaction("HLAfederate.HLAreport.HLAreportInteractionSubscription");
    report_points = interaction("HLAfederation.HLAreport.HLAreportSynchronizationPoints");
  }

 private:
  template <class Handle>
  static Handle own(const Fom& fom, std::optional<Handle> found) {
    return found && fom.is_management(*found) ? *found : Handle{};
  }
};

/// The value of HLARTIversion.
inline std::string rti_version() {
  return "Rink, protocol version " + std::to_string(protocol_version);
}

}  // namespace rink::rti
