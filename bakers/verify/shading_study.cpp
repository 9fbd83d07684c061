#include "bakers/verify/shading_study.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/registry.hpp"
#include "bakers/verify/display_transform.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/shaded_truth.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kShrink = 8;  // texels of the built-in to one of the study's, along a side
constexpr std::array<double, 4> kPerceptualRoughness{0.2, 0.4, 0.6, 0.8};
constexpr double kLeastShown = 1e-2, kMostShown = 1;  // relative errors at which colours end

struct Material {
    const char* name;
    const char* title;
    pbr::StandardMaterial<double> authored;  ///< smoothness apart
    bool on_plane;
};
const std::array<Material, 2> kMaterials{{{"gold", "Gold", {{1, 0.77, 0.34}, 0, 1, 0.5}, true},
                                          {"paint", "Red paint", {{0.5, 0.06, 0.04}, 0, 0, 0.5}, false}}};

pbr::Surface<double> surface_of(const Material& material, double perceptual_roughness) {
    pbr::StandardMaterial<double> authored = material.authored;
    authored.smoothness = 1 - perceptual_roughness;
    return pbr::surface_from_material(authored);
}

const EnvironmentLook& look_of(const std::string& name) {
    const auto& looks = environment_looks();
    return *std::ranges::find(looks, name, &EnvironmentLook::name);
}

std::string image_html(const Picture& picture, const std::string& alt) {
    return "<img style=\"width:100%;image-rendering:pixelated;border-radius:0\" alt=\"" + escaped(alt) +
           "\" width=" + std::to_string(picture.width) + " height=" + std::to_string(picture.height) +
           " src=\"" + data_uri(picture) + "\">";
}

/// What lies behind a scene.
const glm::dvec3 kBackground(0.2);

LinearPicture exposed(LinearPicture linear, double exposure) {
    for (glm::dvec3& rgb : linear.rgb) rgb *= exposure;
    return linear;
}

/// The camera's picture before a plain background.
Picture seen(const LinearPicture& linear, const ShadedScene& scene, double exposure,
             const DisplayTransform& display) {
    Picture picture = display(exposed(linear, exposure));
    for (int y = 0; y < linear.height; ++y)
        for (int x = 0; x < linear.width; ++x)
            if (!scene.points[static_cast<std::size_t>(y) * linear.width + x])
                put(picture, x, y, kBackground);
    return picture;
}

/// |a - exact| over exact, the largest channel's, in false colour on a logarithmic scale.
Picture error_picture(const LinearPicture& a, const LinearPicture& exact, const ShadedScene& scene) {
    Picture picture(a.width, a.height);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (!scene.points[static_cast<std::size_t>(y) * a.width + x]) {
                put(picture, x, y, kBackground);
                continue;
            }
            double worst = 0;
            for (int c = 0; c < 3; ++c)
                if (exact.at(x, y)[c] > 0)
                    worst = std::max(worst, std::abs(a.at(x, y)[c] / exact.at(x, y)[c] - 1));
            const glm::dvec3 colour = 255.0 * false_colour(std::log(std::max(worst / kLeastShown, 1.0)) /
                                                           std::log(kMostShown / kLeastShown));
            for (int c = 0; c < 3; ++c)
                picture.pixel(x, y)[c] = static_cast<std::uint8_t>(std::lround(colour[c]));
        }
    return picture;
}

/// One surface in one scene, shaded in all ways.
struct Shaded {
    double perceptual_roughness;
    std::vector<LinearPicture> pictures;            ///< by Shading
    std::vector<std::vector<ShadingError>> errors;  ///< by Shading; the exact's own are zeros
    std::vector<double> flip;                       ///< mean LDR-FLIP at the camera's exposure
};

class ShadingPage {
  public:
    ShadingPage(const ShadingStudy& study, const Image& environment, const BakedImage& probe,
                const BakedImage& table)
        : study_(study),
          look_(look_of(study.environment)),
          truth_(environment.levels.front(), probe, table) {}

