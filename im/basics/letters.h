// The characters of names and numbers in expressions.
#pragma once

namespace rink::im {

inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace rink::im
