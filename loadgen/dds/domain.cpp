// Configures Cyclone DDS by text instead of by the user's environment, so that all runs are alike.
#include "loadgen/dds/domain.h"

#include <unistd.h>

#include <cassert>
#include <mutex>
#include <utility>

#include <dds/dds.h>
#include <topics.h>

namespace rink::loadgen {
namespace {

/// Ports of RTPS 9.6.1.1 with the default mapping: 7400 + 250 x domain + 10 for the first
/// participant's discovery.
std::uint32_t discovery_port(std::uint32_t number) { return 7400 + 250 * number + 10; }

std::string configuration(std::uint32_t number, bool is_server) {
  const std::string peer = "127.0.0.1:" + std::to_string(discovery_port(number));
  return "<General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast></General>"
         "<Discovery><ExternalDomainId>" +
         std::to_string(number) + "</ExternalDomainId><ParticipantIndex>" +
         (is_server ? "0" : "none") + "</ParticipantIndex><LeaseDuration>5s</LeaseDuration>" +
         (is_server ? "" : "<Peers><Peer Address=\"" + peer + "\"/></Peers>") + "</Discovery>";
}

/// What the library says of errors would stand in the middle of ours; the last is kept for them.
class SaidByLibrary {
 public:
  /// Forgets what was said before.
  static void listen() {
    {
      const std::scoped_lock lock(mutex());
      text().clear();
    }
    dds_set_log_sink(
        [](void*, const dds_log_data_t* data) {
          const std::scoped_lock lock(mutex());
          text() = data->message;
          while (!text().empty() && text().back() == '\n') text().pop_back();
        },
        nullptr);
  }
  static std::string last() {
    const std::scoped_lock lock(mutex());
    return text();
  }

 private:
  static std::mutex& mutex() {
    static std::mutex own;
    return own;
  }
  static std::string& text() {
    static std::string own;
    return own;
  }
};

struct Qos {
  dds_qos_t* own = dds_create_qos();
  Qos() = default;
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
  ~Qos() { dds_delete_qos(own); }

  void deliver(Delivery delivery) const {
    if (delivery == Delivery::best_effort) {
      dds_qset_reliability(own, DDS_RELIABILITY_BEST_EFFORT, 0);
      return;
    }
    dds_qset_reliability(own, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    if (delivery == Delivery::kept) dds_qset_durability(own, DDS_DURABILITY_TRANSIENT_LOCAL);
    else dds_qset_history(own, DDS_HISTORY_KEEP_ALL, 0);
  }
  void part(const std::string& name) const {
    const char* names[] = {name.c_str()};
    if (!name.empty()) dds_qset_partition(own, 1, names);
  }
};

}  // namespace

DdsEntity require(DdsEntity result, const std::string& what) {
  if (result >= 0) return result;
  const std::string said = SaidByLibrary::last();
  throw DdsError("Cyclone DDS: " + what + ": " + dds_strretcode(result) +
                 (said.empty() ? "" : " (" + said + ")"));
}

Domain Domain::of_server() {
  const auto first = static_cast<std::uint32_t>(getpid());
  for (std::uint32_t tried = 0;; ++tried) try {
      return of_server(1 + (first + tried) % number_max);
    } catch (const DomainInUse&) {
      if (tried + 1 == number_max) throw;
    }
}

Domain::Domain(std::uint32_t number, bool is_server, std::uint32_t instance) : number_(number) {
  assert(number <= number_max);
  SaidByLibrary::listen();
  const auto domain = dds_create_domain(instance, configuration(number, is_server).c_str());
  const auto participant =
      domain >= 0 ? dds_create_participant(instance, nullptr, nullptr) : domain;
  if (participant < 0) {
    if (domain >= 0) dds_delete(domain);
    const std::string said = SaidByLibrary::last();
    if (said.find("interface") != std::string::npos)
      throw DdsError("Cyclone DDS cannot use the loopback interface lo: " + said);
    if (is_server && said.find("sockets") != std::string::npos)
      throw DomainInUse("domain " + std::to_string(number) + " is in use on this machine (" +
                        (said.empty() ? dds_strretcode(participant) : said) +
                        "): expected another --domain, or none, for any that is free");
    require(participant, "opening domain " + std::to_string(number));
  }
  domain_ = domain, participant_ = participant;
  states_ = require(dds_create_topic(participant, &rink_dds_State_desc, "State", nullptr, nullptr),
                    "topic State");
  sessions_ =
      require(dds_create_topic(participant, &rink_dds_Session_desc, "Session", nullptr, nullptr),
              "topic Session");
  inputs_ = require(dds_create_topic(participant, &rink_dds_Input_desc, "Input", nullptr, nullptr),
                    "topic Input");
}

Domain::Domain(Domain&& other) noexcept
    : number_(other.number_),
      domain_(std::exchange(other.domain_, 0)),
      participant_(other.participant_),
      states_(other.states_),
      sessions_(other.sessions_),
      inputs_(other.inputs_) {}

Domain::~Domain() {
  if (domain_ > 0) dds_delete(domain_);
}

Endpoint make_writer(const Domain& domain, DdsEntity topic, const std::string& partition,
                     Delivery delivery) {
  const Qos group, own;
  group.part(partition);
  own.deliver(delivery);
  // A body that changes cells is unregistered, which must not dispose of it.
  dds_qset_writer_data_lifecycle(own.own, false);
  Endpoint made;
  made.group = require(dds_create_publisher(domain.participant(), group.own, nullptr),
                       "a publisher of " + partition);
  made.own = require(dds_create_writer(made.group, topic, own.own, nullptr), "a writer");
  return made;
}

Endpoint make_reader(const Domain& domain, DdsEntity topic, const std::string& partition,
                     Delivery delivery, std::uint32_t player) {
  const Qos group, own;
  group.part(partition);
  own.deliver(delivery);
  dds_qset_userdata(own.own, &player, sizeof player);
  Endpoint made;
  made.group = require(dds_create_subscriber(domain.participant(), group.own, nullptr),
                       "a subscriber of " + partition);
  made.own = require(dds_create_reader(made.group, topic, own.own, nullptr), "a reader");
  require(dds_set_status_mask(made.own, DDS_DATA_AVAILABLE_STATUS), "a reader's status");
  return made;
}

}  // namespace rink::loadgen
