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
/// Of a goal, as in a hall.
std::vector<std::int16_t> horn_sound();

/// What is heard of a match.
struct Hearing {
  double volume = 1.0;    ///< 0 to 1; 0 is silence
  bool has_horn = false;  ///< at goals
  bool has_music = false;
};

/// How much faster than recorded an impact of `strength`, 0 to 1, is played: harder ones sound
/// higher.
double pitch_of(const Noise& noise);

/// Silent if there is no device; nothing here fails.
class Sounds {
 public:
  Sounds();
  ~Sounds();
  Sounds(const Sounds&) = delete;
  Sounds& operator=(const Sounds&) = delete;

  void play(const std::vector<Noise>& noises, const Hearing& hearing);

 private:
  void play_music(const Hearing& hearing);
  struct Device;
  std::unique_ptr<Device> device_;  ///< null: silence
};

}  // namespace rink::view
