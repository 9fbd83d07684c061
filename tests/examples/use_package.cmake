# Builds SOURCE in WORK against the package in PREFIX and runs it; then asks for a component that there isn't.
file(REMOVE_RECURSE ${WORK})
set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_CXX_COMPILER=${COMPILER}
              -D CMAKE_CXX_FLAGS=${FLAGS})
execute_process(COMMAND ${configure} -S ${SOURCE} -B ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/build/use_libpbr OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
message("${said}")
# Its figures, each reckoned a second time by other code: E, Fc and the lobe by their formulas, Sunny 16 by hand, the
# ball by the textbook form of its BRDF.
foreach(figure IN ITEMS
        "scale 0.834916, bias 0.022347"
        "density at its axis 1.670257 / sr"
        "EV 14.64, mean 3200 nit, saturates at 30720 nit"
        "60 deg up: 100000.00 lx,  5194.52 nit, pixel 0.1691"
        "30 deg up:  86602.54 lx,  9950.57 nit, pixel 0.3239"
        " 0 deg up:  50000.00 lx,  2597.26 nit, pixel 0.0845"
        "-60 deg up:      0.00 lx,     0.00 nit, pixel 0.0000"
        "EV 4.88"
        "800 lm, 63.66 cd"
        "30 deg up:     13.78 lx,     1.58 nit, pixel 0.0449")
    string(FIND "${said}" "${figure}" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "use_libpbr did not print \"${figure}\"")
    endif()
endforeach()

# And the README shows what it prints.
file(STRINGS ${SOURCE}/README.md shown REGEX "^    +(Sunny|ball|normal)")
list(LENGTH shown count)
if(count LESS 6)
    message(FATAL_ERROR "the README shows ${count} lines of use_libpbr's")
endif()
foreach(line IN LISTS shown)
    string(SUBSTRING "${line}" 4 -1 line)
    string(FIND "${said}" "${line}" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "use_libpbr did not print what its README shows: ${line}")
    endif()
endforeach()

file(WRITE ${WORK}/wrong/CMakeLists.txt
"cmake_minimum_required(VERSION 3.21)\nproject(wrong LANGUAGES CXX)\nfind_package(pbrbake REQUIRED COMPONENTS nonsense)\n")
execute_process(COMMAND ${configure} -S ${WORK}/wrong -B ${WORK}/wrong/build RESULT_VARIABLE result
                OUTPUT_QUIET ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "pbrbake has no component \"nonsense\"")
    message(FATAL_ERROR "an unknown component was not refused by name: ${error}")
endif()
