# What every module, command and test of Rink is built with.

# One fixed instruction-set baseline, so that a build gives the same bits on every machine of its kind; never -march=native.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(RINK_BASELINE -march=x86-64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64")
  set(RINK_BASELINE -march=armv8-a)
endif()

# The asan preset adds -Wno-maybe-uninitialized: under its instrumentation GCC 12 warns of std::regex's own code (GCC bug 105562). The bench preset leaves out what GCC 12 warns of in
# its own std::string, std::vector and std::optional at -O3 (GCC bugs 105329, 105651, 107852); every other preset compiles the same sources with these warnings.
add_library(rink_options INTERFACE)
target_compile_options(rink_options INTERFACE -Wall -Wextra -Wconversion $<$<BOOL:${RINK_WARNINGS_AS_ERRORS}>:-Werror>)

# Commands and tests are mostly others' templates, of which the checks of every pointer take g++ a fifth of its time: there, pointers to nothing are left to the
# address sanitizer.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*undefined")
  set(RINK_FEWER_CHECKS -fno-sanitize=null,alignment,vptr)
endif()

find_package(Eigen3 REQUIRED)
find_package(nlohmann_json REQUIRED)

# rink_precompile(TARGET KIND FLAGS...): the target's sources begin with cmake/precompiled/KIND.h, compiled once for all targets of the kind and the same flags,
# which are what the target adds to those of every target, but for warnings. A source with flags of its own wants SKIP_PRECOMPILE_HEADERS.
function(rink_precompile target kind)
  if(NOT RINK_PRECOMPILED)
    return()
  endif()
  get_target_property(type ${target} TYPE)
  string(MAKE_C_IDENTIFIER "rink_precompiled_${kind}_${type}${ARGN}" holder)
  if(NOT TARGET ${holder})
    file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/precompiled/${holder}.cpp CONTENT "")
    add_library(${holder} OBJECT ${CMAKE_BINARY_DIR}/precompiled/${holder}.cpp)
    # ccache has to see that a precompiled header is used.
    target_compile_options(${holder} PRIVATE ${ARGN} -fpch-preprocess)
    if(type STREQUAL "EXECUTABLE")
      set_target_properties(${holder} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${holder} PRIVATE -fPIE)
    endif()
    target_include_directories(${holder} PRIVATE ${PROJECT_SOURCE_DIR})
    # Each is compiled with the macros that these define for who uses them.
    if(kind STREQUAL "tests")
      target_link_libraries(${holder} PRIVATE GTest::gmock)
    elseif(kind STREQUAL "game")
      target_link_libraries(${holder} PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json)
    endif()
    target_precompile_headers(${holder} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${kind}.h)
  endif()
  target_compile_options(${target} PRIVATE -fpch-preprocess)
  target_precompile_headers(${target} REUSE_FROM ${holder})
endfunction()

# rink_sources(VARIABLE PATTERNS...): what matches in the calling folder and below it, without folders that have a CMakeLists.txt of their own and without
# commands, *_main.cpp.
function(rink_sources variable)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
  file(GLOB_RECURSE others CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/CMakeLists.txt)
  list(REMOVE_ITEM others ${CMAKE_CURRENT_SOURCE_DIR}/CMakeLists.txt)
  foreach(other IN LISTS others)
    get_filename_component(folder ${other} DIRECTORY)
    string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" folder ${folder})
    list(FILTER sources EXCLUDE REGEX "^${folder}/")
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# rink_inlining(VARIABLE): flags that inline as if each source were compiled alone. g++ stops inlining in a source that has grown by 40 %, unless it is small; of
# sources compiled together, 1,000 pucks then took 10 % more instructions and updates to 100 clients 19 %. A precompiled header has to be made with the same flag,
# which g++ else ignores without a word.
function(rink_inlining variable)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(${variable} --param=inline-unit-growth=400 PARENT_SCOPE)
  endif()
endfunction()

