// rink rti: what it says of object models, and how it hosts the federations of strangers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>

#include <chrono>
#include <fstream>
#include <string>

#include "game/process/process.h"
#include "rti/fom/fom.h"
#include "rti/transport/tcp_federate.h"
#include "rti/wire/data_elements.h"
#include "tests/command.h"
#include "tests/net/guest.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

class RtiCommand : public test::CommandTest {
 protected:
  RtiCommand() : CommandTest("rti-command") {}
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(file(name)) << text;
    return file(name);
  }
  const std::string harbour_ = test::source_folder() + "/tests/house/harbour/harbour.xml";
};

TEST_F(RtiCommand, SaysWhatEachModuleHoldsAndWhatAllAreTogether) {
  const std::string lights =
      write("lights.xml",
            "<objectModel><interactions><interactionClass><name>HLAinteractionRoot</name>"
            "<interactionClass><name>Blink</name><parameter><name>colour</name></parameter>"
            "</interactionClass></interactionClass></interactions><switches>"
            "<serviceReporting isEnabled=\"true\"/></switches></objectModel>\n");
  EXPECT_EQ(run("rti --check " + harbour_ + " " + lights), 0) << said_;
  EXPECT_THAT(printed_,
              AllOf(HasSubstr(harbour_ + ": 2 object classes with 2 attributes, 1 data type\n"),
                    HasSubstr(lights + ": 2 interaction classes with 1 parameter, 1 switch\n"),
                    HasSubstr("together: 2 object classes, 2 interaction classes, 0 dimensions"),
                    HasSubstr("the widest class, HLAobjectRoot.Ship, has 2 attributes\n")));
  EXPECT_THAT(said_, HasSubstr("lights.xml:1: <serviceReporting> stays off"));
}

TEST_F(RtiCommand, RefusesAModelByFileLineElementAndClauseAndBadFlags) {
  const std::string bad =
      write("bad.xml",
            "<objectModel><objects><objectClass><name>HLAobjectRoot</name>\n<objectClass><name>Ship"
            "</name><attribute><name>a</name><dataType>Nothing</dataType></attribute>"
            "</objectClass></objectClass></objects></objectModel>\n");
  for (const std::string& words : {"--check " + bad, "--fom " + bad + " --listen 127.0.0.1:0"}) {
    EXPECT_EQ(run("rti " + words), 2) << words;
    EXPECT_THAT(said_, AllOf(HasSubstr("bad.xml:2: <attribute> 'a' has the unknown data type"),
                             HasSubstr("(IEEE 1516.2-2010, 4.4)")));
  }
  EXPECT_EQ(run("rti --check /nowhere.xml"), 2);
  EXPECT_THAT(said_, HasSubstr("/nowhere.xml: can't be read"));
  EXPECT_EQ(run("rti"), 2);
  EXPECT_THAT(said_, HasSubstr("--fom"));
  EXPECT_EQ(run("rti --fom " + harbour_ + " --check " + harbour_), 2);
  EXPECT_EQ(run("rti --fom " + harbour_ + " --listen nowhere"), 2) << said_;
  EXPECT_THAT(said_, HasSubstr("--listen: 'nowhere' is not ADDRESS:PORT"));
  EXPECT_EQ(run("rti --fom " + harbour_ + " --listen 127.0.0.1:0 --key-file " + harbour_), 2);
  EXPECT_THAT(said_, HasSubstr("--key-file: proofs name one federation"));
}

struct Sailor : rti::FederateAmbassador {
  std::string discovered, lost, created;
  std::vector<std::byte> values;
  void federation_execution_created(std::string_view federation, rti::HlaError error) override {
    created = std::string(federation) + to_string(error);
  }
  void discover_object_instance(rti::ObjectHandle, rti::ObjectClassHandle,
                                std::string_view name) override {
    discovered = name;
  }
  void reflect_attribute_values(rti::ObjectHandle, rti::AttributeSet, rti::Bytes bytes,
                                const rti::Stamp&) override {
    values.assign(bytes.begin(), bytes.end());
  }
  void connection_lost(std::string_view why) override { lost = why; }
};

