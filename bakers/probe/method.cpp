#include "bakers/probe/method.hpp"

#include "bakers/probe/chain.hpp"
#include "pbr/ibl/ld_harmonic.hpp"

namespace pbrbake::probe {
namespace {

/// Beyond this degree harmonics take more than a second and half a gigabyte.
constexpr int kMostBands = 3000;

}  // namespace

double error_asked(const Accuracy& accuracy) {
    if (accuracy.stated()) return accuracy.max_error;
    if (accuracy.name == "draft") return 1e-2;
    return accuracy.name == "reference" ? 1e-4 : 1e-3;
}

Method method_of(const ProbeParams& params, const Accuracy& accuracy) {
    const double max_error = error_asked(accuracy);
    if (params.integrator != Integrator::automatic) return {params.integrator, max_error, ""};
    if (params.samples != std::vector<int>{0}) return {Integrator::fis, max_error, "the job gives samples"};
    if (level_count(params) < 2) return {Integrator::harmonic, max_error, "level 0 is not filtered"};
    const int bands = pbr::LdHarmonic::bands_for(alpha_of_level(params, 1), max_error);
    if (bands > kMostBands)
        return {Integrator::fis, max_error,
                "level 1 would need harmonics of degree " + std::to_string(bands) + ", above " +
                    std::to_string(kMostBands)};
    return {Integrator::harmonic, max_error, "harmonics reach the accuracy on every level"};
}

int samples_of_level(const ProbeParams& params, const Accuracy& accuracy, int level) {
    const int given =
        params.samples.size() == 1 ? params.samples[0] : params.samples[static_cast<std::size_t>(level)];
    if (given > 0) return given;
    const double error = error_asked(accuracy);
    return error >= 1e-2 ? 256 : error >= 1e-3 ? 1024 : 4096;
}

}  // namespace pbrbake::probe
