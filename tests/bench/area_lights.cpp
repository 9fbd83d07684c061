// Area lights, ns an evaluation: the exact projected solid angle beside the approximations.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "pbr/light/area_specular.hpp"
#include "pbr/light/disk_light.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/rectangle_sampling.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/tube_light.hpp"
#include "pbr/numerics/sequence.hpp"

namespace {

using Vec = pbr::Vec3<double>;

struct Receiver {
    Vec p, n;
};

/// Receivers in front of the lights below, at one to three units, turned so that a third has the light across
/// its horizon.
std::array<Receiver, 256> receivers() {
    std::array<Receiver, 256> all;
    for (int i = 0; i < 256; ++i) {
        const auto u = [&](int k) { return pbr::random_unit(1, i, k); };
        const Vec up = glm::normalize(Vec(2 * u(0) - 1, 2 * u(1) - 1, 1));
        all[i] = {(1 + 2 * u(2)) * up, glm::normalize(Vec(2 * u(3) - 1, 2 * u(4) - 1, -u(5)))};
    }
    return all;
}

const pbr::SphereLight<double> kSphere{Vec(0), 0.5};
const pbr::DiskLight<double> kDisk{Vec(0), {0, 0, 1}, 0.5, pbr::Emission::one_sided};
const pbr::RectangleLight<double> kRectangle{Vec(0), {0.5, 0, 0}, {0, 0.5, 0}, pbr::Emission::one_sided};
const pbr::TubeLight<double> kTube{{-0.5, 0, 0}, {0.5, 0, 0}, 0.1};

template <class F>
void each_receiver(benchmark::State& state, const F& f) {
    const auto all = receivers();
    int i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(f(all[i].p, all[i].n));
        i = (i + 1) % 256;
    }
}

#define PBR_AREA_LIGHT_BENCHMARK(name, ...)                                                            \
    void name(benchmark::State& state) {                                                               \
        each_receiver(state, [](const Vec& p, [[maybe_unused]] const Vec& n) { return __VA_ARGS__; }); \
    }                                                                                                  \
    BENCHMARK(name)

PBR_AREA_LIGHT_BENCHMARK(SphereProjectedSolidAngle, pbr::projected_solid_angle(kSphere, p, n));
PBR_AREA_LIGHT_BENCHMARK(DiskProjectedSolidAngle, pbr::projected_solid_angle(kDisk, p, n));
PBR_AREA_LIGHT_BENCHMARK(DiskProjectedSolidAngleFrostbite, pbr::projected_solid_angle_frostbite(kDisk, p, n));
PBR_AREA_LIGHT_BENCHMARK(DiskSolidAngle, pbr::solid_angle(kDisk, p));
PBR_AREA_LIGHT_BENCHMARK(RectangleProjectedSolidAngle, pbr::projected_solid_angle(kRectangle, p, n));
PBR_AREA_LIGHT_BENCHMARK(RectangleProjectedSolidAngleStructured,
                         pbr::projected_solid_angle_structured(kRectangle, p, n));
PBR_AREA_LIGHT_BENCHMARK(RectangleProjectedSolidAngleMrp, pbr::projected_solid_angle_mrp(kRectangle, p, n));
PBR_AREA_LIGHT_BENCHMARK(RectangleSolidAngle, pbr::solid_angle(kRectangle, p));
PBR_AREA_LIGHT_BENCHMARK(RectangleSample, pbr::sample_rectangle_light(kRectangle, p, 0.3, 0.7));
PBR_AREA_LIGHT_BENCHMARK(TubeProjectedSolidAngle, pbr::projected_solid_angle(kTube, p, n));
PBR_AREA_LIGHT_BENCHMARK(TubeProjectedSolidAngleStructured,
                         pbr::projected_solid_angle_structured(kTube, p, n));
PBR_AREA_LIGHT_BENCHMARK(SphereReflectedLuminanceMrp,
                         pbr::reflected_luminance_mrp(kSphere,
                                                      pbr::SpecularSurface<double>{p, n, n, 0.25, 0.04}, n,
                                                      pbr::kShaderWidening));

#undef PBR_AREA_LIGHT_BENCHMARK

}  // namespace
