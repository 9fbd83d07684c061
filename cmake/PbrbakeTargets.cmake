# What every target of the project shares: language level, warnings, and floating-point rules.
# No fast-math anywhere, and fused multiply-add only where the source writes it: bytes are promised.

add_library(pbrbake_flags INTERFACE)
target_compile_features(pbrbake_flags INTERFACE cxx_std_20)
target_compile_options(pbrbake_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -ffp-contract=off
    # GCC 12 vectorises neighbouring statements and then drops a rounding of double to float and back
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    $<$<BOOL:${PBRBAKE_WERROR}>:-Werror>)
if(PBRBAKE_SANITIZE)
    target_compile_options(pbrbake_flags INTERFACE -fsanitize=${PBRBAKE_SANITIZE} -fno-omit-frame-pointer
                           -fno-sanitize-recover=undefined
                           # GCC's warning is not to be had with sanitizers: they hide initialisation from it
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(pbrbake_flags INTERFACE -fsanitize=${PBRBAKE_SANITIZE})
endif()
if(PBRBAKE_FUZZ)  # coverage, without which libFuzzer finds no input interesting
    target_compile_options(pbrbake_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# pbrbake_layer(NAME SOURCES… [PUBLIC targets…] [PRIVATE targets…])
# One static library a layer of the house. What a layer links is all it can include.
function(pbrbake_layer name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;PUBLIC;PRIVATE")
    add_library(${name} STATIC ${arg_SOURCES})
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:pbrbake_flags> ${arg_PRIVATE})
endfunction()
