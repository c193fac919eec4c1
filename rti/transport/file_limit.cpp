// Raises the limit of open files, or throws an error that names both limits.
#include <sys/resource.h>

#include <string>

#include "rti/transport/tcp/tcp.h"

namespace rink::rti {

void ensure_file_limit(std::size_t needed) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0)
    throw TransportError(TransportError::Kind::failed, "can't read the limit of open files");
  if (limit.rlim_cur >= needed) return;
  const rlim_t wanted = needed;
  rlimit raised = limit;
  raised.rlim_cur = wanted;
  if (limit.rlim_max >= wanted && setrlimit(RLIMIT_NOFILE, &raised) == 0) return;
  raised.rlim_max = wanted;  // only a privileged process may
  if (setrlimit(RLIMIT_NOFILE, &raised) == 0) return;
  throw TransportError(TransportError::Kind::too_many_files,
                       std::to_string(needed) + " open files are needed but only " +
                           std::to_string(limit.rlim_max) + " are allowed (now " +
                           std::to_string(limit.rlim_cur) + "): raise the limit with `ulimit -n " +
                           std::to_string(needed) + "` or in /etc/security/limits.conf");
}

}  // namespace rink::rti
