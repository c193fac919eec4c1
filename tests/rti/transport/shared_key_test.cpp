// A shared key: the file that holds it, and what is made of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "rti/admission/shared_key.h"
#include "tests/rti/seeded.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

SharedKey shared_key_of(std::string_view secret) {
  return SharedKey(std::as_bytes(std::span(secret)));
}
const SharedKey& harbours_key() {
  static const SharedKey key = shared_key_of("the harbour's own secret");
  return key;
}
const SharedKey& other_key() {
  static const SharedKey key = shared_key_of("a secret of somebody else");
  return key;
}

std::string fault_of_loading(const std::filesystem::path& file) {
  try {
    SharedKey::load(file);
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "";
}

TEST(SharedKeys, AreReadWithoutTheirLastLineEndAndRefusedIfShortOrOpenToOthers) {
  const test::TemporaryFolder folder("key");
  const std::filesystem::path file = folder / "harbour.key";
  std::ofstream(file) << "the harbour's own secret\n";
  using std::filesystem::perms;
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  const ProofBasis basis{nonce_of(1), nonce_of(2), "rink"};
  EXPECT_EQ(SharedKey::load(file).prove(Role::rti, basis), harbours_key().prove(Role::rti, basis));
  for (const perms others :
       {perms::group_read, perms::group_write, perms::others_read, perms::others_write}) {
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write | others);
    EXPECT_EQ(fault_of_loading(file),
              file.string() + ": others may read or write this key; chmod 600 " + file.string());
  }
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  std::ofstream(file) << "short\n";
  EXPECT_THROW(SharedKey::load(file), std::runtime_error);
  std::filesystem::remove(file);
  EXPECT_THROW(SharedKey::load(file), std::runtime_error);
}

TEST(SharedKeys, GiveEachDirectionOfEachConversationAKeyOfItsOwn) {
  const ProofBasis basis{nonce_of(1), nonce_of(2), "rink"};
  const SessionKey up = harbours_key().session_key(Role::federate, basis),
                   down = harbours_key().session_key(Role::rti, basis);
  EXPECT_NE(up, down);
  EXPECT_NE(up, harbours_key().session_key(Role::federate, {nonce_of(3), nonce_of(2), "rink"}));
  EXPECT_NE(up, harbours_key().session_key(Role::federate, {nonce_of(1), nonce_of(3), "rink"}));
  EXPECT_NE(up, other_key().session_key(Role::federate, basis));
  EXPECT_NE(up, harbours_key().prove(Role::federate, basis)) << "which anybody may hear";
}

}  // namespace
}  // namespace rink::rti::testing
