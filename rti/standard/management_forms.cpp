// Values of the management object model.
#include "rti/standard/management_forms.h"

#include <string>

#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

constexpr std::size_t handle_bytes = 4;

/// A handle is an array of octets: its count, and the handle as it encodes itself.
void put_handle(std::string& text, const char* handle) {
  text.append({0, 0, 0, static_cast<char>(handle_bytes)});
  text.append(handle, handle_bytes);
}

rti1516e::VariableLengthData data_from(const std::string& text) {
  return rti1516e::VariableLengthData(text.data(), text.size());
}

}  // namespace

rti1516e::VariableLengthData management_to_standard(std::string_view data_type, rti::Bytes value) {
  const auto* const bytes = reinterpret_cast<const char*>(value.data());
  if (data_type == "HLAunicodeString")
    return rti1516e::HLAunicodeString(to_wide({bytes, value.size()})).encode();
  std::string text;
  if (data_type == "HLAhandle" && value.size() == handle_bytes) {
    put_handle(text, bytes);
    return data_from(text);
  }
  if (data_type == "HLAhandleList") {
    const auto count = static_cast<std::uint32_t>(value.size() / handle_bytes);
    for (int shift = 24; shift >= 0; shift -= 8)
      text.push_back(static_cast<char>(count >> shift & 0xff));
    for (std::size_t i = 0; i < count; ++i) put_handle(text, bytes + handle_bytes * i);
    return data_from(text);
  }
  return rti1516e::VariableLengthData(value.data(), value.size());
}

rti1516e::VariableLengthData management_from_standard(std::string_view data_type,
                                                      rti1516e::VariableLengthData const& value) {
  if (data_type != "HLAhandle") return value;
  if (value.size() != 2 * handle_bytes)
    throw rti1516e::RTIinternalError(L"HLAhandle has 4 octets behind their count");
  return rti1516e::VariableLengthData(static_cast<const char*>(value.data()) + handle_bytes,
                                      handle_bytes);
}

}  // namespace rink::standard
