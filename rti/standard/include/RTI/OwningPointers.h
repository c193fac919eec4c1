// The API returns std::auto_ptr, which compilers warn of since C++11; between these two they don't.
#pragma once

#define RINK_BEGIN_OWNING_POINTERS \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wdeprecated-declarations\"")
#define RINK_END_OWNING_POINTERS _Pragma("GCC diagnostic pop")
