// Peers in threads of their own, who know each other by their messages alone.
#include <gtest/gtest.h>

#include <thread>

#include "tests/peer/shared_scenes.h"
#include "tests/peer/thread_mail.h"

namespace rink::peer::test {
namespace {

/// What each of the peers has at the end of so many windows of scene `number`.
std::vector<Handover> play_in_threads(const SharedScene& scene, const Division& division,
                                      double window, int window_count) {
  const PeerNumber peer_count = division.peer_count();
  std::vector<Handover> parts(peer_count);
  PostOffice office(peer_count);
  const auto play = [&](PeerNumber number) {
    Peer peer(scene.world.spec(), division, number, scene.world.body_count(), 0.2);
    for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
      peer.consider(body, physics::Subdomain::state_in(scene.world, body));
    for (const Key& key : scene.keys) peer.press_first(key);
    peer.begin(window);
    ThreadMail mail(office, number);
    for (int k = 1; k <= window_count; ++k) play_window(peer, peer_count, mail, window * (k + 1));
    parts[number] = own_bodies(peer);
  };
  std::vector<std::jthread> threads;
  for (PeerNumber number = 0; number < peer_count; ++number) threads.emplace_back(play, number);
  threads.clear();
  return parts;
}

TEST(PeersThreaded, HaveTogetherTheHashOfOneEngine) {
  for (const std::uint64_t number : {0, 5, 6, 7}) {
    const double window = 0.01;
    const int window_count = 20;
    SharedScene scene = shared_scene(number, window * window_count);
    Random random(number);
    const std::vector<Handover> parts = play_in_threads(
        scene, random_division(scene.world.spec().field, random, 4), window, window_count);
    for (const Key& key : scene.keys) {
      physics::test::RandomKeys::advance(scene.world, key.time);
      scene.world.set_thrust({key.bat}, key.thrust);
    }
    physics::test::RandomKeys::advance(scene.world, window * window_count);
    EXPECT_EQ(hash_of_whole(scene.world.spec(), scene.world.body_count(), parts),
              scene.world.hash())
        << "scene " << number;
  }
}

}  // namespace
}  // namespace rink::peer::test
