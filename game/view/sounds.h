// Clicks, rings and fanfares, made in code and played through OpenAL where there is a device.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "game/view/match_source.h"

namespace rink::view {

inline constexpr int sound_rate = 44'100;  ///< samples per second

/// The samples of `kind`: mono, starting and ending in silence.
std::vector<std::int16_t> sound_of(Noise::Kind kind);

/// Silent if there is no device; nothing here fails.
class Sounds {
 public:
  Sounds();
  ~Sounds();
  Sounds(const Sounds&) = delete;
  Sounds& operator=(const Sounds&) = delete;

  /// `volume` from 0 to 1.
  void play(const std::vector<Noise>& noises, double volume);

 private:
  struct Device;
  std::unique_ptr<Device> device_;  ///< null: silence
};

}  // namespace rink::view
