#include "bakers/io/display.hpp"

#include <algorithm>

#include "bakers/error.hpp"
#include "bakers/io/colour.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {

void to_display(std::string_view working_space, std::span<float> rgb) {
    const auto gamut = working_gamut(working_space);
    std::string error = "no working space";
    if (!gamut || !ocio_module().display(*gamut, rgb.data(), rgb.size() / 3, error))
        throw Error(ExitCode::unreadable_input, std::string(working_space),
                    "colours could not be brought to a display: " + error);
    for (float& value : rgb) value = std::clamp(value, 0.f, 1.f);
}

}  // namespace pbrbake::io
