#include "bakers/verify/study_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "bakers/job/json_text.hpp"
#include "bakers/verify/curve_plot.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/picture.hpp"
#include "bakers/verify/record_html.hpp"
#include "bakers/verify/texture_proof.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/light/colour.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kCrossFace = 16, kBall = 64, kFlat = 64, kSphere = 88;
constexpr std::size_t kMostSteps = 5;
constexpr double kBallPerceptualRoughness = 1. / 3;
constexpr double kLeastDifference = 1e-3, kMostDifference = 1;
constexpr std::array<std::uint8_t, 3> kAround{128, 128, 128};

const glm::dvec3 kAluminium(0.91, 0.92, 0.92);

glm::dvec3 rgb_of(const BakedImage& baked, int level, std::size_t texel) {
    const float* value = baked.image.levels[static_cast<std::size_t>(level)].texels.data() +
                         texel * baked.image.channels.size();
    return glm::dvec3(value[0], value[1], value[2]) / baked.scale;
}

std::size_t texels_of(const BakedImage& baked, int level) {
    return baked.image.levels[static_cast<std::size_t>(level)].texels.size() / baked.image.channels.size();
}

/// The first filtered level that is small enough to unfold.
int shown_level(const Image& cube) {
    int level = 0;
    for (; level + 1 < static_cast<int>(cube.levels.size()); ++level)
        if (level > 0 && cube.levels[static_cast<std::size_t>(level)].width <= kCrossFace) break;
    return level;
}

/// Takes the geometric mean of a level's luminance to middle grey.
double exposure_of(const BakedImage& cube, int level) {
    constexpr double kMiddleGrey = 0.18, kBlack = 1e-12;
    double sum = 0;
    const std::size_t texels = texels_of(cube, level);
    for (std::size_t i = 0; i < texels; ++i)
        sum += std::log(std::max(kBlack, pbr::luminance_of_rgb(rgb_of(cube, level, i))));
    return kMiddleGrey / std::exp(sum / static_cast<double>(texels));
}

/// |a - b| in luminance over b's mean luminance, in false colour on a logarithmic scale, as a cube map.
Image difference_cube(const BakedImage& a, const BakedImage& b, int level) {
    const std::size_t texels = texels_of(b, level);
    double mean = 0;
    for (std::size_t i = 0; i < texels; ++i)
        mean += pbr::luminance_of_rgb(rgb_of(b, level, i)) / static_cast<double>(texels);
    Image cube;
    cube.channels = {"R", "G", "B"};
    cube.faces = 6;
    const Level& like = b.image.levels[static_cast<std::size_t>(level)];
    cube.levels.push_back({like.width, like.height, std::vector<float>(texels * 3)});
    for (std::size_t i = 0; i < texels; ++i) {
        const double share = std::abs(pbr::luminance_of_rgb(rgb_of(a, level, i) - rgb_of(b, level, i))) /
                             std::max(mean, 1e-30);
        const double at = std::log(std::max(share / kLeastDifference, 1e-30)) /
                          std::log(kMostDifference / kLeastDifference);
        const glm::dvec3 colour = linear_of_display(false_colour(at));
        for (int c = 0; c < 3; ++c) cube.levels[0].texels[i * 3 + c] = static_cast<float>(colour[c]);
    }
    return cube;
}

/// An aluminium ball lit by the probe alone, by the split sum.
Picture shaded_ball(const BakedImage& probe, double exposure) {
    constexpr int kViews = 64;
    const double alpha = pbr::alpha_from_perceptual_roughness(kBallPerceptualRoughness);
    static const std::vector<glm::dvec3> reflectance = [alpha] {
        const auto method = pbr::DfgMethod::quadrature(1e-4);
        std::vector<glm::dvec3> list;
        for (int i = 0; i < kViews; ++i) {
            const pbr::DirectionalAlbedo albedo = pbr::dfg_ggx(i / (kViews - 1.0), alpha, method);
            list.push_back(kAluminium * (albedo.E - albedo.Fc) + albedo.Fc);
        }
        return list;
    }();
    const ProbeLookup lookup(probe.image, probe.scale, probe.perceptual_roughness);
    const View view({-0.6, -0.1, -0.8});
    return ball_picture(kBall, view, [&](const glm::dvec3& normal, const glm::dvec3& reflected) {
        const double NoV = std::clamp(-glm::dot(normal, view.forward), 0.0, 1.0);
        return exposure * lookup(reflected, kBallPerceptualRoughness) *
               reflectance[static_cast<std::size_t>(NoV * (kViews - 1) + .5)];
    });
}

/// The first channels as colours, each over its own largest value; every nth texel of what is large.
Picture flat_picture(const BakedImage& flat) {
    const Level& level = flat.image.levels[0];
    const int channels = flat.image.channel_count();
    const int every = std::max(1, (std::max(level.width, level.height) + kFlat - 1) / kFlat);
    std::vector<float> most(static_cast<std::size_t>(channels), 0.f);
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        most[i % most.size()] = std::max(most[i % most.size()], level.texels[i]);
    Picture picture((level.width + every - 1) / every, (level.height + every - 1) / every);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const float* texel = flat.image.texel(0, 0, y * every, x * every);
            glm::dvec3 colour(0);
            for (int c = 0; c < 3; ++c) {
                const int of = std::min(c, channels - 1);
                const bool absent = channels > 1 && c >= channels;
                colour[c] = absent ? 0 : texel[of] / std::max(most[static_cast<std::size_t>(of)], 1e-30f);
            }
            put(picture, x, y, linear_of_display(colour));
        }
    return picture;
}