    std::string html(Json& figures) const {
        std::string body = introduction();
        figures = {{"version", 1}, {"environment", study_.environment}, {"scenes", Json::array()}};
        for (const Material& material : kMaterials) {
            body += scene_html(material, "spheres", sphere_scene(study_.size, look_.camera), figures);
            if (material.on_plane)
                body += scene_html(material, "a plane at grazing view",
                                   plane_scene(2 * study_.size, study_.size, -look_.camera), figures);
        }
        return page("pbrbake study --shading", body + reading());
    }

  private:
    std::string introduction() const {
        return "<h1>What the split sum loses</h1>\n<p class=lead>Each material by the exact integral over "
               "the "
               "environment, and by one look-up of the baked probe and table: along the mirror direction, "
               "and along "
               "Frostbite's dominant direction.</p>\n<p>" +
               look_.title + ": " + look_.description +
               " Here by means over 8 × 8 texels, for the exact integral as for the probe. Camera at EV100 " +
               number(look_.ev100) + ", exposed by saturation; pictures go through " + display_.name() +
               ". FLIP is of the exposed values before that.</p>\n";
    }

    Shaded shaded(const Material& material, double perceptual_roughness, const ShadedScene& scene) const {
        const pbr::Surface<double> surface = surface_of(material, perceptual_roughness);
        Shaded result{perceptual_roughness, {}, {}, {}};
        const double exposure = exposure_of_ev100(look_.ev100);
        for (const Shading shading : {Shading::exact, Shading::split_sum, Shading::split_sum_dominant}) {
            result.pictures.push_back(truth_.render(shading, surface, scene, study_.threads));
            result.errors.push_back(shading_errors(result.pictures.back(), result.pictures.front(), scene));
            result.flip.push_back(ldr_flip(exposed(result.pictures.front(), exposure),
                                           exposed(result.pictures.back(), exposure))
                                      .mean());
        }
        return result;
    }

    std::string scene_html(const Material& material, const std::string& what, const ShadedScene& scene,
                           Json& figures) const {
        std::vector<Shaded> shaded_all;
        for (const double perceptual_roughness : kPerceptualRoughness) {
            shaded_all.push_back(shaded(material, perceptual_roughness, scene));
            add_figures(material, what, shaded_all.back(), figures);
        }
        return "<h2>" + std::string(material.title) + ", " + what + "</h2>\n" + pictures(shaded_all, scene) +
               table(shaded_all);
    }

    std::string pictures(const std::vector<Shaded>& all, const ShadedScene& scene) const {
        const double exposure = exposure_of_ev100(look_.ev100);
        std::string html = "<div class=wide><div class=balls style=\"grid-template-columns:108px repeat(" +
                           std::to_string(all.size()) + ",1fr)\"><span></span>";
        for (const Shaded& shaded : all)
            html +=
                "<span class=head>perceptual roughness " + number(shaded.perceptual_roughness) + "</span>";
        for (std::size_t i = 0; i < kShadingNames.size(); ++i) {
            html += "<span class=row><b>" + std::string(kTitles[i]) + "</b></span>";
            for (const Shaded& shaded : all)
                html += image_html(seen(shaded.pictures[i], scene, exposure, display_), kTitles[i]);
        }
        for (std::size_t i = 1; i < kShadingNames.size(); ++i) {
            html += "<span class=row><b>error</b>" + std::string(kTitles[i]) + "</span>";
            for (const Shaded& shaded : all)
                html += image_html(error_picture(shaded.pictures[i], shaded.pictures.front(), scene),
                                   std::string("error, ") + kTitles[i]);
        }
        return html + "</div></div>\n" +
               false_colour_scale(percent(kLeastShown) + " or less", percent(kMostShown) + " or more");
    }

    static std::string table(const std::vector<Shaded>& all) {
        Table table({"perceptual roughness", "shading", "NoV below .1", ".1 to .3", ".3 to .6", "above .6",
                     "all", "bias, all", "FLIP"});
        table.set_text(1);
        for (const Shaded& shaded : all)
            for (std::size_t i = 1; i < kShadingNames.size(); ++i) {
                std::vector<std::string> cells{number(shaded.perceptual_roughness), kTitles[i]};
                for (const ShadingError& error : shaded.errors[i])
                    cells.push_back(error.points ? percent(error.relative_rms) : "–");
                cells.push_back(percent(shaded.errors[i].back().bias));
                cells.push_back(number(shaded.flip[i]));
                table.add(cells);
            }
        return "<p class=soft>Root mean square error of luminance over its mean, by the cosine of the "
               "view.</p>\n" +
               table.html();
    }

