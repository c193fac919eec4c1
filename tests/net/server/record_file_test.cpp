// Files of reports and traces: what the system says against writing them is handed on.
#include "game/net/record_file.h"

#include <gmock/gmock.h>

#include <cerrno>
#include <stdexcept>
#include <string>

#include "game/net/trace_lines.h"

namespace rink::game {
namespace {

template <class Attempt>
std::string refusal_of(Attempt attempt) {
  try {
    attempt();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it was written";
}

TEST(RecordFile, SaysWhyItCannotBeWritten) {
  EXPECT_EQ(refusal_of([] { write_file("/dev/full", "words"); }),
            "cannot write '/dev/full': No space left on device");
  EXPECT_EQ(refusal_of([] { write_file("/nowhere/at/all", "words"); }),
            "cannot write '/nowhere/at/all': No such file or directory");
  EXPECT_EQ(refusal_of([] { require_writable("--report", "/nowhere/at/all"); }),
            "--report: cannot write '/nowhere/at/all': No such file or directory");
}

TEST(Trace, SaysWhyItCannotBeWritten) {
  for (const int lines : {1, 10'000})  // in the buffer to the end, and not
    EXPECT_EQ(refusal_of([lines] {
                TraceWriter trace("/dev/full");
                for (int i = 0; i < lines; ++i) trace.line_of_text("[1, 2, 3]"), errno = EDOM;
                trace.finish();
              }),
              "cannot write '/dev/full': No space left on device");
  EXPECT_EQ(refusal_of([] { TraceWriter("/nowhere/at/all").finish(); }),
            "cannot write '/nowhere/at/all': No such file or directory");
}

}  // namespace
}  // namespace rink::game
