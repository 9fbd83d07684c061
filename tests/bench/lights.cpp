// Photometric units, colour temperature, punctual lights, sun and exposure: nanoseconds an evaluation.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "pbr/camera/exposure.hpp"
#include "pbr/light/colour_temperature.hpp"
#include "pbr/light/luminous_efficacy.hpp"
#include "pbr/light/punctual.hpp"
#include "pbr/light/sun.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/numerics/sequence.hpp"

namespace {

constexpr int kInputs = 256;

/// 256 numbers uniform in [low, high), so that no evaluation is hoisted out of the loop.
template <class T>
std::array<T, kInputs> inputs(double low, double high) {
    std::array<T, kInputs> values;
    for (int i = 0; i < kInputs; ++i) values[i] = static_cast<T>(low + (high - low) * pbr::random_unit(1, i));
    return values;
}

/// Time of f(input); the input changes from one evaluation to the next.
template <class T>
void run(benchmark::State& state, double low, double high, const auto& f) {
    const auto values = inputs<T>(low, high);
    int i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(f(values[i++ % kInputs]));
}

void LuminanceFromPower(benchmark::State& state) {
    run<float>(state, 1, 2, [](float r) {
        return pbr::luminance_from_power(pbr::Lumens<float>(1000), pbr::emitter_tube(r, 1.0f)).value();
    });
}
BENCHMARK(LuminanceFromPower);

void PointIlluminance(benchmark::State& state) {
    run<float>(state, .1, 9, [](float d) {
        const pbr::Vec3<float> to_light(d, 1, 2), normal(0, 0, 1);
        return pbr::illuminance_of_point(pbr::Candelas<float>(100), to_light, normal, 10.0f).value();
    });
}
BENCHMARK(PointIlluminance);

void SpotIlluminance(benchmark::State& state) {
    const auto cone = pbr::spot_cone(.3f, .5f);
    run<float>(state, .1, 9, [&](float d) {
        const pbr::Vec3<float> to_light(d, 1, 2), normal(0, 0, 1), axis(0, 0, -1);
        return pbr::illuminance_of_spot(pbr::Candelas<float>(100), axis, cone, to_light, normal, 10.0f)
            .value();
    });
}
BENCHMARK(SpotIlluminance);

void NearestDirectionOfSun(benchmark::State& state) {
    const float half_angle = static_cast<float>(pbr::kSunHalfAngle_rad);
    run<float>(state, 0, .01, [&](float angle) {
        const pbr::Vec3<float> R(angle, 0, std::sqrt(1 - angle * angle)), centre(0, 0, 1);
        return pbr::nearest_direction_of_disk(R, centre, half_angle);
    });
}
BENCHMARK(NearestDirectionOfSun);

void ExposureBySaturation(benchmark::State& state) {
    run<float>(state, -5, 16, [](float ev) { return pbr::exposure_by_saturation(pbr::Ev100<float>(ev)); });
}
BENCHMARK(ExposureBySaturation);

void AutoExposure(benchmark::State& state) {
    const pbr::AutoExposure<float> settings{pbr::Stops<float>(1), pbr::Ev100<float>(-2),
                                            pbr::Ev100<float>(16)};
    run<float>(state, 0, 1e4,
               [&](float nit) { return pbr::auto_ev100(pbr::Nits<float>(nit), settings).value(); });
}
BENCHMARK(AutoExposure);

void PlanckianChromaticity(benchmark::State& state) {
    run<double>(state, 1000, 15'000, [](double kelvin) { return pbr::planckian_chromaticity(kelvin).x; });
}
BENCHMARK(PlanckianChromaticity);

void RgbFromTemperature(benchmark::State& state) {
    run<double>(state, 1000, 15'000, [](double kelvin) { return pbr::rgb_from_temperature(kelvin); });
}
BENCHMARK(RgbFromTemperature);

/// The fit for run time, against PlanckianChromaticity.
void PlanckianKrystek(benchmark::State& state) {
    run<float>(state, 1000, 15'000, [](float kelvin) { return pbr::planckian_uv_krystek(kelvin); });
}
BENCHMARK(PlanckianKrystek);

void CorrelatedTemperature(benchmark::State& state) {
    run<double>(state, .3, .4, [](double x) { return pbr::correlated_temperature({x, x}).temperature_k; });
}
BENCHMARK(CorrelatedTemperature);

void EfficacyOfBlackBody(benchmark::State& state) {
    run<double>(state, 1000, 15'000,
                [](double kelvin) { return pbr::efficacy_of_black_body(kelvin).value(); });
}
BENCHMARK(EfficacyOfBlackBody);

}  // namespace
