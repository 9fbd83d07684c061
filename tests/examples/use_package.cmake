# Builds SOURCE in WORK against the package in PREFIX and runs it; then asks for a component that there isn't.
file(REMOVE_RECURSE ${WORK})
set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_CXX_COMPILER=${COMPILER}
              -D CMAKE_CXX_FLAGS=${FLAGS})
execute_process(COMMAND ${configure} -S ${SOURCE} -B ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/build/use_libpbr OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
message("${said}")
if(NOT said MATCHES "scale 0\\.[0-9]+, bias 0\\.[0-9]+" OR NOT said MATCHES "density at its axis [0-9.]+ / sr")
    message(FATAL_ERROR "use_libpbr printed something else")
endif()

file(WRITE ${WORK}/wrong/CMakeLists.txt
"cmake_minimum_required(VERSION 3.21)\nproject(wrong LANGUAGES CXX)\nfind_package(pbrbake REQUIRED COMPONENTS nonsense)\n")
execute_process(COMMAND ${configure} -S ${WORK}/wrong -B ${WORK}/wrong/build RESULT_VARIABLE result
                OUTPUT_QUIET ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "pbrbake has no component \"nonsense\"")
    message(FATAL_ERROR "an unknown component was not refused by name: ${error}")
endif()
