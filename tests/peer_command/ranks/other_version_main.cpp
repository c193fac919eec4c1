// A rank that speaks a later version of the peers' protocol, for the test of what others say to it.
#include <chrono>
#include <thread>

#include "game/net/peer/ranks/rank_network.h"

int main() {
  rink::rti::Ranks ranks;
  rink::game::RankWords words;
  ++words.version;
  ranks.begin_gathering(rink::game::spoken(words));
  while (!ranks.gathered()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ranks.finish();
}
