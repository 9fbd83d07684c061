#include "bakers/verify/texture_proof.hpp"

#include <algorithm>

#include "bakers/run/bake_one.hpp"
#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kSphere = 144, kMap = 144;  // pixels across

/// The largest level's first channels: containers hold some pictures with more than were written.
Image first_channels(const Image& image, std::size_t count) {
    const Level& level = image.levels.front();
    Image kept;
    kept.channels.assign(image.channels.begin(), image.channels.begin() + static_cast<std::ptrdiff_t>(count));
    kept.levels.push_back({level.width, level.height, {}});
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        if (i % image.channels.size() < count) kept.levels[0].texels.push_back(level.texels[i]);
    return kept;
}

/// The images of the packing, in its order, as their files hold them: a record's first outputs.
std::vector<Image> read_images(const run::BakeReport& bake) {
    std::vector<Image> images;
    if (bake.entry["set"].contains("factors")) return images;
    for (const auto& [name, channels] : bake.entry["set"]["images"].items()) {
        const std::string file = bake.entry["outputs"][images.size()]["path"].get<std::string>();
        const Image stored = read_product_file(bake.job->output / file, bake.entry).image;
        images.push_back(first_channels(stored, std::min(channels.size(), stored.channels.size())));
    }
    return images;
}

enum class Shape { ball, map };

std::string figure(Shape shape, const Picture& picture, const std::string& title, const std::string& words) {
    return std::string(shape == Shape::ball ? "<figure class=ball>" : "<figure>") + "<img alt=\"" + title +
           "\" width=" + std::to_string(picture.width) + " height=" + std::to_string(picture.height) +
           " src=\"" + data_uri(picture) + "\"><figcaption><b>" + title + "</b><br>" + words +
           "</figcaption></figure>\n";
}

std::string model_words(const texture::TextureParams& params) {
    switch (params.model) {
        case texture::Model::blinn_phong:
            return "Blinn-Phong";
        case texture::Model::phong:
            return "Phong";
        case texture::Model::specular_gloss:
            return "specular and gloss, GGX";
        case texture::Model::metallic_roughness:
            return "metallic and roughness, GGX";
    }
    return "";
}

std::string pictures(ReadBackSet& set, const DisplayTransform& display) {
    const SetSpheres spheres = set_spheres(*set, kSphere, set.context());
    const ChangeMaps maps = change_maps(*set, kMap, set.context());
    const auto ball = [&](const LinearPicture& sphere, const char* title, const std::string& words) {
        return figure(Shape::ball, display(as_seen(sphere)), title, words);
    };
    std::string html =
        "<div class=proof>\n" + ball(spheres.as_read, "before", "as read: " + model_words(set->params()));
    if (set->is_calibrated())
        html += ball(spheres.calibrated, "calibrated", "the set at the f0 that it was given");
    html +=
        ball(spheres.stored, "after", "as stored: packing " + std::string(enum_name(set->params().packing)));
    html += figure(Shape::ball, sphere_difference(spheres.stored, spheres.aim()), "difference",
                   "of luminance, over the mean: 0.1 % (dark) to 100 %; FLIP " +
                       number(sphere_flip(spheres.stored, spheres.aim())));
    html += figure(Shape::map, maps.delta_e, "colour, a texel", "ΔE: 0.1 (dark) to 10 (light)");
    html += figure(Shape::map, maps.energy, "energy, a texel",
                   "lost (blue) or gained (orange): 0.1 % (dark) to 100 %");
    return html + "</div>\n";
}

constexpr const char* kPictureWords =
    "<p class=soft>Spheres in the built-in room, without normal maps: both lobes are summed over the same 64 "
    "× "
    "32 lights. The difference, and the maps of what each texel returns of an even sky, are of what is "
    "stored "
    "against the set as read, or as calibrated where it was.</p>\n";

/// Terms and what is said of them.
class Facts {
  public:
    void add(const std::string& term, const std::string& html) {
        if (!html.empty()) rows_ += "<dt>" + term + "</dt><dd>" + html + "</dd>\n";
    }
    std::string html() const { return "<dl>\n" + rows_ + "</dl>\n"; }