# rink_module(NAME DEPENDS targets... PRIVATE targets...): a static library of the sources in the calling folder and below it.
function(rink_module name)
  cmake_parse_arguments(module "" "" "DEPENDS;PRIVATE" ${ARGN})
  rink_sources(sources *.cpp *.h)
  if(NOT sources)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_empty.cpp "")
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/${name}_empty.cpp)
  endif()
  add_library(rink_${name} STATIC ${sources})
  add_library(rink::${name} ALIAS rink_${name})
  set_target_properties(rink_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_include_directories(rink_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rink>)
  target_compile_features(rink_${name} PUBLIC cxx_std_20)
  target_link_libraries(rink_${name} PUBLIC ${module_DEPENDS} PRIVATE $<BUILD_INTERFACE:rink_options> ${module_PRIVATE})
  set(flags)
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/(im|rti|game/physics|game/replication)(/|$)")
    rink_inlining(flags)
    target_compile_options(rink_${name} PRIVATE ${flags})
  endif()
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/(im|rti)(/|$)")
    rink_precompile(rink_${name} standard ${flags})
  else()
    rink_precompile(rink_${name} game ${flags})
  endif()
endfunction()

# rink_command(PATH SOURCES files... DEPENDS targets...): the executable rink-NAME from PATH_main.cpp, PATH ending in NAME, and what else it is made of.
function(rink_command path)
  cmake_parse_arguments(command "" "" "SOURCES;DEPENDS" ${ARGN})
  get_filename_component(name ${path} NAME)
  add_executable(rink-${name} ${path}_main.cpp ${command_SOURCES})
  # What a command does is in its modules. Its flags alone take g++ a minute under a sanitizer with optimisation, half of that without.
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(rink-${name} PRIVATE -O0 ${RINK_FEWER_CHECKS})
    rink_precompile(rink-${name} game -O0 ${RINK_FEWER_CHECKS})
  else()
    rink_precompile(rink-${name} game)
  endif()
  target_link_libraries(rink-${name} PRIVATE ${command_DEPENDS} rink::apps rink::version rink_options)
  set_property(GLOBAL APPEND PROPERTY RINK_COMMANDS ${name})
  install(TARGETS rink-${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT commands)
endfunction()

# rink_share(DIRECTORY d | FILE f): data that commands read at run time, linked to <build>/share/rink and installed to share/rink.
function(rink_share kind path)
  get_filename_component(name ${path} NAME)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/rink)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${path} ${CMAKE_BINARY_DIR}/share/rink/${name} SYMBOLIC)
  if(kind STREQUAL "DIRECTORY")
    install(DIRECTORY ${path} DESTINATION ${CMAKE_INSTALL_DATADIR}/rink COMPONENT commands)
  else()
    install(FILES ${path} DESTINATION ${CMAKE_INSTALL_DATADIR}/rink COMPONENT commands)
  endif()
endfunction()

# rink_suites(NAME SOURCES...): one entry of ctest for each suite of test-NAME, and one for tests of no suite that the sources name: a program under a sanitizer
# takes a quarter of a second to start, of 2,400 tests more than they themselves.
function(rink_suites name)
  set(suites)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} tests REGEX "^(TEST|TEST_F|TEST_P|TYPED_TEST)\\(")
    list(TRANSFORM tests REPLACE "^[A-Z_]+\\(([^,]+),.*" "\\1")
    list(APPEND suites ${tests})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(named)
  foreach(suite IN LISTS suites)
    set(tests "${suite}.*:*/${suite}.*")
    list(APPEND named "${tests}")
    set(label quick)
    if(suite MATCHES "Long")
      set(label long)
    elseif(suite MATCHES "Threaded")
      set(label threaded)
    endif()
    add_test(NAME ${name}/${suite} COMMAND test-${name} "--gtest_filter=${tests}")
    set_tests_properties(${name}/${suite} PROPERTIES LABELS ${label} TIMEOUT 1800 PROCESSORS 2)
  endforeach()
  list(JOIN named ":" named)
  add_test(NAME ${name}/all-other-suites COMMAND test-${name} "--gtest_filter=-${named}")
  set_tests_properties(${name}/all-other-suites PROPERTIES LABELS quick TIMEOUT 1800 PROCESSORS 2)
endfunction()

# rink_tests(NAME [OPTIMISED] [WAITING suites...] DEPENDS targets...): one GoogleTest executable from the calling folder and below it. Suites whose name holds Long
# are labelled long, those whose name holds Threaded threaded (the thread sanitizer runs these, all in tests/threaded), the rest quick: quick enough for every run.
# A test takes two of ctest's places, of which there are two for each processor. One of a suite that is WAITING, for real time to pass or for other processes, takes one;
# under a sanitizer it computes too.
function(rink_tests name)
  cmake_parse_arguments(tests "OPTIMISED" "" "WAITING;DEPENDS" ${ARGN})
  rink_sources(sources *.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test-${name} ${sources})
  # What these sources test is optimised elsewhere, and without optimisation g++ takes two thirds of the time, under a sanitizer half. Only tests that compute much
  # in headers want it.
  set(flags ${RINK_FEWER_CHECKS})
  if(NOT tests_OPTIMISED)
    list(APPEND flags -O0)
  endif()
  # A failure names its line by itself; only sanitizers read it from what costs g++ a tenth of its time.
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(APPEND flags -g0)
  endif()
  target_compile_options(test-${name} PRIVATE ${flags})
  rink_precompile(test-${name} tests ${flags})
  target_link_libraries(test-${name} PRIVATE ${tests_DEPENDS} rink_test_places rink_options GTest::gmock GTest::gtest_main)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    rink_suites(${name} ${sources})
    return()
  endif()
  include(GoogleTest)
  set(patience 120)
  # Parameters print as bytes and addresses: a test is called by the name that its suite gives it, the same in every run.
  set(common DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES TEST_PREFIX ${name}/)
  list(TRANSFORM tests_WAITING APPEND ".*")
  list(JOIN tests_WAITING ":" waiting)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "-*Long*.*:*Threaded*.*:${waiting}" PROPERTIES LABELS quick TIMEOUT ${patience} PROCESSORS 2)
  if(waiting)
    gtest_discover_tests(test-${name} ${common} TEST_FILTER "${waiting}" PROPERTIES LABELS quick TIMEOUT ${patience})
  endif()
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Threaded*.*:-*Long*.*" PROPERTIES LABELS threaded TIMEOUT ${patience} PROCESSORS 2)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Long*.*" PROPERTIES LABELS long TIMEOUT 1800 PROCESSORS 2)
endfunction()
