// Proof of what was kept: both lobes evaluated from the files and from the stored texels.

#include <algorithm>
#include <cmath>

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/difference.hpp"
#include "bakers/texture/material.hpp"
#include "bakers/texture/pack.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::texture {
namespace {

/// One texel of the set as calibrated against the images as stored.
struct Comparison {
    double energy = 0, energy_off = 0, delta = 0, diffuse = 0, f0 = 0;
    bool f0_clamped = false;
};

/// Sums over comparisons.
struct Totals {
    double energy = 0, energy2 = 0, off = 0, off2 = 0, off_energy = 0;
    double delta = 0, delta2 = 0, worst_delta = 0, worst_diffuse = 0, worst_f0 = 0, f0_clamped = 0;
    double texels = 0;

    void add(const Comparison& one) {
        energy += one.energy;
        energy2 += one.energy * one.energy;
        off += one.energy_off;
        off2 += one.energy_off * one.energy_off;
        off_energy += one.energy * one.energy_off;
        delta += one.delta;
        delta2 += one.delta * one.delta;
        worst_delta = std::max(worst_delta, one.delta);
        worst_diffuse = std::max(worst_diffuse, one.diffuse);
        worst_f0 = std::max(worst_f0, one.f0);
        f0_clamped += one.f0_clamped;
        ++texels;
    }

    double energy_error() const { return energy > 0 ? off / energy : 0; }
    /// Variance of a ratio of means (Cochran 1977, "Sampling Techniques", 2.46) over one texel's.
    double energy_error_variance() const {
        const double r = energy_error(), mean = energy / texels;
        const double square = (off2 - 2 * r * off_energy + r * r * energy2) / texels;
        return mean > 0 ? square / (mean * mean) : 0;
    }
    double delta_variance() const { return delta2 / texels - delta * delta / (texels * texels); }
    double clamped_variance() const { return f0_clamped / texels * (1 - f0_clamped / texels); }
};

/// The texels that are compared: all, or one of each stretch of `stride`, drawn by hash. Stretches vary less
/// within than the whole does, so the interval of independent draws is wide enough.
class Sample {
  public:
    Sample(std::uint64_t texels, bool all)
        : texels_(texels), stride_(all ? 1 : std::max<std::uint64_t>(1, texels / kSamples)) {}
    std::uint64_t count() const { return (texels_ + stride_ - 1) / stride_; }
    bool is_all() const { return stride_ == 1; }
    std::uint64_t operator[](std::uint64_t i) const {
        if (stride_ == 1) return i;
        const std::uint64_t length = std::min(stride_, texels_ - i * stride_);
        const double within = pbr::random_unit(kSeed, i) * static_cast<double>(length);
        return i * stride_ + static_cast<std::uint64_t>(within);
    }

  private:
    static constexpr std::uint64_t kSamples = 65536, kSeed = 0x7e87;
    std::uint64_t texels_, stride_;
};

float largest_difference(const Colour& a, const Colour& b) { return pbr::max_channel(glm::abs(a - b)); }

class Comparer {
  public:
    Comparer(const Sources& sources, const Product& product, Context& context)
        : sources_(sources),
          product_(product),
          layout_(layout_of(sources)),
          unit_(product.properties["set"].contains("dielectric_f0_unit")
                    ? product.properties["set"]["dielectric_f0_unit"].get<float>()
                    : 1),
          calibration_(find_calibration(sources, context)),
          scattering_(scattering_of(sources.params())) {}

    bool is_calibrated() const { return calibration_.kind != Calibration::Kind::none; }

    Comparison operator()(std::uint64_t texel) const {
        const auto width = static_cast<std::uint64_t>(sources_.width());
        const auto x = static_cast<int>(texel % width), y = static_cast<int>(texel / width);
        const Unpacked stored = product_.images.empty()
                                    ? factors_from(product_.properties["set"]["factors"], layout_)
                                    : unpack(layout_, product_.images, x, y, unit_, product_.scale);
        const pbr::Reflected<float>& after = stored.reflected;
        LegacyTexel legacy = sources_.texel(x, y);
        const pbr::Reflected<float> before = legacy.reflected = calibration_(legacy.reflected);
        const Albedo truth = source_albedo(sources_, calibration_, legacy);
        const Albedo found = pbr_albedo(after, stored.f90, stored.perceptual_roughness, scattering_);
        Comparison result;
        result.energy = static_cast<double>(pbr::mean_channel(truth.total()));
        result.energy_off = std::abs(static_cast<double>(pbr::mean_channel(found.total())) - result.energy);
        result.delta = delta_e(truth.total(), found.total());
        result.diffuse = static_cast<double>(largest_difference(before.diffuse, after.diffuse));
        result.f0 = static_cast<double>(largest_difference(before.f0, after.f0));
        result.f0_clamped = legacy.f0_clamped;
        return result;
    }