std::string image(const Picture& picture, int scale, const std::string& alt) {
    return "<img alt=\"" + escaped(alt) + "\" width=" + std::to_string(picture.width * scale) +
           " height=" + std::to_string(picture.height * scale) + " src=\"" + data_uri(picture) + "\">";
}

/// Steps spread over the dial, its ends among them.
bool is_shown(std::size_t step, std::size_t steps) {
    if (steps <= kMostSteps) return true;
    for (std::size_t k = 0; k < kMostSteps; ++k)
        if (step == (k * (steps - 1) + (kMostSteps - 1) / 2) / (kMostSteps - 1)) return true;
    return false;
}

std::size_t step_of(const StudiedCase& studied, std::size_t point) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < point; ++i)
        before += studied.points[i].series == studied.points[point].series;
    return before;
}

}  // namespace

void PictureBook::take(const StudiedCase& studied, const StudyPoint& point, const BakedImage& product,
                       const BakedImage* reference, const run::BakeReport& report) {
    const std::size_t index = studied.points.size() - 1;
    if (!is_shown(step_of(studied, index), studied.asked.series[point.series].steps.size())) return;
    const Key key{studied.asked.name, index};
    if (has_proof(report) && !reference) {
        if (!proofs_.contains(studied.asked.name)) keep_proof(studied.asked.name, report);
        keep(key, before_and_after(report));
    } else if (product.image.levels.empty()) {
        const std::filesystem::path& file = report.writes.front();
        const Json document = job::parse_json(job::read_text(file), file.string());
        const Json::json_pointer of_first("/lights/0/falloff/curve");
        const std::string curve = document.contains(of_first) ? curve_html(document[of_first]) : "";
        if (!curve.empty()) keep(key, {{curve, "stops over distance"}});
    } else if (product.image.is_cube() && reference) {
        const int level = shown_level(reference->image);
        const double exposure = exposure_of(*reference, level);
        keep(key, {{image(cross_picture(product.image, level, exposure / product.scale, kAround), 2,
                          "level unfolded"),
                    "level " + std::to_string(level)},
                   {image(cross_picture(difference_cube(product, *reference, level), 0, 1, kAround), 2,
                          "difference from the reference"),
                    "difference"},
                   {image(shaded_ball(product, exposure), 1, "metal ball"), "ball"}});
    } else if (product.image.faces == 1) {
        keep(key, {{image(flat_picture(product), 1, "the product's channels as colours"), ""}});
    }
}

std::vector<PictureBook::Tile> PictureBook::before_and_after(const run::BakeReport& report) const {
    ReadBackSet set(report, 1);
    const SetSpheres spheres = set_spheres(*set, kSphere, set.context());
    const LinearPicture &before = spheres.aim(), &after = spheres.stored;
    return {{image(display_(as_seen(before)), 1, set->is_calibrated() ? "calibrated" : "legacy"), "before"},
            {image(display_(as_seen(after)), 1, "converted"), "after"},
            {image(sphere_difference(after, before), 1, "difference"), "difference"},
            {"<small>FLIP " + number(sphere_flip(after, before)) + "</small>", ""}};
}

void PictureBook::keep_proof(const std::string& name, const run::BakeReport& report) {
    std::string html = texture_proof_html(report, display_, 1) + texture_reading_html(report);
    if (bytes_ + html.size() > most_bytes_) return;
    bytes_ += html.size();
    proofs_[name] = std::move(html) + warnings_html(report) + "<h3>Certificate</h3>\n" +
                    figures_html(report.entry["certificate"]);
}

std::string PictureBook::proof(const StudiedCase& studied) const {
    const auto found = proofs_.find(studied.asked.name);
    return found == proofs_.end() ? "" : found->second;
}

void PictureBook::keep(const Key& key, std::vector<Tile> tiles) {
    std::size_t size = 0;
    for (const Tile& tile : tiles) size += tile.picture.size();
    if (tiles.empty() || bytes_ + size > most_bytes_) return;
    bytes_ += size;
    tiles_[key] = std::move(tiles);
}

std::string PictureBook::html(const StudiedCase& studied) const {
    std::string rows;
    for (std::size_t s = 0; s < studied.asked.series.size(); ++s) {
        std::string steps;
        for (std::size_t i = 0; i < studied.points.size(); ++i) {
            const auto found = tiles_.find({studied.asked.name, i});
            if (studied.points[i].series != s || found == tiles_.end()) continue;
            steps += "<div class=step><div class=tiles>";
            for (const Tile& tile : found->second) steps += tile.picture;
            steps += "</div><span><b>" + escaped(studied.points[i].step.label) + "</b> error " +
                     number(studied.points[i].error) + ", time " +
                     number(studied.points[i].timing.ratio.value) + "</span></div>";
        }
        if (!steps.empty())
            rows += "<h4>" + escaped(studied.asked.series[s].name) + "</h4><div class=steps>" + steps +
                    "</div>\n";
    }
    return rows;
}

}  // namespace pbrbake::verify