    static void add_figures(const Material& material, const std::string& what, const Shaded& shaded,
                            Json& figures) {
        for (std::size_t i = 1; i < kShadingNames.size(); ++i) {
            Json errors = Json::array();
            for (const ShadingError& error : shaded.errors[i])
                errors.push_back({{"NoV", {error.low, std::min(error.high, 1.0)}},
                                  {"points", error.points},
                                  {"relative_rms", error.relative_rms},
                                  {"bias", error.bias}});
            figures["scenes"].push_back({{"material", material.name},
                                         {"scene", what},
                                         {"perceptual_roughness", shaded.perceptual_roughness},
                                         {"shading", kShadingNames[i]},
                                         {"errors", std::move(errors)},
                                         {"flip", shaded.flip[i]}});
        }
    }

    static std::string reading() {
        return "<h2>How to read this</h2>\n<p>The probe holds the lobe as it is seen along the normal, round "
               "about the "
               "mirror direction. Seen at grazing angles the true lobe is long and narrow and leans away "
               "from the mirror "
               "direction: highlights on the plane are drawn out towards the viewer. The split sum keeps "
               "them round, "
               "with either direction: that loss is what the columns of small NoV show, and no look-up of "
               "one level "
               "takes it back. The dominant direction moves the look-up to where most of a rough lobe is, "
               "which helps "
               "where the environment changes across the lobe, and can do harm where it "
               "doesn't.</p>\n<p>Both sides have "
               "the same materials, scattered once: GGX with height-correlated Smith, Schlick's Fresnel, "
               "Disney's "
               "diffuse as Frostbite renormalised it. The exact integral is within a thousandth of its own "
               "scale. What "
               "probe, table and bilinear look-ups are off by is part of the split sum's error.</p>\n";
    }

    static constexpr std::array<const char*, 3> kTitles{"exact integral", "split sum",
                                                        "split sum, dominant direction"};

    const ShadingStudy& study_;
    const EnvironmentLook& look_;
    ShadedTruth truth_;
    DisplayTransform display_;
};

}  // namespace

Image study_environment(const std::string& name) {
    const SourceImage source = find_baker("probe")->builtin(name);
    const Level& from = source.image.levels.front();
    Image image;
    image.channels = {"R", "G", "B"};
    const int width = from.width / kShrink, height = from.height / kShrink;
    image.levels.push_back({width, height, std::vector<float>(static_cast<std::size_t>(width) * height * 3)});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int k = 0; k < kShrink * kShrink; ++k)
                    sum += source.image.texel(0, 0, y * kShrink + k / kShrink, x * kShrink + k % kShrink)[c];
                image.texel(0, 0, y, x)[c] = static_cast<float>(sum / (kShrink * kShrink));
            }
    return image;
}

std::string study_environment_file(const ShadingStudy& study) { return study.environment + ".exr"; }

Json shading_job(const ShadingStudy& study) {
    return {{"version", 1},
            {"output", "."},
            {"accuracy", "production"},
            {"bakes",
             {{{"kind", "dfg"}, {"name", "table"}, {"terms", {"ggx", "disney_diffuse"}}, {"format", "exr"}},
              {{"kind", "probe"},
               {"name", "probe"},
               {"source", study_environment_file(study)},
               {"colour_space", "lin_rec709"},
               {"size", 128},
               {"format", "ktx2"},
               {"pixel", "float"}}}}};
}

std::string shading_page(const ShadingStudy& study, const Image& environment, const run::RunReport& report,
                         Json& figures) {
    const BakedImage table = read_baked(report.bakes[0]), probe = read_baked(report.bakes[1]);
    return ShadingPage(study, environment, probe, table).html(figures);
}

}  // namespace pbrbake::verify