  private:
    const Sources& sources_;
    const Product& product_;
    Layout layout_;
    float unit_;
    Calibration calibration_;
    pbr::Scattering scattering_;
};

/// In texel order, whatever the threads.
Totals compare_all(const Comparer& compare, const Sample& sample, Context& context) {
    constexpr std::int64_t kAtOnce = 4096;
    std::vector<Comparison> some;
    Totals totals;
    const auto count = static_cast<std::int64_t>(sample.count());
    for (std::int64_t start = 0; start < count; start += 64 * kAtOnce) {
        some.resize(static_cast<std::size_t>(std::min(64 * kAtOnce, count - start)));
        context.parallel_for(static_cast<std::int64_t>(some.size()), kAtOnce,
                             [&](std::int64_t begin, std::int64_t end) {
                                 for (std::int64_t i = begin; i < end; ++i)
                                     some[static_cast<std::size_t>(i)] =
                                         compare(sample[static_cast<std::uint64_t>(start + i)]);
                             });
        for (const Comparison& one : some) totals.add(one);
    }
    context.count("certify.texels", sample.count());
    return totals;
}

/// Figures that are measured of all texels, or estimated of a sample: means then have an interval.
class Figures {
  public:
    Figures(const Sample& sample, bool is_calibrated)
        : count_(static_cast<double>(sample.count())),
          is_all_(sample.is_all()),
          of_(std::string(is_all_ ? "all texels" : std::to_string(sample.count()) + " texels drawn by hash") +
              " of the largest level, files" + (is_calibrated ? ", calibrated," : "") +
              " against stored codes") {}

    /// Of a share of texels, `counted`: a rare kind of texel may not have been drawn at all.
    Figure mean(std::string metric, double value, double variance, const std::string& method,
                bool counted = false) const {
        Figure figure{std::move(metric), value, evidence(), method + "; " + of_, {}, {}};
        const double half = 1.96 * std::sqrt(std::max(0., variance) / count_) + (counted ? 3 / count_ : 0);
        if (!is_all_) figure.interval = std::pair(std::max(0., value - half), value + half);
        return figure;
    }

    /// Of a sample: where none of n is beyond, with 95 % confidence at most 3 / n of all are.
    Figure largest(std::string metric, double value, const std::string& method) const {
        const std::string beyond = "; at most " + std::to_string(std::lround(3e6 / count_)) +
                                   " in a million texels are beyond, with 95 % confidence";
        return {std::move(metric), value, evidence(), method + "; " + of_ + (is_all_ ? "" : beyond), {}, {}};
    }

  private:
    Evidence evidence() const { return is_all_ ? Evidence::measured : Evidence::estimate; }
    double count_;
    bool is_all_;
    std::string of_;
};

}  // namespace

Certificate certify(const TextureParams& params, const Inputs& inputs, const Product& product,
                    Context& context) {
    const Sources sources(params, inputs);
    const Comparer compare(sources, product, context);
    const auto texels =
        static_cast<std::uint64_t>(sources.width()) * static_cast<std::uint64_t>(sources.height());
    const Sample sample(texels, context.certify_fully());
    const Totals totals = compare_all(compare, sample, context);
    const Figures figures(sample, compare.is_calibrated());
    Certificate certificate;
    certificate.headline = figures.mean("energy_error", totals.energy_error(), totals.energy_error_variance(),
                                        "mean absolute change of the albedo under an even sky, relative");
    certificate.figures = {
        *certificate.headline,
        figures.mean("delta_e_mean", totals.delta / totals.texels, totals.delta_variance(),
                     "CIE 1976, of that albedo's colour"),
        figures.largest("delta_e_max", totals.worst_delta, "CIE 1976"),
        figures.largest("diffuse_max_error", totals.worst_diffuse, "diffuse albedo, linear"),
        figures.largest("f0_max_error", totals.worst_f0, "linear"),
        figures.mean("f0_clamped", totals.f0_clamped / totals.texels, totals.clamped_variance(),
                     "share of texels whose lobe reflects more than a PBR lobe can", true),
    };
    return certificate;
}

}  // namespace pbrbake::texture
