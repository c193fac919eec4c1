// Federates of the standard's API whose services are called by many threads.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

constexpr int thread_count = 4;

template <class Act>
void in_threads(const Act& act) {
  std::vector<std::thread> threads;
  threads.reserve(thread_count);
  for (int k = 0; k < thread_count; ++k) threads.emplace_back([&act, k] { act(k); });
  for (std::thread& each : threads) each.join();
}

/// The RTI sleeps, so that the question is never answered.
TEST(StandardThreaded, ResigningEndsWhatAnotherThreadWaitsFor) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    Harbour harbour;
    Sailor sailor(harbour, L"sailor", model);
    harbour.sleep(true);
    std::atomic<int> ended = 0;
    std::vector<std::thread> waiting;
    for (int k = 0; k < 2; ++k)
      waiting.emplace_back([&] {
        HLAfloat64Time bound;
        EXPECT_THROW(sailor->queryGALT(bound), FederateNotExecutionMember);
        ++ended;
      });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(ended, 0);
    sailor->resignFederationExecution(NO_ACTION);
    for (std::thread& each : waiting) each.join();
    harbour.sleep(false);
    sailor->disconnect();
  }
}

TEST(StandardThreaded, OneOfManyThreadsConnectsAndJoinsAndTheOthersAreRefused) {
  const Harbour harbour;
  Log log;
  const std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  for (int voyage = 0; voyage < 5; ++voyage) {
    std::atomic<int> connected = 0, joined = 0, destroyed = 0, left = 0;
    in_threads([&](int) {
      try {
        rti->connect(log, voyage % 2 == 0 ? HLA_EVOKED : HLA_IMMEDIATE, harbour.address());
        ++connected;
      } catch (const AlreadyConnected&) {
      }
    });
    EXPECT_EQ(connected, 1);
    in_threads([&](int k) {
      const std::wstring own = L"port " + std::to_wstring(k);
      rti->createFederationExecution(own, to_wide(model_file()));
      rti->listFederationExecutions();
      EXPECT_THROW(rti->joinFederationExecution(L"sailor", L"nowhere"),
                   FederationExecutionDoesNotExist);
      rti->destroyFederationExecution(own);
      ++destroyed;
    });
    EXPECT_EQ(destroyed, thread_count);
    rti->createFederationExecution(L"port", to_wide(model_file()));
    in_threads([&](int) {
      try {
        rti->joinFederationExecution(L"sailor", L"port");
        ++joined;
      } catch (const FederateAlreadyExecutionMember&) {
      }
    });
    EXPECT_EQ(joined, 1);
    in_threads([&](int) {
      try {
        rti->resignFederationExecution(NO_ACTION);
        ++left;
      } catch (const FederateNotExecutionMember&) {
      }
    });
    EXPECT_EQ(left, 1);
    rti->destroyFederationExecution(L"port");
    in_threads([&](int) { rti->disconnect(); });
  }
}

/// Who calls while another thread resigns and joins is a member or is told that it is none.
TEST(StandardThreaded, ServicesGoOnWhileAnotherThreadResignsAndJoins) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    const Harbour harbour;
    Sailor pilot(harbour, L"pilot", model), coast(harbour, L"coast", model);
    coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
    std::atomic<bool> is_over = false;
    std::atomic<int> served = 0;
    std::thread joining([&] {
      for (int voyage = 0; voyage < 20; ++voyage) {
        pilot->resignFederationExecution(DELETE_OBJECTS);
        pilot->joinFederationExecution(L"pilot", L"sailor", L"port");
        const int before = served;
        while (served < before + 10) std::this_thread::yield();
      }
      is_over = true;
    });
    in_threads([&](int) {
      while (!is_over) {
        try {
          const ObjectClassHandle of_ship = pilot->getObjectClassHandle(L"Vessel.Ship");
          const AttributeHandle x = pilot->getAttributeHandle(of_ship, L"x");
          pilot->publishObjectClassAttributes(of_ship, {x});
          const ObjectInstanceHandle ship = pilot->registerObjectInstance(of_ship);
          pilot->updateAttributeValues(ship, {{x, data_of("12345678")}}, {});
          HLAfloat64Time galt;
          pilot->queryGALT(galt);
          pilot->deleteObjectInstance(ship, {});
          ++served;
        } catch (const FederateNotExecutionMember&) {
        } catch (const ObjectClassNotPublished&) {
        } catch (const ObjectInstanceNotKnown&) {
        } catch (const AttributeNotOwned&) {
        } catch (const RTIinternalError&) {
          // No handles yet.
        }
        coast->evokeMultipleCallbacks(0.0, 0.0);
      }
    });
    joining.join();
    EXPECT_TRUE(coast.log.has("removed"));
  }
}

TEST(StandardThreaded, EachThreadIsToldWhatItDivestedItself) {
  const Harbour harbour;
  Sailor pilot(harbour, L"pilot", HLA_IMMEDIATE), coast(harbour, L"coast", HLA_IMMEDIATE);
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  coast->publishObjectClassAttributes(coast.ship(), coast.both());
  pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
  std::vector<ObjectInstanceHandle> ships;
  for (int k = 0; k < thread_count; ++k)
    ships.push_back(pilot->registerObjectInstance(pilot.ship()));
  ASSERT_TRUE(coast.hears("in scope 2", thread_count));
  const auto wanted = [&](int k) { return k % 2 == 0 ? pilot.x() : pilot.flag(); };
  for (int k = 0; k < thread_count; ++k)
    coast->attributeOwnershipAcquisition(ships[static_cast<std::size_t>(k)], {wanted(k)}, {});
  ASSERT_TRUE(pilot.hears("asked to release 1 tag ", thread_count));
  in_threads([&](int k) {
    AttributeHandleSet divested;
    pilot->attributeOwnershipDivestitureIfWanted(ships[static_cast<std::size_t>(k)], pilot.both(),
                                                 divested);
    EXPECT_EQ(divested, AttributeHandleSet{wanted(k)});
  });
}

/// Threads that wait, and one that connects again, when the RTI ends.
TEST(StandardThreaded, AllThreadsAreToldThatTheRtiHasEnded) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    Harbour harbour;
    Sailor sailor(harbour, L"sailor", model);
    std::atomic<int> asked = 0;
    std::thread closing([&] {
      while (asked < 100) std::this_thread::yield();
      harbour.close();
    });
    in_threads([&](int) {
      HLAfloat64Time bound;
      try {
        while (true) {
          sailor->queryLITS(bound);
          ++asked;
        }
      } catch (const NotConnected&) {
      }
    });
    closing.join();
    const Harbour other;
    sailor->connect(sailor.log, model, other.address());
    sailor->createFederationExecution(L"port", to_wide(model_file()));
  }
}

}  // namespace
}  // namespace rink::standard::testing