  private:
    std::string rows_;
};

std::string text(const Json& set, const char* name) { return escaped(set.value(name, std::string())); }
std::string figure_of(const Json& set, const char* name) {
    return set.contains(name) ? number(set[name].get<double>()) : "";
}
std::string share_of(const Json& set, const char* name) { return percent(set.value(name, 0.)); }

std::string gloss_words(const Json& gloss) {
    std::string words = "<code>" + text(gloss, "in") + "</code>";
    if (gloss.contains("is")) words += " as " + text(gloss, "is");
    return words + ": " + text(gloss, "reason");
}

std::string calibration_words(const Json& set) {
    const std::string kind = set.value("calibration", std::string("none"));
    if (kind == "none") return "none: specular is taken at its word";
    std::string words = escaped(kind);
    if (set.contains("surface_word")) words += ", by the word “" + text(set, "surface_word") + "”";
    if (kind == "statistics") words += ", by its median dielectric";
    return words + ": f0 × " + figure_of(set, "specular_scale");
}

std::string metal_words(const Json& set) {
    return "metallic " + figure_of(set, "mean_metallic") + " and confidence " +
           figure_of(set, "mean_confidence") + " in the mean; the data don't tell in " +
           share_of(set, "low_confidence") + " of texels";
}

std::string normal_words(const Json& set) {
    if (!set.contains("normal_green")) return "";
    return "green points " + text(set, "normal_green") + " (correlation " +
           figure_of(set, "green_correlation") + "; above 0 is up)";
}

std::string reading(const run::BakeReport& bake) {
    const Json& set = bake.entry["set"];
    Facts facts;
    facts.add("gloss", gloss_words(set["gloss"]));
    facts.add("calibration", calibration_words(set));
    facts.add("metal", metal_words(set));
    facts.add("normal map", normal_words(set));
    if (set.value("diffuse_alpha", std::string()) == "opacity") facts.add("alpha of diffuse", "opacity");
    if (set.contains("rules")) {
        std::string rules;
        for (const Json& rule : set["rules"])
            rules += (rules.empty() ? "<code>" : ", <code>") + escaped(rule.get<std::string>()) + "</code>";
        facts.add("rules followed", rules);
    }
    facts.add("lobes beyond GGX", share_of(set, "f0_clamped") + " of texels");
    facts.add("more light than arrives", share_of(set, "over_unity") + " of texels");
    if (set.contains("exponent_median"))
        facts.add("exponents", "median " + figure_of(set, "exponent_median") + ", largest " +
                                   figure_of(set, "exponent_max"));
    if (set.contains("gloss_correlation"))
        facts.add("gloss and specular", "correlate by " + figure_of(set, "gloss_correlation"));
    if (set.contains("occlusion_correlation"))
        facts.add("diffuse and occlusion", "correlate by " + figure_of(set, "occlusion_correlation"));
    return facts.html();
}

}  // namespace

ReadBackSet::ReadBackSet(const run::BakeReport& bake, int threads) : context_(threads, bake.bake->accuracy) {
    run::Options options;
    options.threads = threads;
    inputs_ = run::decoded_inputs(*bake.job, *bake.bake, options);
    set_ = std::make_unique<const texture::BeforeAndAfter>(
        read_params<texture::TextureParams>(bake.bake->json), inputs_, read_images(bake),
        bake.entry.value("scale", 1.), bake.entry["set"], context_);
}

bool has_proof(const run::BakeReport& bake) {
    return bake.bake->kind == "texture" && bake.entry.is_object() && bake.entry.contains("set");
}

std::string texture_proof_html(const run::BakeReport& bake, const DisplayTransform& display, int threads) {
    std::string html = "<h3>Before and after</h3>\n";
    try {
        ReadBackSet set(bake, threads);
        html += pictures(set, display) + kPictureWords;
    } catch (const Error& error) {
        html += "<p class=soft>No pictures: " + escaped(error.what()) + "</p>\n";
    }
    return html;
}

std::string texture_reading_html(const run::BakeReport& bake) {
    return "<h3>What was read, and why</h3>\n" + reading(bake);
}

}  // namespace pbrbake::verify
