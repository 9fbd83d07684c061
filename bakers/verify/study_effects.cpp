// Times and counts effects. The inputs are many random directions, so that nothing is predicted or folded.

#include "bakers/verify/study_effects.hpp"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "bakers/job/job.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/verify/study_job.hpp"
#include "pbr/brdf/material.hpp"
#include "pbr/brdf/material_effects.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/ibl/distance_roughness.hpp"
#include "pbr/ibl/dominant_direction.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/parallax.hpp"
#include "pbr/ibl/specular_occlusion.hpp"
#include "pbr/light/area_specular.hpp"
#include "pbr/light/disk_light.hpp"
#include "pbr/light/punctual.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/tube_light.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::verify {
namespace {

using pbr::Vec3;

constexpr std::size_t kInputs = 1024;
constexpr pbr::StandardMaterial<float> kPaint{{.7f, .3f, .2f}, .5f, 0, .5f};

/// A group whose rows are still to be timed.
struct Unmeasured {
    EffectGroup group;
    std::vector<std::function<double(int)>> costs;

    void add(EffectCost row, std::function<double(int)> cost) {
        group.rows.push_back(std::move(row));
        costs.push_back(std::move(cost));
    }
};

Vec3<float> direction(std::uint64_t stream, std::uint64_t i) {
    const double z = .01 + .99 * pbr::random_unit(stream, i), s = std::sqrt(1 - z * z);
    const pbr::SinCos phi = pbr::sin_cos_pi(2 * pbr::random_unit(stream + 1, i));
    return Vec3<float>(s * phi.cos, s * phi.sin, z);
}

struct Pair {
    Vec3<float> wo, wi;
};

const std::vector<Pair>& pairs() {
    static const std::vector<Pair> all = [] {
        std::vector<Pair> list;
        for (std::uint64_t i = 0; i < kInputs; ++i) list.push_back({direction(1, i), direction(3, i)});
        return list;
    }();
    return all;
}

float component_sum(float value) { return value; }
float component_sum(const Vec3<float>& value) { return value.x + value.y + value.z; }

/// CPU seconds of one evaluation of f(pair): of `times` and more, over all pairs in turn.
template <class F>
std::function<double(int)> over_pairs(F f) {
    return [f](int times) {
        const int rounds = (times + static_cast<int>(kInputs) - 1) / static_cast<int>(kInputs);
        const run::Stopwatch watch;
        float sum = 0;
        for (int round = 0; round < rounds; ++round)
            for (const Pair& pair : pairs()) sum += component_sum(f(pair));
        [[maybe_unused]] static volatile float kept;
        kept = sum;  // so that nothing is left out
        return watch.elapsed().cpu / rounds / kInputs;
    };
}

// --- materials
// ------------------------------------------------------------------------------------------------

/// E over cosine and perceptual roughness, bilinear, as a renderer on the CPU would have it; counts its
/// look-ups where it is given a counter.
class TableE {
  public:
    TableE() {
        const auto method = pbr::DfgMethod::quadrature(1e-4);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                E_.push_back(static_cast<float>(
                    pbr::dfg_ggx(x / (kSize - 1.0), std::pow(std::max(y, 1) / (kSize - 1.0), 2), method).E));
    }
    float at(float NoV, float alpha) const {
        const float x = NoV * (kSize - 1), y = std::sqrt(alpha) * (kSize - 1);
        const int i = std::min(static_cast<int>(x), kSize - 2), j = std::min(static_cast<int>(y), kSize - 2);
        const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
        const float* row = E_.data() + j * kSize + i;
        return (row[0] * (1 - u) + row[1] * u) * (1 - v) + (row[kSize] * (1 - u) + row[kSize + 1] * u) * v;
    }

