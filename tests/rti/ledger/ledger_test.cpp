// The ledger of where bytes go: it names messages and fields as the page does, and counts every bit
// once, whatever comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "rti/ledger/conversation_fields.h"
#include "rti/ledger/message_fields.h"
#include "rti/wire/admission_messages.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/membership_messages.h"
#include "tests/places.h"
#include "tests/rti/rig.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

/// `text` without what stands in brackets of any kind, in which fields have no names of their own.
std::string outside_brackets(const std::string& text) {
  std::string outside;
  int depth = 0;
  for (const char each : text) {
    depth += each == '[' || each == '(' || each == '{' ? 1 : 0;
    if (depth == 0) outside += each;
    depth -= each == ']' || each == ')' || each == '}' ? 1 : 0;
  }
  return outside;
}

/// Each line of the page's tables of messages, with those that continue it: kind, name, fields.
std::vector<std::smatch> messages_of_page(const std::string& page) {
  static const std::regex message(R"((?:^|\n)(?:federate|RTI)? *(\d+) +([a-z_]{3,})( [^\n]*)?)"
                                  R"(((?:\n {30,}[^\n]*)*))");
  return {std::sregex_iterator(page.begin(), page.end(), message), std::sregex_iterator()};
}

TEST(MessageFields, HaveTheKindsAndNamesOfThePage) {
  const std::string page = rink::test::text_of(rink::test::source_folder() + "/docs/wire.md");
  std::set<MessageKind> found;
  for (const std::smatch& message : messages_of_page(page)) {
    const auto kind = static_cast<std::uint8_t>(std::stoi(message[1]));
    const MessageFields* fields = fields_of(kind);
    // Of the channel beside TCP the page counts kinds of its own.
    if (fields == nullptr || fields->form != message[2].str()) {
      EXPECT_LE(kind, 4) << message[0];
      continue;
    }
    found.insert(fields->kind);
    const std::string content = outside_brackets(std::regex_replace(
        message[3].str() + message[4].str(), std::regex("one:|varints:|_if_r|2·class\\+r:"), ""));
    static const std::regex name("([a-z_]+):[a-z]");
    for (std::sregex_iterator each(content.begin(), content.end(), name), end; each != end; ++each)
      // The other end of an interaction has a name in each direction.
      EXPECT_TRUE(std::ranges::find(fields->names, (*each)[1].str()) != fields->names.end() ||
                  (fields->kind == MessageKind::interaction && (*each)[1] == "sender"))
          << message[0] << ": " << (*each)[1];
  }
  EXPECT_EQ(found.size(), std::size(message_fields)) << "messages on the page";
}

struct Watched {
  const ResidualModel residuals{harbour()};
  ByteLedger ledger;
  ConversationFields fields(LedgerDirection direction) {
    return {{harbour(), residuals, ledger}, direction, nullptr};
  }
  std::int64_t bits_of(std::string_view form, std::string_view field) const {
    std::int64_t sum = 0;
    for (const LedgerRow& row : ledger.rows())
      if ((form.empty() || row.form == form) && (field.empty() || row.field == field))
        sum += row.amount.bits;
    return sum;
  }
};

template <class Message>
std::vector<std::byte> frame_of(Message message) {
  FrameWriter frame(frame_max_to_federate);
  write(frame.begin_message(measure(message)), message);
  frame.appended();
  return {frame.bytes().begin(), frame.bytes().end()};
}

TEST(Ledger, GivesEachFieldOfAMessageItsBits) {
  Watched watched;
  ConversationFields up = watched.fields(LedgerDirection::up);
  up.read(frame_of(DiscoverObjectMessage{.object = 300, .object_class = 1, .name = "Aurora"}));
  EXPECT_EQ(watched.bits_of("frame", "head"), 16);
  EXPECT_EQ(watched.bits_of("discover_object", "kind"), 8);
  EXPECT_EQ(watched.bits_of("discover_object", "object"), 16) << "a varint of two bytes";
  EXPECT_EQ(watched.bits_of("discover_object", "class"), 8);
  EXPECT_EQ(watched.bits_of("discover_object", "name"), 8 * (1 + 6)) << "with its length";
}

