// The kits: in-process, TCP, UDP, shared memory, the virtual network, and the sample of
// docs/transports.md.
#include "tests/rti/transport/transport_kits.h"

#include <chrono>
#include <optional>

#include "rti/transport/bundle.h"
#include "rti/transport/in_process.h"
#include "rti/transport/modelled/virtual_network.h"
#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/staged/rate_limiter.h"
#include "rti/transport/staged/stagger.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/transport/udp/udp.h"
#include "tests/rti/transport/sample_transport.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

/// Endpoints of one process that find each other by name, and never wait.
template <class Network, class Endpoint>
class LocalKit : public TransportKit {
 public:
  Transport& server() override { return *server_; }
  Transport& client() override { return client_; }
  ConnectionId connect() override { return client_.connect("here"); }
  ConnectionId connect_to_nobody() override { return client_.connect("nowhere"); }
  void restart_server() override {
    server_.reset();
    server_.emplace(network_);
    server_->listen("here");
  }

 protected:
  template <class Argument>
  explicit LocalKit(Argument&& argument) : network_(argument) {
    can_wait = false;
    connections = 5000;
    LocalKit::restart_server();
  }
  Network network_;

 private:
  Endpoint client_{network_};
  std::optional<Endpoint> server_;
};

class InProcessKit final : public LocalKit<InProcessNetwork, InProcessEndpoint> {
 public:
  InProcessKit() : LocalKit(std::size_t{1} << 20) {}
};

struct Delay {
  ConstantDelay model{1000};
};
/// The delay is a base, for it must be there before the network and after it.
class VirtualKit final : private Delay, public LocalKit<VirtualNetwork, VirtualEndpoint> {
 public:
  VirtualKit() : LocalKit(model) {}
  void pass_time() override {
    network_.advance_to(network_.next_arrival_ns().value_or(network_.now_ns() + 1000));
  }
  bool limit_queue(std::size_t) override {
    return false;
  }  // what is under way is the network's, not a queue
};

std::uint16_t port_of_nobody() {
  TcpTransport gone;
  return gone.listen("127.0.0.1", 0);
}

/// TCP, and UDP beside it, which is set up and limited in the same way.
template <class Socket, class Settings>
class SocketKit final : public TransportKit {
 public:
  SocketKit() { restart_server(); }
  Transport& server() override { return *server_; }
  Transport& client() override { return client_; }
  ConnectionId connect() override {
    ensure_file_limit(3 * connections + 64);
    return client_.connect("127.0.0.1", port_);
  }
  ConnectionId connect_to_nobody() override {
    return client_.connect("127.0.0.1", port_of_nobody());
  }
  void restart_server() override {
    server_.reset();
    server_.emplace(settings_);
    port_ = server_->listen("127.0.0.1", port_);
  }
  bool limit_queue(std::size_t queue_max) override {
    tcp_of(settings_).queue_max = queue_max;
    return true;
  }

 private:
  static TcpSettings& tcp_of(TcpSettings& settings) { return settings; }
  static TcpSettings& tcp_of(UdpSettings& settings) { return settings.tcp; }
  Settings settings_;
  std::uint16_t port_ = 0;
  Socket client_;
  std::optional<Socket> server_;
};
using TcpKit = SocketKit<TcpTransport, TcpSettings>;
using UdpKit = SocketKit<UdpTransport, UdpSettings>;

/// What stands on top of TCP: `Above` is made anew over each new TCP server.
template <class Above>
class AboveTcpKit : public TransportKit {
 public:
  Transport& server() override { return *above_; }
  ConnectionId connect_to_nobody() override { return connect_at(port_of_nobody()); }
  void restart_server() override {
    above_.reset();
    server_.reset();
    server_.emplace(settings_);
    port_ = server_->listen("127.0.0.1", port_);
    set_up(above_, *server_);
  }
  bool limit_queue(std::size_t queue_max) override {
    settings_.queue_max = queue_max;
    return true;
  }

 protected:
  virtual ConnectionId connect_at(std::uint16_t port) = 0;
  virtual void set_up(std::optional<Above>& above, TcpTransport& below) = 0;
  std::uint16_t port_ = 0;
  TcpTransport client_tcp_;

