// Declaration management (clause 5).
#pragma once

#include "rti/standard/services/save_services.h"

namespace rink::standard {

class DeclarationServices : public SaveServices {
 public:
  void publishObjectClassAttributes(rti1516e::ObjectClassHandle theClass,
                                    rti1516e::AttributeHandleSet const& attributeList) override;
  void unpublishObjectClass(rti1516e::ObjectClassHandle theClass) override;
  void unpublishObjectClassAttributes(rti1516e::ObjectClassHandle theClass,
                                      rti1516e::AttributeHandleSet const& attributeList) override;
  void publishInteractionClass(rti1516e::InteractionClassHandle theInteraction) override;
  void unpublishInteractionClass(rti1516e::InteractionClassHandle theInteraction) override;
  void subscribeObjectClassAttributes(rti1516e::ObjectClassHandle theClass,
                                      rti1516e::AttributeHandleSet const& attributeList,
                                      bool active,
                                      std::wstring const& updateRateDesignator) override;
  void unsubscribeObjectClass(rti1516e::ObjectClassHandle theClass) override;
  void unsubscribeObjectClassAttributes(rti1516e::ObjectClassHandle theClass,
                                        rti1516e::AttributeHandleSet const& attributeList) override;
  void subscribeInteractionClass(rti1516e::InteractionClassHandle theClass, bool active) override;
  void unsubscribeInteractionClass(rti1516e::InteractionClassHandle theClass) override;
};

}  // namespace rink::standard
