// What commands end with when a transport failed.
#include "game/net/exit_status.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "rti/transport/transport.h"

namespace rink::game {
namespace {

TEST(ExitStatus, TellsApartWhatATransportFailedOf) {
  const TransportStatuses statuses{.bad_address = ExitStatus::address_in_use,
                                   .too_many_files = ExitStatus::too_few_files,
                                   .otherwise = ExitStatus::no_server};
  using Kind = rti::TransportError::Kind;
  const auto status = [&](Kind kind) {
    return exit_status(rti::TransportError(kind, "127.0.0.1:1"), statuses);
  };
  for (const Kind kind : {Kind::in_use, Kind::no_such_address, Kind::no_permission})
    EXPECT_EQ(status(kind), ExitStatus::address_in_use);
  EXPECT_EQ(status(Kind::too_many_files), ExitStatus::too_few_files);
  EXPECT_EQ(status(Kind::failed), ExitStatus::no_server);
  EXPECT_EQ(exit_status(std::runtime_error("--report"), statuses), ExitStatus::bad_input);
}

}  // namespace
}  // namespace rink::game
