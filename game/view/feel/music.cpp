// Four chords of two bars each: broken chords over long low notes.
#include "game/view/feel/music.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rink::view {
namespace {

constexpr double beat_s = 60.0 / 104.0;
constexpr int chord_beats = 8;
/// Semitones above A at 110 Hz: A minor, F, C, G.
constexpr std::array<std::array<int, 4>, 4> chords{
    {{0, 12, 15, 19}, {-4, 8, 12, 15}, {3, 15, 19, 22}, {-2, 10, 14, 17}}};

double pitch(int semitones) { return 110.0 * std::exp2(semitones / 12.0); }

struct Note {
  double start_s, hertz, loudness, decay_s;
};

/// What rings on beyond the end rings at the beginning.
void add_note(std::vector<double>& samples, int rate, const Note& note) {
  const auto [start_s, hertz, loudness, decay_s] = note;
  const auto begin = static_cast<std::size_t>(start_s * rate),
             count = static_cast<std::size_t>(5.0 * decay_s * rate);
  const double turn = 6.283185307179586 * hertz / rate, fade = std::exp(-1.0 / (decay_s * rate));
  double strength = loudness;
  for (std::size_t i = 0; i < count; ++i, strength *= fade) {
    const auto t = static_cast<double>(i);
    const double soft = std::min(1.0, t / (0.012 * rate)),
                 end = std::min(1.0, static_cast<double>(count - i) / (0.02 * rate));
    samples[(begin + i) % samples.size()] +=
        strength * soft * end * (std::sin(turn * t) + 0.25 * std::sin(2.0 * turn * t));
  }
}

}  // namespace

std::vector<std::int16_t> music_loop(int rate) {
  constexpr double length_s = beat_s * chord_beats * static_cast<double>(chords.size());
  std::vector<double> samples(static_cast<std::size_t>(length_s * rate));
  for (std::size_t chord = 0; chord < chords.size(); ++chord) {
    const double begin_s = beat_s * chord_beats * static_cast<double>(chord);
    for (int half = 0; half < 2 * chord_beats; ++half) {
      const std::size_t voice =
          std::array<std::size_t, 4>{1, 2, 3, 2}[static_cast<std::size_t>(half) % 4];
      add_note(samples, rate,
               {begin_s + 0.5 * beat_s * half, pitch(chords[chord][voice]), 0.10, 0.25});
    }
    for (int beat = 0; beat < chord_beats; beat += 2)
      add_note(samples, rate, {begin_s + beat_s * beat, pitch(chords[chord][0]), 0.16, 0.5});
  }
  std::vector<std::int16_t> loop(samples.size());
  for (std::size_t i = 0; i < loop.size(); ++i)
    loop[i] = static_cast<std::int16_t>(32'000.0 * std::tanh(samples[i]));
  return loop;
}

}  // namespace rink::view
