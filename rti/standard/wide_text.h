// The standard's C++ API has wide strings; Rink has UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace rink::standard {

/// What is no UTF-8 becomes U+FFFD.
std::wstring to_wide(std::string_view text);
/// What is no Unicode scalar value becomes U+FFFD.
std::string to_utf8(std::wstring_view text);

/// UTF-16 code units, as HLAunicodeString holds them; what is no scalar value becomes U+FFFD.
std::u16string to_utf16(std::wstring_view text);
std::wstring from_utf16(std::u16string_view text);

}  // namespace rink::standard
