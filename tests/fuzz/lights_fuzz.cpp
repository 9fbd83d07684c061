// Any bytes as a file of lights: finite photometric lights, or an error.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "bakers/light/convert.hpp"

namespace {

void expect(bool holds) {
    if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pbrbake;
    constexpr std::size_t kMost = 4;  // fits take a millisecond
    try {
        const parse::LightFile file =
            parse::parse_lights({reinterpret_cast<const std::byte*>(data), size}, "fuzz");
        const light::LightParams params{};
        for (std::size_t i = 0; i < std::min(file.lights.size(), kMost); ++i) {
            const light::ConvertedLight light = light::convert(
                file.lights[i], file.up, {100, file.unit_m, 683, .1}, params, light::Fits::made);
            expect(std::isfinite(light.illuminance_lx) && light.illuminance_lx >= 0);
            if (!light.fit) continue;
            expect(std::isfinite(light.fit->light.intensity) && light.fit->light.intensity >= 0);
            expect(std::isfinite(light.fit->light.radius) && std::isfinite(light.fit->error.rms));
        }
    } catch (const Error& error) {
        expect(error.code() == ExitCode::unreadable_input && !error.message().empty());
    }
    return 0;
}
