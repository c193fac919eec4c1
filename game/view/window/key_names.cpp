// Names of the keys on a keyboard, as settings and scripts write them.
#include <algorithm>
#include <cctype>

#include "game/view/settings.h"
#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

struct Named {
  const char* name;
  KeyCode code;
};

constexpr Named named_keys[] = {{"space", GLFW_KEY_SPACE},
                                {"escape", GLFW_KEY_ESCAPE},
                                {"enter", GLFW_KEY_ENTER},
                                {"tab", GLFW_KEY_TAB},
                                {"backspace", GLFW_KEY_BACKSPACE},
                                {"insert", GLFW_KEY_INSERT},
                                {"delete", GLFW_KEY_DELETE},
                                {"right", GLFW_KEY_RIGHT},
                                {"left", GLFW_KEY_LEFT},
                                {"down", GLFW_KEY_DOWN},
                                {"up", GLFW_KEY_UP},
                                {"page up", GLFW_KEY_PAGE_UP},
                                {"page down", GLFW_KEY_PAGE_DOWN},
                                {"home", GLFW_KEY_HOME},
                                {"end", GLFW_KEY_END},
                                {"caps lock", GLFW_KEY_CAPS_LOCK},
                                {"left shift", GLFW_KEY_LEFT_SHIFT},
                                {"left control", GLFW_KEY_LEFT_CONTROL},
                                {"left alt", GLFW_KEY_LEFT_ALT},
                                {"right shift", GLFW_KEY_RIGHT_SHIFT},
                                {"right control", GLFW_KEY_RIGHT_CONTROL},
                                {"right alt", GLFW_KEY_RIGHT_ALT},
                                {"comma", GLFW_KEY_COMMA},
                                {"period", GLFW_KEY_PERIOD},
                                {"slash", GLFW_KEY_SLASH},
                                {"semicolon", GLFW_KEY_SEMICOLON},
                                {"apostrophe", GLFW_KEY_APOSTROPHE},
                                {"minus", GLFW_KEY_MINUS},
                                {"equal", GLFW_KEY_EQUAL},
                                {"left bracket", GLFW_KEY_LEFT_BRACKET},
                                {"right bracket", GLFW_KEY_RIGHT_BRACKET},
                                {"backslash", GLFW_KEY_BACKSLASH},
                                {"grave", GLFW_KEY_GRAVE_ACCENT},
                                {"keypad plus", GLFW_KEY_KP_ADD},
                                {"keypad minus", GLFW_KEY_KP_SUBTRACT},
                                {"keypad enter", GLFW_KEY_KP_ENTER},
                                {"keypad period", GLFW_KEY_KP_DECIMAL},
                                {"less", GLFW_KEY_WORLD_1}};

bool is_letter_or_digit(KeyCode code) {
  return (code >= GLFW_KEY_A && code <= GLFW_KEY_Z) || (code >= GLFW_KEY_0 && code <= GLFW_KEY_9);
}

}  // namespace

std::optional<std::string> key_code_name(KeyCode code) {
  if (is_letter_or_digit(code)) return std::string(1, static_cast<char>(std::tolower(code)));
  if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F25)
    return "f" + std::to_string(code - GLFW_KEY_F1 + 1);
  if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9)
    return "keypad " + std::to_string(code - GLFW_KEY_KP_0);
  for (const Named& key : named_keys)
    if (key.code == code) return key.name;
  return std::nullopt;
}

std::optional<KeyCode> key_code_from_name(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  for (KeyCode code = GLFW_KEY_SPACE; code <= GLFW_KEY_LAST; ++code)
    if (key_code_name(code) == lower) return code;
  return std::nullopt;
}

}  // namespace rink::view
