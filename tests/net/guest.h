// Commands run from their arguments to their last words, and a client of this process at the server
// that one of them is.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "game/net/address.h"
#include "game/net/client/client.h"
#include "game/net/fom_file.h"
#include "game/process/process.h"
#include "game/replication/trajectory_codec.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/places.h"

namespace rink::game {

/// How a command ended and what it said.
struct Ended {
  int status = -1;
  std::string words;
};

inline Ended run(const std::string& command, const std::vector<std::string>& arguments) {
  Process process(test::binary_folder() + "/bin/" + command, arguments, {});
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!process.ending() && std::chrono::steady_clock::now() < limit)
    process.attend(std::chrono::milliseconds(20));
  if (!process.ending()) return {};
  return {process.ending()->exit_status, process.stderr_tail()};
}

inline Ended serve(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--port", "0"});
  return run("rink-serve", arguments);
}

/// Where the server listens, once it says so.
inline std::optional<std::string> place_of(Process& server) {
  std::optional<std::string> place;
  for (int i = 0; i < 500 && !place; ++i)
    server.attend(std::chrono::milliseconds(10)), place = server.line_after("listening on ");
  return place;
}

/// A client of this process at a server of its own.
struct Guest {
  Guest(const std::string& place, const ClientSettings& settings)
      : client(fom, model, settings), link(client.ambassador(), tcp, connect(place)) {
    links.add(link);
  }
  rti::ConnectionId connect(const std::string& place) {
    const auto [address, port] = address_and_port("--connect", place);
    return tcp.connect(address, port);
  }
  void flush() { link.flush(now_s()); }
  void exchange() {
    flush();
    tcp.poll(std::chrono::milliseconds(1), links);
  }
  void leave() {
    if (client.ambassador().is_joined()) client.ambassador().resign();
    flush();
    link.close();
  }
  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  const rti::Fom fom = load_rink_fom(fom_file());
  const ObjectModel model{fom};
  Client client;
  rti::TcpTransport tcp;
  rti::FederateLink link;
  rti::FederateLinks links;
};

}  // namespace rink::game