 private:
  TcpSettings settings_;
  std::optional<TcpTransport> server_;
  std::optional<Above> above_;
};

/// All connections over one of TCP.
class BundleKit final : public AboveTcpKit<BundledTransport> {
 public:
  BundleKit() { restart_server(); }
  Transport& client() override { return client_; }
  ConnectionId connect() override {
    if (!trunk_) trunk_ = client_tcp_.connect("127.0.0.1", port_);
    return client_.connect(*trunk_);
  }

 private:
  ConnectionId connect_at(std::uint16_t port) override {
    return client_.connect(client_tcp_.connect("127.0.0.1", port));
  }
  void set_up(std::optional<BundledTransport>& above, TcpTransport& below) override {
    above.emplace(below);
    trunk_.reset();
  }
  BundledTransport client_{client_tcp_};
  std::optional<ConnectionId> trunk_;
};

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// TCP with stages at its server, and none at its client.
class StagedKit : public AboveTcpKit<StagedTransport> {
 public:
  Transport& client() override { return client_; }
  ConnectionId connect() override { return connect_at(port_); }

 protected:
  virtual void add_stages(StagedTransport& above) = 0;

 private:
  ConnectionId connect_at(std::uint16_t port) override {
    return client_tcp_.connect("127.0.0.1", port);
  }
  void set_up(std::optional<StagedTransport>& above, TcpTransport& below) override {
    add_stages(above.emplace(below));
  }
  StagedTransport client_{client_tcp_};
};

class StaggeredKit final : public StagedKit {
 public:
  StaggeredKit() { restart_server(); }

 private:
  void add_stages(StagedTransport& above) override { above.add<Stagger>(0.002, steady_s); }
};

/// Staggered as well, so that stages meet. What it sends is no frames, whose rate is not limited.
class LimitedKit final : public StagedKit {
 public:
  LimitedKit() { restart_server(); }

 private:
  void add_stages(StagedTransport& above) override {
    above.add<Stagger>(0.002, steady_s);
    above.add<RateLimiter>(RateLimit{.bytes_per_s = 1e12}, steady_s);
  }
};

/// Transports whose servers have names; `Setting` is what one is made with.
template <class Named, class Setting>
class NamedKit : public TransportKit {
 public:
  explicit NamedKit(const Setting& setting) : setting_(setting) { restart_server(); }
  Transport& server() override { return *server_; }
  Transport& client() override { return client_; }
  ConnectionId connect() override {
    ensure_file_limit(2 * connections + 64);
    return client_.connect(name_);
  }
  ConnectionId connect_to_nobody() override { return client_.connect(name_ + "-nobody"); }
  void restart_server() final {
    server_.reset();
    server_.emplace(setting_);
    server_->listen(name_);
  }

 protected:
  Setting setting_;

 private:
  const std::string name_ = test::unique_name("rink-kit");
  Named client_;
  std::optional<Named> server_;
};

class SampleKit final : public NamedKit<sample::UnixTransport, std::size_t> {
 public:
  SampleKit() : NamedKit(1u << 20) {}
  bool limit_queue(std::size_t queue_max) override {
    setting_ = queue_max;
    return true;
  }
};

class SharedMemoryKit final : public NamedKit<SharedMemoryTransport, SharedMemorySettings> {
 public:
  SharedMemoryKit() : NamedKit(SharedMemorySettings{}) { connections = 200; }
  bool limit_queue(std::size_t queue_max) override {
    setting_.queue_max = queue_max;
    return true;
  }
};

template <class Kit>
KitChoice choice(const std::string& name) {
  return {name, [] { return std::make_unique<Kit>(); }};
}

}  // namespace

std::vector<KitChoice> transport_kits() {
  return {choice<InProcessKit>("in_process"),
          choice<VirtualKit>("virtual_network"),
          choice<TcpKit>("tcp"),
          choice<UdpKit>("udp"),
          choice<SharedMemoryKit>("shared_memory"),
          choice<BundleKit>("bundle"),
          choice<StaggeredKit>("staggered"),
          choice<LimitedKit>("limited"),
          choice<SampleKit>("sample")};
}

}  // namespace rink::rti::testing