  private:
    static constexpr int kSize = 32;
    std::vector<float> E_;
};

const TableE& table_E() {
    static const TableE table;
    return table;
}

struct LookUp {
    float operator()(float cosine, float alpha) const { return table_E().at(cosine, alpha); }
};

struct CountedLookUp {
    std::uint64_t* count;
    float operator()(float cosine, float alpha) const {
        ++*count;
        return table_E().at(cosine, alpha);
    }
};

/// A material's row: timed as it is, its look-ups counted in a twin that counts.
template <class Plain, class Counted>
void add_material(Unmeasured& group, const std::string& name, const Plain& material, const Counted& twin,
                  const std::uint64_t& look_ups) {
    EffectCost row{name, {}, {{"f", 1}}, sizeof(Plain), true};
    const std::uint64_t before = look_ups;
    (void)twin.f(pairs()[0].wo, pairs()[0].wi);
    if (look_ups > before) row.evaluations["albedo look-ups"] = look_ups - before;
    group.add(std::move(row),
              over_pairs([material](const Pair& pair) { return material.f(pair.wo, pair.wi); }));
}

template <class... Effects>
void add_material(Unmeasured& group, const std::string& name, const Effects&... effects) {
    const pbr::Material<float, Effects...> material(kPaint, effects...);
    add_material(group, name, material, material, std::uint64_t{0});
}

Unmeasured material_group() {
    Unmeasured group{{"A material: f(wo, wi) in float", "evaluation", {}}, {}};
    static std::uint64_t counted = 0;
    const LookUp E;
    const CountedLookUp counting{&counted};
    const auto E_avg = static_cast<float>(pbr::average_albedo_ggx(.25));
    const Vec3<float> sheen(.5f);
    add_material(group, "none: the standard material");
    add_material(group, "clear coat", pbr::ClearCoat<float>{1, .01f});
    add_material(group, "cloth", pbr::Material(kPaint, pbr::Cloth<float, LookUp>{sheen, .3f, E}),
                 pbr::Material(kPaint, pbr::Cloth<float, CountedLookUp>{sheen, .3f, counting}), counted);
    add_material(group, "anisotropy", pbr::Anisotropy<float>{.6f});
    add_material(group, "energy compensation",
                 pbr::Material(kPaint, pbr::EnergyCompensation<float, LookUp>{E}),
                 pbr::Material(kPaint, pbr::EnergyCompensation<float, CountedLookUp>{counting}), counted);
    add_material(
        group, "multiple scattering", pbr::Material(kPaint, pbr::MultipleScattering<float, LookUp>{E, E_avg}),
        pbr::Material(kPaint, pbr::MultipleScattering<float, CountedLookUp>{counting, E_avg}), counted);
    add_material(group, "Lambert instead of Disney", pbr::LambertDiffuse<float>{});
    add_material(group, "EON instead of Disney", pbr::EonDiffuse<float>{.5f});
    add_material(group, "Chan instead of Disney", pbr::ChanDiffuse<float>{});
    add_material(group, "Hammon instead of Disney", pbr::HammonDiffuse<float>{});
    return group;
}

// --- lights
// ---------------------------------------------------------------------------------------------------

template <class F>
void add_call(Unmeasured& group, const std::string& name, const char* counted, const F& f) {
    group.add({name, {}, {{counted, 1}}, 0, true}, over_pairs(f));
}

Unmeasured light_group() {
    Unmeasured group{{"A light: illuminance of a point", "evaluation", {}}, {}};
    const auto point = [](const Pair& pair) {
        return pbr::illuminance_of_point(pbr::Candelas<float>(100), 2.f * pair.wi, pair.wo, 10.f).value();
    };
    add_call(group, "none: a point light", "light", point);
    add_call(group, "spot cone", "light", [cone = pbr::spot_cone(.3f, .5f)](const Pair& pair) {
        const Vec3<float> axis(0, 0, -1);
        return pbr::illuminance_of_spot(pbr::Candelas<float>(100), axis, cone, 2.f * pair.wi, pair.wo, 10.f)
            .value();
    });
    const auto area = [&group](const std::string& name, const auto& light) {
        add_call(group, name, "light", [light](const Pair& pair) {
            return static_cast<float>(
                pbr::projected_solid_angle(light, 2.0 * Vec3<double>(pair.wi), -Vec3<double>(pair.wo)));
        });
    };
    area("sphere", pbr::SphereLight<double>{Vec3<double>(0), .5});
    area("disk", pbr::DiskLight<double>{Vec3<double>(0), {0, 0, 1}, .5, pbr::Emission::one_sided});
    area("rectangle",
         pbr::RectangleLight<double>{Vec3<double>(0), {.5, 0, 0}, {0, .5, 0}, pbr::Emission::one_sided});
    area("tube", pbr::TubeLight<double>{{-.5, 0, 0}, {.5, 0, 0}, .1});
    return group;
}

// --- probes at run time
// ---------------------------------------------------------------------------------------

Unmeasured probe_group() {
    Unmeasured group{{"A probe: one look-up", "evaluation", {}}, {}};
    constexpr int kSize = 64;
    std::vector<float> texels(std::size_t{kSize} * kSize * 18);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(pbr::random_unit(5, i));
    const auto pyramid = std::make_shared<const pbr::CubePyramid>(texels, kSize);
    const auto read = [pyramid](const Vec3<float>& towards, float perceptual_roughness) {
        return Vec3<float>(pyramid->sample(towards, 4 * perceptual_roughness));
    };
    const Vec3<float> N(0, 0, 1);
    const pbr::OrientedBox<float> box{Vec3<float>(0), pbr::OrientedBox<float>{}.axes, Vec3<float>(4, 3, 5)};
    const pbr::ProxySphere<float> sphere{Vec3<float>(0), 4};
    const auto corrected = [read](const auto& proxy) {
        return [read, proxy](const Pair& pair) {
            const auto found = pbr::parallax_corrected(proxy, Vec3<float>(0), pair.wo, pair.wi);
            return read(found.direction, .5f);
        };
    };
    add_call(group, "none: the mirror direction", "look-up",
             [read](const Pair& pair) { return read(pair.wi, .5f); });
    add_call(group, "dominant direction", "look-up", [read, N](const Pair& pair) {
        const float factor = pbr::dominant_factor_frostbite(.25f);
        return read(pbr::dominant_direction(N, pair.wi, factor), .5f);
    });
    add_call(group, "parallax, box", "look-up", corrected(box));
    add_call(group, "parallax, sphere", "look-up", corrected(sphere));
    add_call(group, "distance-based roughness", "look-up", [read](const Pair& pair) {
        return read(pair.wi, pbr::distance_based_perceptual_roughness(pair.wo.z, 1.f, .5f));
    });
    add_call(group, "specular occlusion", "look-up", [read](const Pair& pair) {
        return pbr::specular_occlusion_frostbite(pair.wo.z, .7f, .25f) * read(pair.wi, .5f);
    });
    return group;
}

// --- tables
// ---------------------------------------------------------------------------------------------------

/// Whether the channels of `off` stand in `on` unchanged.
bool keeps_channels(const BakedImage& off, const BakedImage& on) {
    const std::size_t few = off.image.channels.size(), many = on.image.channels.size();
    const std::vector<float>&a = off.image.levels[0].texels, &b = on.image.levels[0].texels;
    for (std::size_t c = 0; c < few; ++c) {
        std::size_t there = 0;
        while (there < many && on.image.channels[there] != off.image.channels[c]) ++there;
        if (there == many || off.scale != on.scale || a.size() / few != b.size() / many) return false;
        for (std::size_t i = 0; i < a.size() / few; ++i)
            if (a[i * few + c] != b[i * many + there]) return false;
    }
    return true;
}

/// A job of a table of 64 x 64 with these terms; null if they can't stand together.
std::shared_ptr<const job::Job> table_job(const Json& terms, const std::filesystem::path& folder) {
    try {
        return std::make_shared<const job::Job>(single_bake_job(
            Json::object(), {{"kind", "dfg"}, {"size", 64}, {"terms", terms}, {"certify", "none"}},
            "effect_" + terms.back().get<std::string>(), folder));
    } catch (const job::JobError&) {
        return nullptr;
    }
}

void add_table(Unmeasured& group, const std::string& name, const std::shared_ptr<const job::Job>& job,
               const StudyOptions& options, std::optional<BakedImage>& without) {
    run::Options run_options;
    run_options.threads = options.threads;
    run_options.cancel = options.cancel;
    const run::BakeReport report = run::run_bake(*job, job->bakes.front(), run_options);
    if (report.status == run::Status::interrupted) throw Cancelled{};
    if (report.status == run::Status::failed) throw Error(report.code, "", report.error);
    EffectCost row{name, {}, report.bake_evaluations, 0, true};
    for (const Json& output : report.entry["outputs"]) row.bytes += output["bytes"].get<std::uint64_t>();
    const BakedImage product = read_baked(report);
    if (!without) without = product;
    if (row.evaluations.contains("ggx")) row.rest_unchanged = keeps_channels(*without, product);
    group.add(std::move(row), [job](int times) {
        double cpu = 0;
        for (int i = 0; i < times; ++i) cpu += run::time_bake_stage(job->bakes.front(), {}, {}).cpu;
        return cpu / times;
    });
}

/// Tables of "ggx" alone and with each other term; a term that has axes of its own stands alone.
Unmeasured table_group(const StudyOptions& options) {
    Unmeasured group{{"A table of 64 x 64: terms", "bake", {}}, {}};
    std::optional<BakedImage> without;
    add_table(group, "none: ggx alone", table_job({"ggx"}, options.folder), options, without);
    for (const Json& term :
         job::job_schema().root()["definitions"]["dfg"]["properties"]["terms"]["items"]["enum"]) {
        if (term == "ggx") continue;
        if (const auto beside = table_job({"ggx", term}, options.folder))
            add_table(group, term.get<std::string>(), beside, options, without);
        else if (const auto alone = table_job(Json::array({term}), options.folder))
            add_table(group, term.get<std::string>() + ", its own table", alone, options, without);
    }
    return group;
}

}  // namespace

std::vector<EffectGroup> study_effects(const StudyOptions& options) {
    std::vector<Unmeasured> groups;
    groups.push_back(material_group());
    groups.push_back(light_group());
    groups.push_back(probe_group());
    groups.push_back(table_group(options));
    std::vector<RepeatTask> tasks;
    for (const Unmeasured& group : groups) {
        const std::size_t base = tasks.size();
        for (const auto& cost : group.costs)
            tasks.push_back({[&cost, &options](int times) {
                                 if (options.cancel && options.cancel->load()) throw Cancelled{};
                                 return cost(times);
                             },
                             base});
    }
    const auto wall_s = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    const std::vector<Timing> timings = repeat_until_known(tasks, options.limits, wall_s);
    std::vector<EffectGroup> measured;
    std::size_t at = 0;
    for (Unmeasured& group : groups) {
        for (EffectCost& row : group.group.rows) row.timing = timings[at++];
        measured.push_back(std::move(group.group));
    }
    return measured;
}

}  // namespace pbrbake::verify
