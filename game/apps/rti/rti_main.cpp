// rink rti: hosts the federations of any object model, or says what an object model's files mean.
#include <cstdio>
#include <exception>
#include <string>

#include "game/apps/command.h"
#include "game/apps/rti/rti_check.h"
#include "game/apps/rti/rti_host.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/server/serve_status.h"
#include "game/version/version.h"
#include "im/expression_fault.h"
#include "rti/fom/fom.h"

namespace rink::game {
namespace {

ExitStatus show_status(const RtiOptions& options) try {
  const auto [address, port] = address_and_port("--status", options.status);
  const auto error = print_status(
      {.address = address,
       .port = port,
       .transport = options.transport,
       .key_file = options.key_file,
       .federation = options.federations.empty() ? "rink" : options.federations.front()},
      options.every_s, now_s);
  if (error) {
    complain("--status: ", options.status, ": ", *error);
    return ExitStatus::no_server;
  }
  return ExitStatus::ok;
} catch (const rti::TransportError& error) {
  complain("--status: ", error.what());
  return ExitStatus::no_server;
}

ExitStatus host(const RtiOptions& options) {
  const rti::Fom fom = rti::Fom::load(options.fom);
  for (const std::string& warning : fom.warnings()) warn(warning);
  RtiHost rti(options, fom);
  const std::uint16_t port = rti.listen();
  std::printf("listening on %s:%u\n", address_and_port("--listen", options.listen, 0).first.c_str(),
              static_cast<unsigned>(port));
  std::fflush(stdout);
  while (!is_interrupted) rti.serve(0.1);
  rti.end();
  return ExitStatus::ok;
}

ExitStatus run(const RtiOptions& options) {
  if (!options.status.empty()) return show_status(options);
  if (!options.check.empty())
    return check_model(options.check) ? ExitStatus::ok : ExitStatus::bad_input;
  if (options.fom.empty())
    throw FlagError("--fom", "name the files of an object model, or --check or --status");
  return host(options);
}

void add_options(Flags& flags, RtiOptions& options) {
  flags.name("rink rti");
  flags.description(
      "Host the federations of an object model: federates create, join and leave them until this "
      "is interrupted; then each is sent the reason. Needs nothing of the game.");
  flags.footer(std::string("Example: rink rti --fom harbour.xml --federation harbour\n") +
               exit_status_help);
  const Flag fom = flags.option("--fom", options.fom,
                                "files of the object model: IEEE 1516.2-2010 modules in the order "
                                "of their dependence; the standard's own module may be among them");
  flags
      .option("--check", options.check,
              "say what each of these modules holds and what they are together, and end: status 2 "
              "if they are refused")
      .excludes(fom);
  flags
      .option("--listen", options.listen, "where federates reach it; port 0: any free one, printed")
      .value_name("HOST:PORT")
      .shows_default();
  flags
      .option("--federation", options.federations,
              "a federation execution that exists from the start; federates may create others; may "
              "be repeated")
      .check(not_empty())
      .repeats();
  flags
      .option("--transport", options.transport,
              "tcp; udp: best-effort attributes by UDP beside it; bundle: federates of a process "
              "share its sockets; shm: shared memory, by the port")
      .check(one_of({rti::socket_transport_names.begin(), rti::socket_transport_names.end()}))
      .shows_default();
  flags
      .option("--scheme", options.scheme,
              "interest management over the dimensions X and Y, where the model has them "
              "(docs/im.md)")
      .check({[](const std::string& text) {
                const auto fault = im::fault_in(text);
                return fault ? fault->what : std::string();
              },
              "SCHEME"})
      .shows_default();
  flags
      .option("--key-file", options.key_file,
              "admit only federates with the same file (docs/rti.md, Admission); without it: all")
      .check(existing_file());
  flags
      .option("--save", options.save,
              "the directory in which federations are saved and from which they are restored "
              "(docs/rti.md, Save and restore); without it they cannot be")
      .check(not_empty())
      .value_name("DIR");
  flags
      .option("--address-limit", options.address_limit,
              "connections that one address may have; 0: any; by default half of the files "
              "that this process may open, for addresses of other machines alone")
      .check(whole_number_from(0, 1'000'000));
  flags
      .option("--rate-limit", options.rate_limit_bytes_per_s,
              "bytes per second that a federate may send before it is dropped; 0: any")
      .check(number_from(0.0, 1e12))
      .shows_default();
  flags
      .option("--frame-limit", options.frame_limit_per_s,
              "frames per second that a federate may send before it is dropped; 0: any")
      .check(zero_or_number_from(1.0, 1e9))
      .shows_default();
  flags
      .option("--federates", options.federates_max, "federates of one federation execution at most")
      .check(whole_number_from(1, 16'000))
      .shows_default();
  flags.option("--executions", options.executions_max, "federation executions at most")
      .check(whole_number_from(1, 10'000))
      .shows_default();
  flags
      .option("--status", options.status,
              "ADDRESS:PORT of a running RTI: print the report of its federations and federates "
              "and end. --transport, --key-file and --federation as the RTI's")
      .check(not_empty())
      .excludes(fom);
  flags
      .option("--every", options.every_s,
              "seconds after which --status prints again, until interrupted; 0: once")
      .check(number_from(0.0, 3600.0))
      .needs(flags.find("--status"))
      .shows_default();
}

int status_of(const std::exception& error) {
  if (dynamic_cast<const rti::FileError*>(&error) != nullptr)
    return static_cast<int>(ExitStatus::bad_input);
  return static_cast<int>(exit_status(error, {.bad_address = ExitStatus::address_in_use,
                                              .too_many_files = ExitStatus::too_few_files,
                                              .otherwise = ExitStatus::failed}));
}

}  // namespace
}  // namespace rink::game

int main(int count, char** words) {
  using namespace rink::game;
  speak_as("rink-rti");
  Flags flags;
  flags.version(version_line("rink-rti"));
  RtiOptions options;
  add_options(flags, options);
  return run_command(
      flags, count, words,
      {.run = [&] { return static_cast<int>(run(options)); }, .status_of = status_of});
}
