# Run at each build: writes OUTPUT, a header that says which commit of SOURCE is built by which compiler with which FLAGS, and touches it only if that changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+changes --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failure)
if(failure)
  set(commit "unknown")
endif()
set(text "// Which program this is; written by cmake/build_facts.cmake.\n#pragma once\n\n#define RINK_COMMIT \"${commit}\"\n#define RINK_VERSION \"${VERSION}\"\n#define RINK_FLAGS \"${FLAGS}\"\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} former)
endif()
if(NOT "${former}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
