// Decaying sines and a little noise; a pool of sources, the oldest of which is taken when all play.
#include "game/view/sounds.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "game/view/feel/music.h"

namespace rink::view {
namespace {

constexpr std::size_t kind_count = 8, source_count = 16;
static_assert(static_cast<std::size_t>(Noise::Kind::win) + 1 == kind_count);

/// One sine of a sound: from `start` [s], with `pitch` [Hz], fading with `decay` [s].
struct Partial {
  double start, pitch, loudness, decay;
};

class Mix {
 public:
  explicit Mix(double duration_s) : samples_(static_cast<std::size_t>(duration_s * sound_rate)) {}

  Mix& add(const Partial& partial) {
    for (std::size_t i = static_cast<std::size_t>(partial.start * sound_rate); i < samples_.size();
         ++i) {
      const double t = static_cast<double>(i) / sound_rate - partial.start;
      samples_[i] += partial.loudness * std::exp(-t / partial.decay) * std::min(1.0, t / 0.002) *
                     std::sin(6.283185307179586 * partial.pitch * t);
    }
    return *this;
  }

  Mix& add_noise(double loudness, double decay) {
    std::uint32_t state = 12345;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      state = state * 1664525u + 1013904223u;
      const double t = static_cast<double>(i) / sound_rate;
      samples_[i] += loudness * std::exp(-t / decay) * std::min(1.0, t / 0.0005) *
                     (static_cast<double>(state >> 8) * 0x1p-23 - 1.0);
    }
    return *this;
  }

  std::vector<std::int16_t> take() const {
    std::vector<std::int16_t> samples(samples_.size());
    constexpr double fade_s = 0.005;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double left_s = static_cast<double>(samples.size() - 1 - i) / sound_rate;
      samples[i] = static_cast<std::int16_t>(32'000.0 * std::tanh(samples_[i]) *
                                             std::min(1.0, left_s / fade_s));
    }
    return samples;
  }

 private:
  std::vector<double> samples_;
};

}  // namespace

std::vector<std::int16_t> sound_of(Noise::Kind kind) {
  using Kind = Noise::Kind;
  switch (kind) {
    case Kind::puck_on_wall:
      return Mix(0.12)
          .add({0.0, 420.0, 0.5, 0.020})
          .add({0.0, 1050.0, 0.25, 0.010})
          .add_noise(0.35, 0.006)
          .take();
    case Kind::puck_on_bat:
      return Mix(0.16)
          .add({0.0, 260.0, 0.75, 0.030})
          .add({0.0, 720.0, 0.3, 0.014})
          .add_noise(0.45, 0.008)
          .take();
    case Kind::puck_on_post:
      return Mix(0.45)
          .add({0.0, 1730.0, 0.35, 0.10})
          .add({0.0, 2890.0, 0.22, 0.07})
          .add({0.0, 4410.0, 0.10, 0.05})
          .add_noise(0.2, 0.004)
          .take();
    case Kind::puck_on_puck:
      return Mix(0.10).add({0.0, 1250.0, 0.45, 0.014}).add_noise(0.3, 0.004).take();
    case Kind::count:
      return Mix(0.22).add({0.0, 660.0, 0.45, 0.07}).add({0.0, 1320.0, 0.12, 0.04}).take();
    case Kind::face_off:
      return Mix(0.5).add({0.0, 990.0, 0.5, 0.16}).add({0.0, 1980.0, 0.15, 0.10}).take();
    case Kind::goal:
      return Mix(1.1)
          .add({0.0, 196.0, 0.45, 0.5})
          .add({0.0, 293.7, 0.35, 0.5})
          .add({0.05, 392.0, 0.35, 0.5})
          .add({0.10, 587.3, 0.2, 0.4})
          .add_noise(0.10, 0.25)
          .take();
    case Kind::win:
      return Mix(1.8)
          .add({0.0, 392.0, 0.4, 0.25})
          .add({0.18, 493.9, 0.4, 0.25})
          .add({0.36, 587.3, 0.4, 0.25})
          .add({0.54, 784.0, 0.5, 0.6})
          .add({0.54, 392.0, 0.3, 0.6})
          .take();
  }
  return {};
}

std::vector<std::int16_t> horn_sound() {
  Mix mix(1.5);
  for (const double voice : {155.6, 185.0, 233.1})
    for (int overtone = 1; overtone <= 9; ++overtone)
      mix.add({0.0, voice * overtone, 0.30 / overtone, 0.9});
  return mix.take();
}

double pitch_of(const Noise& noise) {
  return noise.kind <= Noise::Kind::puck_on_puck ? 0.9 + 0.25 * std::clamp(noise.strength, 0.0, 1.0)
                                                 : 1.0;
}

