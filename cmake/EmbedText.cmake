# pbrbake_embed_text(OUTPUT_VARIABLE SYMBOL FILE)
# Makes a source file that defines `extern const std::string_view SYMBOL` in namespace pbrbake with FILE's text, and
# puts its path into OUTPUT_VARIABLE. Configures again when FILE changes.
function(pbrbake_embed_text output_variable symbol file)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [==[
#include <string_view>
namespace pbrbake {
extern const std::string_view @symbol@;
const std::string_view @symbol@ = R"embedded(@text@)embedded";
}
]==])
    set(${output_variable} ${source} PARENT_SCOPE)
endfunction()
