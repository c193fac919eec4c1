// What encoding helpers throw.
#pragma once

#include <RTI/Exception.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/EncodingConfig.h>

#include <string>

namespace rti1516e {

class RTI_EXPORT EncoderException : public Exception {
 public:
  EncoderException(std::wstring const& message) noexcept;
  std::wstring what() const noexcept override;

 private:
  std::wstring _msg;
};

}  // namespace rti1516e