/// The port of "listening on 127.0.0.1:PORT".
std::uint16_t port_of(Process& server) {
  const std::optional<std::string> place = place_of(server);
  EXPECT_TRUE(place) << server.stderr_tail();
  return place ? static_cast<std::uint16_t>(std::stoul(place->substr(place->rfind(':') + 1))) : 0;
}

TEST_F(RtiCommand, HostsFederationsOfStrangersAndEndsInGoodOrder) {
  const rti::Fom fom = rti::Fom::load(harbour_);
  const rti::ObjectClassHandle ship = *fom.object_class("Ship");
  Process server(test::binary_folder() + "/bin/rink-rti",
                 {"--fom", harbour_, "--listen", "127.0.0.1:0", "--federation", "harbour"}, {});
  const std::uint16_t port = port_of(server);
  Sailor captain, watch, founder;
  rti::TcpFederate first(fom, captain, {.port = port}), second(fom, watch, {.port = port}),
      third(fom, founder, {.port = port});
  first.ambassador().join("harbour", "captain", "ship");
  ASSERT_TRUE(first.run([&] { return first.ambassador().is_joined(); })) << captain.lost;
  second.ambassador().join("harbour", "watch", "tower");
  ASSERT_TRUE(second.run([&] { return second.ambassador().is_joined(); })) << watch.lost;
  third.ambassador().create_federation_execution("lake");
  ASSERT_TRUE(third.run([&] { return !founder.created.empty(); })) << founder.lost;
  EXPECT_EQ(founder.created, "lake");

  first.ambassador().publish_object_class_attributes(ship, fom.attributes(ship));
  second.ambassador().subscribe_object_class_attributes(ship, fom.attributes(ship));
  const rti::ObjectHandle object = first.ambassador().register_object_instance(ship, "Pequod");
  const std::vector<std::byte> cargo = rti::data::encode<rti::data::AsciiString>("oil");
  ASSERT_TRUE(first.run_for(0.1));
  ASSERT_TRUE(second.run([&] { return !watch.discovered.empty(); }));
  EXPECT_EQ(watch.discovered, "Pequod");
  std::vector<std::byte> sized = rti::data::encode<rti::data::Integer32LE>(
      static_cast<std::int32_t>(cargo.size()));  // a value of varying size follows its length
  sized.insert(sized.end(), cargo.begin(), cargo.end());
  first.ambassador().update_attribute_values(
      object, rti::AttributeSet{*fom.attribute(ship, "cargo")}, sized, {});
  ASSERT_TRUE(first.run_for(0.05));
  ASSERT_TRUE(second.run([&] { return !watch.values.empty(); }));
  EXPECT_EQ(watch.values, sized);

  Process status(test::binary_folder() + "/bin/rink-rti",
                 {"--status", "127.0.0.1:" + std::to_string(port)}, {});
  for (int i = 0; i < 500 && !status.ending(); ++i)
    status.attend(10ms), first.run_for(0.001), second.run_for(0.001);
  ASSERT_TRUE(status.ending());
  EXPECT_THAT(status.line_after("federation harbour: ").value_or(""),
              AllOf(HasSubstr("object model Harbour"), HasSubstr("2 federates, 1 objects")));
  EXPECT_TRUE(status.line_after("federation lake: "));
  for (int i = 0; i < 200 && !server.line_after("federate watch "); ++i)
    server.attend(10ms), first.run_for(0.001), second.run_for(0.001);
  EXPECT_EQ(server.line_after("federate captain ").value_or(""),
            "(ship) has joined federation harbour");

  server.stop(5s);
  EXPECT_EQ(server.ending()->exit_status, 0) << server.stderr_tail();
  EXPECT_FALSE(first.run([&] { return false; }));
  EXPECT_EQ(captain.lost, "the RTI closed the connection: the RTI has ended");
}

