// How regattas go: which services their sailors call, how often, and who leaves.
#pragma once

#include <vector>

#include "tests/rti/scenes/regatta_services.h"

namespace rink::rti::testing::at_the_regatta {

using Service = void (*)(Regatta&, Sailor&);

/// How a regatta goes: services are called by chance, each as often as it stands in the list.
struct Course {
  std::vector<Service> services;
  Service preparation = prepare;  ///< what each does first
  std::uint64_t leaves_every = 0;
  std::size_t datagram_size = 0;
  bool is_jammed_at_times = false;
  FederationSettings settings{};
};

inline constexpr std::size_t seat_count = 5;
inline constexpr int round_count = 150;

/// Resigns, dies, or says what shall become of its boats when it does.
inline void leave(Regatta& all, std::size_t seat) {
  Ambassador& to = all.sailor(seat).ambassador;
  const auto action = static_cast<ResignAction>(all.below(6));
  if (all.one_in(3)) {
    Regatta::attempt([&] { to.set_automatic_resign_directive(action); });
  } else if (all.one_in(2)) {
    all.kill(seat);
  } else {
    Regatta::attempt([&] { to.resign(action); });
  }
}

/// Everybody may do what the course lists, round after round.
inline void sail(Regatta& all, const Course& course) {
  all.datagram_size = course.datagram_size;
  for (std::size_t seat = 0; seat < seat_count; ++seat) course.preparation(all, all.sailor(seat));
  for (int round = 0; round < round_count; ++round) {
    for (std::size_t seat = 0; seat < seat_count; ++seat) {
      if (all.sailor(seat).is_lost || !all.sailor(seat).ambassador.is_joined()) {
        if (all.sailor(seat).is_lost && all.one_in(2)) all.enter(seat);
        continue;
      }
      for (std::uint64_t calls = all.below(6); calls > 0; --calls) {
        const Service service = course.services[all.below(course.services.size())];
        Regatta::attempt([&] { service(all, all.sailor(seat)); });
      }
      if (all.one_in(3)) all.speak(seat);
      if (course.leaves_every != 0 && all.one_in(course.leaves_every)) leave(all, seat);
    }
    if (course.is_jammed_at_times) all.queued_bytes = all.one_in(3) ? 1u << 20 : 0;
    all.tick();
  }
}

inline FederationSettings filtered(const std::string& filter) {
  FederationSettings settings;
  settings.filter = filter;
  settings.filter_settings.world = {0.0, 0.0, 100.0, 100.0};
  return settings;
}
inline FederationSettings cramped() {
  FederationSettings settings;
  settings.entry_bytes_per_flush_max = 60;
  settings.interaction_bytes_per_flush_max = 120;
  settings.objects_per_federate_max = 12;
  settings.object_max = 40;
  settings.timed_max = 30;
  settings.keyframe_period = 3;
  return settings;
}

}  // namespace rink::rti::testing::at_the_regatta
