// Conversions between wide strings, UTF-8 and UTF-16.
#include "rti/standard/wide_text.h"

#include <cstddef>
#include <cstdint>

namespace rink::standard {

static_assert(sizeof(wchar_t) == 4, "a wide character is a Unicode scalar value");

namespace {

constexpr char32_t replacement = 0xfffd;

char32_t scalar(char32_t value) {
  const bool is_surrogate = value >= 0xd800 && value < 0xe000;
  return value > 0x10ffff || is_surrogate ? replacement : value;
}

/// Bytes of the character that `first` begins; 0 if none does.
std::size_t utf8_size(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  if (first >= 0xf0 && first < 0xf5) return 4;
  return 0;
}

/// The character at `place`, which it moves on.
char32_t next_utf8(std::string_view text, std::size_t& place) {
  const auto first = static_cast<unsigned char>(text[place++]);
  const std::size_t size = utf8_size(first);
  if (size <= 1) return size == 1 ? first : replacement;
  char32_t value = first & (0xffu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if (place == text.size() || (static_cast<unsigned char>(text[place]) & 0xc0) != 0x80)
      return replacement;
    value = value << 6 | (static_cast<unsigned char>(text[place++]) & 0x3fu);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  return value < least[size] ? replacement : scalar(value);
}

}  // namespace

std::wstring to_wide(std::string_view text) {
  std::wstring wide;
  wide.reserve(text.size());
  for (std::size_t place = 0; place < text.size();)
    wide.push_back(static_cast<wchar_t>(next_utf8(text, place)));
  return wide;
}

std::string to_utf8(std::wstring_view text) {
  std::string bytes;
  bytes.reserve(text.size());
  const auto add = [&](char32_t value) { bytes.push_back(static_cast<char>(value)); };
  for (const wchar_t each : text) {
    const char32_t value = scalar(static_cast<char32_t>(each));
    if (value < 0x80) {
      add(value);
    } else if (value < 0x800) {
      add(0xc0 | value >> 6);
      add(0x80 | (value & 0x3f));
    } else if (value < 0x10000) {
      add(0xe0 | value >> 12);
      add(0x80 | (value >> 6 & 0x3f));
      add(0x80 | (value & 0x3f));
    } else {
      add(0xf0 | value >> 18);
      add(0x80 | (value >> 12 & 0x3f));
      add(0x80 | (value >> 6 & 0x3f));
      add(0x80 | (value & 0x3f));
    }
  }
  return bytes;
}

std::u16string to_utf16(std::wstring_view text) {
  std::u16string units;
  units.reserve(text.size());
  for (const wchar_t each : text) {
    const char32_t value = scalar(static_cast<char32_t>(each));
    if (value < 0x10000) {
      units.push_back(static_cast<char16_t>(value));
      continue;
    }
    units.push_back(static_cast<char16_t>(0xd800 + ((value - 0x10000) >> 10)));
    units.push_back(static_cast<char16_t>(0xdc00 + ((value - 0x10000) & 0x3ff)));
  }
  return units;
}

std::wstring from_utf16(std::u16string_view text) {
  std::wstring wide;
  wide.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char32_t unit = text[i];
    const bool is_pair = unit >= 0xd800 && unit < 0xdc00 && i + 1 < text.size() &&
                         text[i + 1] >= 0xdc00 && text[i + 1] < 0xe000;
    if (is_pair) {
      const char32_t low = text[++i];
      wide.push_back(static_cast<wchar_t>(0x10000 + ((unit - 0xd800) << 10) + (low - 0xdc00)));
    } else {
      wide.push_back(static_cast<wchar_t>(scalar(unit)));
    }
  }
  return wide;
}

}  // namespace rink::standard