/// Saves and restores itself at once, for it has nothing but what the RTI keeps.
struct Diver : Sailor {
  rti::Ambassador* ambassador = nullptr;
  bool is_saved = false, is_restored = false;
  std::string refused;
  void initiate_federate_save(std::string_view) override {
    ambassador->federate_save_begun();
    ambassador->federate_save_complete();
  }
  void federation_saved() override { is_saved = true; }
  void initiate_federate_restore(std::string_view, std::string_view, rti::FederateHandle) override {
    ambassador->federate_restore_complete();
  }
  void federation_restored() override { is_restored = true; }
  void request_federation_restore_failed(std::string_view label, std::string_view why) override {
    refused = std::string(label) + ": " + std::string(why);
  }
};

TEST_F(RtiCommand, BringsAFederationBackAfterItWasKilled) {
  const rti::Fom fom = rti::Fom::load(harbour_);
  const rti::ObjectClassHandle ship = *fom.object_class("Ship");
  rti::ObjectHandle pequod;
  for (const bool is_second : {false, true}) {
    Process server(test::binary_folder() + "/bin/rink-rti",
                   {"--fom", harbour_, "--listen", "127.0.0.1:0", "--federation", "harbour",
                    "--save", file("saves")},
                   {});
    Diver diver;
    rti::TcpFederate federate(fom, diver, {.port = port_of(server)});
    rti::Ambassador& ambassador = federate.ambassador();
    diver.ambassador = &ambassador;
    ambassador.join("harbour", "diver", "ship");
    ASSERT_TRUE(federate.run([&] { return ambassador.is_joined(); })) << diver.lost;
    if (!is_second) {
      ambassador.publish_object_class_attributes(ship, fom.attributes(ship));
      pequod = ambassador.register_object_instance(ship, "Pequod");
      ambassador.request_federation_save("noon");
      ASSERT_TRUE(federate.run([&] { return diver.is_saved; })) << diver.lost;
      ::kill(server.id(), SIGKILL);
      while (!server.ending()) server.attend(10ms);
      continue;
    }
    ambassador.request_federation_restore("midnight");
    ASSERT_TRUE(federate.run([&] { return !diver.refused.empty(); })) << diver.lost;
    EXPECT_EQ(diver.refused, "midnight: there is none");
    ambassador.request_federation_restore("noon");
    ASSERT_TRUE(federate.run([&] { return diver.is_restored; })) << diver.lost;
    EXPECT_EQ(ambassador.get_object_instance_handle("Pequod"), pequod);
    ambassador.delete_object_instance(pequod);
    ASSERT_TRUE(federate.run_for(0.05)) << diver.lost;
    server.stop(5s);
  }
}

TEST_F(RtiCommand, RefusesAPlaceForSavesThatIsNoDirectory) {
  EXPECT_EQ(run("rti --fom " + harbour_ + " --listen 127.0.0.1:0 --save " + harbour_), 2);
  EXPECT_THAT(said_, HasSubstr("'" + harbour_ + "' is no directory in which saves can be written"));
}

TEST_F(RtiCommand, AdmitsOnlyThoseWithItsKey) {
  const rti::Fom fom = rti::Fom::load(harbour_);
  const std::string key = write("key", std::string(40, 'k')),
                    other = write("other", std::string(40, 'o'));
  using std::filesystem::perms;
  for (const std::string& file : {key, other})
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  Process server(
      test::binary_folder() + "/bin/rink-rti",
      {"--fom", harbour_, "--listen", "127.0.0.1:0", "--federation", "harbour", "--key-file", key},
      {});
  const std::uint16_t port = port_of(server);
  for (const std::string& file : {key, other}) {
    Sailor sailor;
    rti::TcpFederate federate(fom, sailor,
                              {.port = port, .key_file = file, .federation = "harbour"});
    federate.ambassador().join("harbour", "captain", "ship");
    EXPECT_EQ(federate.run([&] { return federate.ambassador().is_joined(); }), file == key);
  }
  server.stop(5s);
}

}  // namespace
}  // namespace rink::game
