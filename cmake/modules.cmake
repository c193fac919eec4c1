# What every module, command and test of Rink is built with.

# One fixed instruction-set baseline, so that a build gives the same bits on every machine of its kind; never -march=native.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(RINK_BASELINE -march=x86-64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64")
  set(RINK_BASELINE -march=armv8-a)
endif()

# The asan preset adds -Wno-maybe-uninitialized: under its instrumentation GCC 12 warns of std::regex's own code (GCC bug 105562). The bench preset leaves out what GCC 12 warns of in
# its own std::string and std::vector at -O3 (GCC bugs 105329, 105651, 107852); every other preset compiles the same sources with these warnings.
add_library(rink_options INTERFACE)
target_compile_options(rink_options INTERFACE -Wall -Wextra -Wconversion $<$<BOOL:${RINK_WARNINGS_AS_ERRORS}>:-Werror>)

# Commands and tests are mostly others' templates, of which the checks of every pointer take g++ a fifth of its time: there, pointers to nothing are left to the
# address sanitizer.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*undefined")
  set(RINK_FEWER_CHECKS -fno-sanitize=null,alignment,vptr)
endif()

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
endfunction()

# rink_command(PATH SOURCES files... DEPENDS targets...): the executable rink-NAME from PATH_main.cpp, PATH ending in NAME, and what else it is made of.
function(rink_command path)
  cmake_parse_arguments(command "" "" "SOURCES;DEPENDS" ${ARGN})
  get_filename_component(name ${path} NAME)
  add_executable(rink-${name} ${path}_main.cpp ${command_SOURCES})
  # What a command does is in its modules. Its flags alone take g++ a minute under a sanitizer with optimisation, half of that without.
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(rink-${name} PRIVATE -O0 ${RINK_FEWER_CHECKS})
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

# rink_tests(NAME [OPTIMISED] DEPENDS targets...): one GoogleTest executable from the calling folder and below it. Suites whose name holds Long are labelled long, those whose
# name holds Threaded threaded (the thread sanitizer runs these), the rest quick. Whatever is not long is quick enough for every run.
function(rink_tests name)
  cmake_parse_arguments(tests "OPTIMISED" "" "DEPENDS" ${ARGN})
  rink_sources(sources *.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test-${name} ${sources})
  # What these sources test is optimised elsewhere, and without optimisation g++ takes two thirds of the time, under a sanitizer half. Only tests that compute much
  # in headers want it.
  if(NOT tests_OPTIMISED)
    target_compile_options(test-${name} PRIVATE -O0)
  endif()
  # A failure names its line by itself; only sanitizers read it from what costs g++ a tenth of its time.
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(test-${name} PRIVATE -g0)
  endif()
  target_compile_options(test-${name} PRIVATE ${RINK_FEWER_CHECKS})
  target_link_libraries(test-${name} PRIVATE ${tests_DEPENDS} rink_test_places rink_options GTest::gmock GTest::gtest_main)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} threaded REGEX "^TEST.*Threaded" LIMIT_COUNT 1)
    if(threaded)
      add_dependencies(threaded-tests test-${name})
    endif()
  endforeach()
  include(GoogleTest)
  set(patience 120)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(patience 600)
  endif()
  # Parameters print as bytes and addresses: a test is called by the name that its suite gives it, the same in every run.
  set(common DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES TEST_PREFIX ${name}/)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "-*Long*.*:*Threaded*.*" PROPERTIES LABELS quick TIMEOUT ${patience})
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Threaded*.*:-*Long*.*" PROPERTIES LABELS threaded TIMEOUT ${patience})
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Long*.*" PROPERTIES LABELS long TIMEOUT 1800)
endfunction()
