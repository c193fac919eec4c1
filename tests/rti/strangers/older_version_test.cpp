// A federate and an RTI of which one is of version 11 or 12, whose bytes were recorded: either
// refuses the other in words that it reads.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/rti/bare.h"

namespace rink::rti::testing {
namespace {

std::vector<std::byte> recorded(std::initializer_list<unsigned> head, std::string_view text) {
  std::vector<std::byte> bytes;
  for (const unsigned each : head) bytes.push_back(static_cast<std::byte>(each));
  const std::vector<std::byte> rest = bytes_of(text);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}
constexpr std::string_view versions =
    "the two ends speak different versions of the protocol: build both from one version of Rink; "
    "the federate speaks version ";

class OlderVersion : public ::testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(OfElevenAndTwelve, OlderVersion, ::testing::Values(11u, 12u));

TEST_P(OlderVersion, AFederateIsRefusedInTheFormThatItReads) {
  // What a bot of that version sends first: it says how long the frame is in four bytes.
  const std::vector<std::byte> join =
      recorded({0x21, 0, 0, 0, 1, 0x52, 0x49, 0x4e, 0x4b, GetParam(), 0, 0x18, 0x85, 0xe9, 0xb8,
                0xb7, 0x26, 0x59, 0x7e},
               "\x04rink\x05"
               "bat-0\x06player");
  const std::string why =
      std::string(versions) + std::to_string(GetParam()) + ", the RTI version 13";
  const std::vector<std::byte> refused = recorded(
      {static_cast<unsigned>(why.size()) + 3, 0, 0, 0, 65, 1, static_cast<unsigned>(why.size())},
      why);
  for (const std::size_t cut : {1u, 2u, 3u, 4u, 5u, 37u}) {
    Bare bare;
    bare.execution.connect(1);
    bare.execution.receive(1, Bytes(join).first(cut));
    bare.execution.receive(1, Bytes(join).subspan(cut));
    bare.tick();
    EXPECT_EQ(bare.sent[1], refused) << "cut after " << cut;
    EXPECT_EQ(bare.drops(Violation::refused), 1u);
  }
}

TEST_P(OlderVersion, AnRtiReadsTheJoinAndIsUnderstoodWhenItRefuses) {
  Recorder heard;
  Ambassador federate(harbour(), heard);
  federate.join("rink", "new", "tester");
  const Bytes join = federate.outgoing();
  ASSERT_GT(join.size(), 11u);
  const std::vector<std::byte> head = recorded(
      {static_cast<unsigned>(join.size()) - 4, 0, 0, 0, 1, 0x52, 0x49, 0x4e, 0x4b, 13, 0}, "");
  EXPECT_TRUE(std::ranges::equal(join.first(head.size()), head));
  EXPECT_TRUE(federate.receive(
      recorded({0x91, 0, 0, 0, 65, 1, 0x8e},
               std::string(versions) + "13, the RTI version " + std::to_string(GetParam()))));
  EXPECT_EQ(heard.refusal, Refusal::wrong_version);
  EXPECT_NE(heard.log.back().find("version 13, the RTI version " + std::to_string(GetParam())),
            std::string::npos);
}

}  // namespace
}  // namespace rink::rti::testing
