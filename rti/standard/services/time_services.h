// Time management (clause 8).
#pragma once

#include "rti/standard/services/ownership_services.h"

namespace rink::standard {

class TimeServices : public OwnershipServices {
 public:
  void enableTimeRegulation(rti1516e::LogicalTimeInterval const& theLookahead) override;
  void disableTimeRegulation() override;
  void enableTimeConstrained() override;
  void disableTimeConstrained() override;
  void timeAdvanceRequest(rti1516e::LogicalTime const& theTime) override;
  void timeAdvanceRequestAvailable(rti1516e::LogicalTime const& theTime) override;
  void nextMessageRequest(rti1516e::LogicalTime const& theTime) override;
  void nextMessageRequestAvailable(rti1516e::LogicalTime const& theTime) override;
  void flushQueueRequest(rti1516e::LogicalTime const& theTime) override;
  void enableAsynchronousDelivery() override;
  void disableAsynchronousDelivery() override;
  bool queryGALT(rti1516e::LogicalTime& theTime) override;
  void queryLogicalTime(rti1516e::LogicalTime& theTime) override;
  bool queryLITS(rti1516e::LogicalTime& theTime) override;
  void modifyLookahead(rti1516e::LogicalTimeInterval const& theLookahead) override;
  void queryLookahead(rti1516e::LogicalTimeInterval& interval) override;
  void retract(rti1516e::MessageRetractionHandle theHandle) override;
  void changeAttributeOrderType(rti1516e::ObjectInstanceHandle theObject,
                                rti1516e::AttributeHandleSet const& theAttributes,
                                rti1516e::OrderType theType) override;
  void changeInteractionOrderType(rti1516e::InteractionClassHandle theClass,
                                  rti1516e::OrderType theType) override;
};

}  // namespace rink::standard
