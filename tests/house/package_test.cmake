# Installs the library component, then configures, builds and runs a project that knows Rink only through find_package.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${WORK}/prefix)
# --no-warn-unused-cli: a compiler or flags that equal the defaults are no mistake. No launcher, preset or toolchain of ours reaches the consumer.
run(${CMAKE_COMMAND} --no-warn-unused-cli -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CMAKE_CXX_COMPILER=${COMPILER}
    "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
# The program is called after its folder, or consumer.
get_filename_component(program ${CONSUMER} NAME)
string(REGEX REPLACE "^consumer.*" "consumer" program ${program})
run(${WORK}/build/${program})
message(STATUS "${output}")
