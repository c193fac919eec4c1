# What every module, command and test of Rink is built with.

# One fixed instruction-set baseline, so that a build gives the same bits on every machine of its kind; never -march=native.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(RINK_BASELINE -march=x86-64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64")
  set(RINK_BASELINE -march=armv8-a)
endif()

# The asan preset adds -Wno-maybe-uninitialized: under its instrumentation GCC 12 warns of std::regex's own code (GCC bug 105562).
add_library(rink_options INTERFACE)
target_compile_options(rink_options INTERFACE -Wall -Wextra -Wconversion $<$<BOOL:${RINK_WARNINGS_AS_ERRORS}>:-Werror>)

# rink_module(NAME DEPENDS targets...): a static library of the calling folder's sources. Files called *_main.cpp are commands, not part of it.
function(rink_module name)
  cmake_parse_arguments(module "" "" "DEPENDS;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
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

# rink_command(NAME DEPENDS targets...): the executable rink-NAME from NAME_main.cpp in the calling folder.
function(rink_command name)
  cmake_parse_arguments(command "" "" "DEPENDS" ${ARGN})
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}_main.cpp)
    return()
  endif()
  add_executable(rink-${name} ${name}_main.cpp)
  target_link_libraries(rink-${name} PRIVATE ${command_DEPENDS} rink_options)
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

# rink_tests(NAME DEPENDS targets...): one GoogleTest executable from the calling folder. Suites whose name holds Long are labelled long, those whose
# name holds Threaded threaded (the thread sanitizer runs these), the rest quick. Whatever is not long is quick enough for every run.
function(rink_tests name)
  cmake_parse_arguments(tests "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test-${name} ${sources})
  target_link_libraries(test-${name} PRIVATE ${tests_DEPENDS} rink_options GTest::gmock GTest::gtest_main)
  target_compile_definitions(test-${name} PRIVATE RINK_SOURCE_DIR="${PROJECT_SOURCE_DIR}" RINK_BINARY_DIR="${CMAKE_BINARY_DIR}")
  include(GoogleTest)
  set(common DISCOVERY_MODE PRE_TEST TEST_PREFIX ${name}/)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "-*Long*.*:*Threaded*.*" PROPERTIES LABELS quick TIMEOUT 120)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Threaded*.*:-*Long*.*" PROPERTIES LABELS threaded TIMEOUT 120)
  gtest_discover_tests(test-${name} ${common} TEST_FILTER "*Long*.*" PROPERTIES LABELS long TIMEOUT 1800)
endfunction()