namespace {

/// Hides standard error while it lives, since OpenAL's drivers print errors, and a missing device
/// is none.
class Silence {
 public:
  Silence() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~Silence() {
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int kept_;
};

}  // namespace

struct Sounds::Device {
  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  std::array<ALuint, kind_count> buffers{};
  std::array<ALuint, source_count> sources{};
  std::size_t next = 0;
  ALuint horn = 0;                      ///< a buffer
  ALuint music = 0, music_samples = 0;  ///< a source and its buffer, once it was wanted
  bool is_music_on = false;
};

Sounds::Sounds() {
  const Silence silence;
  ALCdevice* device = alcOpenDevice(nullptr);
  if (device == nullptr) return;
  ALCcontext* context = alcCreateContext(device, nullptr);
  if (context == nullptr) {
    alcCloseDevice(device);
    return;
  }
  device_ = std::make_unique<Device>();
  device_->device = device;
  device_->context = context;
  alcMakeContextCurrent(device_->context);
  alGenBuffers(kind_count, device_->buffers.data());
  alGenSources(source_count, device_->sources.data());
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const std::vector<std::int16_t> samples = sound_of(static_cast<Noise::Kind>(kind));
    alBufferData(device_->buffers[kind], AL_FORMAT_MONO16, samples.data(),
                 static_cast<ALsizei>(samples.size() * sizeof samples[0]), sound_rate);
  }
  alGenBuffers(1, &device_->horn);
  const std::vector<std::int16_t> horn = horn_sound();
  alBufferData(device_->horn, AL_FORMAT_MONO16, horn.data(),
               static_cast<ALsizei>(horn.size() * sizeof horn[0]), sound_rate);
}

Sounds::~Sounds() {
  if (!device_) return;
  alDeleteSources(source_count, device_->sources.data());
  if (device_->music != 0) alDeleteSources(1, &device_->music);
  if (device_->music_samples != 0) alDeleteBuffers(1, &device_->music_samples);
  alDeleteBuffers(kind_count, device_->buffers.data());
  alDeleteBuffers(1, &device_->horn);
  alcMakeContextCurrent(nullptr);
  alcDestroyContext(device_->context);
  alcCloseDevice(device_->device);
}

/// Made when it is wanted first, since that takes a tenth of a second.
void Sounds::play_music(const Hearing& hearing) {
  Device& device = *device_;
  const bool is_wanted = hearing.has_music && hearing.volume > 0.0;
  if (is_wanted && device.music == 0) {
    const std::vector<std::int16_t> loop = music_loop(sound_rate);
    alGenBuffers(1, &device.music_samples);
    alBufferData(device.music_samples, AL_FORMAT_MONO16, loop.data(),
                 static_cast<ALsizei>(loop.size() * sizeof loop[0]), sound_rate);
    alGenSources(1, &device.music);
    alSourcei(device.music, AL_BUFFER, static_cast<ALint>(device.music_samples));
    alSourcei(device.music, AL_LOOPING, AL_TRUE);
    alSourcei(device.music, AL_SOURCE_RELATIVE, AL_TRUE);
  }
  if (device.music == 0) return;
  alSourcef(device.music, AL_GAIN, static_cast<float>(0.4 * hearing.volume));
  if (is_wanted == device.is_music_on) return;
  if (is_wanted) alSourcePlay(device.music);
  else alSourcePause(device.music);
  device.is_music_on = is_wanted;
}

void Sounds::play(const std::vector<Noise>& noises, const Hearing& hearing) {
  if (!device_) return;
  play_music(hearing);
  const double volume = hearing.volume;
  if (volume <= 0.0) return;
  for (const Noise& noise : noises) {
    const ALuint source = device_->sources[device_->next++ % source_count];
    const auto aside = static_cast<float>(std::clamp(2.0 * noise.place - 1.0, -1.0, 1.0));
    alSourceStop(source);
    const bool is_horn = hearing.has_horn && noise.kind == Noise::Kind::goal;
    alSourcei(source, AL_BUFFER,
              static_cast<ALint>(is_horn ? device_->horn
                                         : device_->buffers[static_cast<std::size_t>(noise.kind)]));
    alSourcef(source, AL_PITCH, static_cast<float>(pitch_of(noise)));
    alSourcei(source, AL_SOURCE_RELATIVE, AL_TRUE);
    alSource3f(source, AL_POSITION, 0.7f * aside, 0.0f, -std::sqrt(1.0f - 0.49f * aside * aside));
    alSourcef(source, AL_GAIN, static_cast<float>(volume * std::clamp(noise.strength, 0.0, 1.0)));
    alSourcePlay(source);
  }
}

}  // namespace rink::view