TEST(Ledger, KeepsTheFieldsOfSetsOfManyAttributesTogether) {
  Watched watched;
  ConversationFields up = watched.fields(LedgerDirection::up);
  SpareUpdateMessage message;
  message.object = 5, message.attributes = AttributeBits{1} << 70 | 1;
  const std::vector<std::byte> frame = frame_of(message);
  up.read(frame);
  EXPECT_EQ(watched.bits_of("spare_update", "attributes"),
            8 * static_cast<std::int64_t>(frame.size() - 2 - 1 - 1));
}

TEST(Ledger, CountsAFrameOnceItIsWhole) {
  Watched watched;
  ConversationFields down = watched.fields(LedgerDirection::down);
  const std::vector<std::byte> frame = frame_of(ExpelledMessage{"too fast"});
  for (std::size_t k = 0; k + 1 < frame.size(); ++k) {
    down.read(Bytes(frame).subspan(k, 1));
    EXPECT_EQ(watched.bits_of({}, {}), 0);
    EXPECT_EQ(down.waiting_bytes(), k + 1);
  }
  down.read(Bytes(frame).last(1));
  EXPECT_EQ(watched.bits_of({}, {}), 8 * static_cast<std::int64_t>(frame.size()));
  EXPECT_EQ(down.waiting_bytes(), 0u);
}

TEST(Ledger, CountsWhatIsSealedAsThatAndNoLongerReadsIt) {
  Watched watched;
  ConversationFields up = watched.fields(LedgerDirection::up);
  up.read(frame_of(ProofMessage{}));
  EXPECT_EQ(watched.bits_of("proof", "proof"), 8 * 32);
  std::vector<std::byte> sealed(2 + 1 + 20 + 16, std::byte{1});
  write_frame_head(sealed.data(), sealed.size() - 2);
  up.read(sealed);
  EXPECT_EQ(watched.bits_of("sealed", "content"), 8 * 20);
  EXPECT_EQ(watched.bits_of("sealed", "tag"), 8 * 16);
  EXPECT_EQ(watched.bits_of("unread", {}), 0);
}

/// Half of them begin as a message does.
TEST(Ledger, CountsEveryBitOnceOfBytesThatAreNoConversation) {
  std::mt19937 random(5);
  for (int session = 0; session < 2000; ++session) {
    Watched watched;
    ConversationFields fields =
        watched.fields(session % 2 == 0 ? LedgerDirection::down : LedgerDirection::up);
    std::int64_t given = 0;
    for (int part = 0; part < 8; ++part) {
      std::vector<std::byte> bytes(3 + random() % 60);
      for (std::byte& each : bytes) each = static_cast<std::byte>(random());
      if (random() % 8 != 0) write_frame_head(bytes.data(), bytes.size() - 2);
      bytes[2] = static_cast<std::byte>(message_fields[random() % std::size(message_fields)].kind);
      given += 8 * static_cast<std::int64_t>(bytes.size());
      if (random() % 4 == 0) fields.read_datagram(bytes);
      else fields.read(bytes);
    }
    fields.end();
    ASSERT_EQ(watched.bits_of({}, {}), given) << "session " << session;
  }
}

TEST(Ledger, TellsASpanByWhatCameBefore) {
  ByteLedger ledger;
  const LedgerField one{.form = "updates", .subject = "position", .field = "x"},
      other{.form = "updates", .subject = {}, .field = "handle"};
  ledger.add(one, 5), ledger.add(other, 8);
  const std::vector<LedgerRow> begin = ledger.rows();
  ledger.add(one, 6), ledger.add(one, 7);
  const std::vector<LedgerRow> span = ledger_between(begin, ledger.rows());
  ASSERT_EQ(span.size(), 1u);
  EXPECT_EQ(span[0].field, "position.x");
  EXPECT_EQ(span[0].amount.bits, 13);
  EXPECT_EQ(span[0].amount.times, 2);
}

}  // namespace
}  // namespace rink::rti::testing
