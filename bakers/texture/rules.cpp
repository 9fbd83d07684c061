#include "bakers/texture/rules.hpp"

#include <algorithm>

#include "bakers/parse/rules.hpp"
#include "bakers/parse/text.hpp"
#include "bakers/texture/names.hpp"

namespace pbrbake::texture {
namespace {

using parse::JsonFields;

template <class E>
std::string names_of() {
    std::string list;
    for (const std::string_view name : EnumNames<E>::names) (list += list.empty() ? "" : ", ") += name;
    return list;
}

/// The fields of TextureParams that rules may state, each with its reader.
class FieldReader {
  public:
    FieldReader(const JsonFields& fields, TextureParams& params) : fields_(fields), params_(params) {}

    void read(const std::string& key) {
        if (key == "surface") return word(key, params_.surface);
        if (key == "calibrate") return word(key, params_.calibrate);
        if (key == "model") return word(key, params_.model);
        if (key == "norm") return word(key, params_.norm);
        if (key == "gloss_in") return word(key, params_.gloss_in);
        if (key == "gloss_is") return word(key, params_.gloss_is);
        if (key == "gloss_space") return word(key, params_.gloss_space);
        if (key == "specular_channel") return word(key, params_.specular_channel);
        if (key == "gloss_channel") return word(key, params_.gloss_channel);
        if (key == "metallic_channel") return word(key, params_.metallic_channel);
        if (key == "occlusion_channel") return word(key, params_.occlusion_channel);
        if (key == "opacity_channel") return word(key, params_.opacity_channel);
        if (key == "normal_in") return word(key, params_.normal_in);
        if (key == "normal_green") return word(key, params_.normal_green);
        if (key == "alpha_is") return word(key, params_.alpha_is);
        if (key == "power_scale") return number(key, 1e-6, 1e6, params_.power_scale);
        if (key == "power") return number(key, 0, 1e6, params_.power);
        if (key == "dielectric_f0") return number(key, .001, .2, params_.dielectric_f0);
        if (key == "f0_tolerance") return number(key, 0, .2, params_.f0_tolerance);
        if (key != "match" && key != "f0")
            fields_.refuse(key,
                           "match, f0, surface, calibrate, model, norm, gloss_in, gloss_is, gloss_space, "
                           "specular_channel, gloss_channel, metallic_channel, occlusion_channel, "
                           "opacity_channel, normal_in, normal_green, alpha_is, power_scale, power, "
                           "dielectric_f0, f0_tolerance");
    }

  private:
    template <class E>
    void word(const std::string& key, E& value) const {
        const auto& names = EnumNames<E>::names;
        const auto found = std::ranges::find(names, fields_.text({key}, ""));
        if (found == names.end()) fields_.refuse(key, names_of<E>());
        value = static_cast<E>(found - names.begin());
    }
    void number(const std::string& key, double least, double most, double& value) const {
        const double found = fields_.number({key}, least - 1);
        if (found < least || found > most)
            fields_.refuse(key, parse::number_text(least) + " to " + parse::number_text(most));
        value = found;
    }

    const JsonFields& fields_;
    TextureParams& params_;
};

/// A number, which is grey, or three; each in (0, 1].
std::optional<pbr::Vec3<float>> read_f0(const JsonFields& fields) {
    if (!fields.has("f0")) return {};
    constexpr const char* kAllowed = "a number above 0, at most 1, or three of them";
    if (!fields.json()["f0"].is_number() && !fields.json()["f0"].is_array()) fields.refuse("f0", kAllowed);
    const glm::dvec3 f0 = fields.json()["f0"].is_number() ? glm::dvec3(fields.number({"f0"}, 0))
                                                          : fields.vector({"f0"}).value();
    for (int c = 0; c < 3; ++c)
        if (!(f0[c] > 0 && f0[c] <= 1)) fields.refuse("f0", kAllowed);
    return pbr::Vec3<float>(f0);
}

/// Reads the whole rule even where it doesn't match, so that mistakes show at once.
void read_rule(const JsonFields& fields, RuledSet& set) {
    FieldReader reader(fields, set.params);
    for (const auto& [key, value] : fields.json().items()) reader.read(key);
    const auto f0 = read_f0(fields);
    if (!f0) return;
    const bool is_told = fields.has("surface") && (set.params.surface == SurfaceIs::metal ||
                                                   set.params.surface == SurfaceIs::dielectric);
    if (!is_told) fields.refuse("surface", "metal or dielectric beside an f0");
    set.f0 = f0;
}

}  // namespace

const std::string& name_of_set(const TextureParams& params) {
    if (!params.diffuse.empty()) return params.diffuse;
    if (!params.base_color.empty()) return params.base_color;
    return params.specular.empty() ? params.material : params.specular;
}

RuledSet apply_rules(const TextureParams& params, const Inputs& inputs) {
    RuledSet set{params, {}, {}};
    const auto found = inputs.find("rules");
    if (found == inputs.end()) return set;
    for (const parse::Rule& rule : parse::parse_rules(found->second.bytes, found->second.name)) {
        RuledSet other = set;
        const bool is_ours = matches(rule.match, name_of_set(params));
        read_rule(rule.read(), is_ours ? set : other);
        if (is_ours) set.matched.push_back(rule.match);
    }
    return set;
}

}  // namespace pbrbake::texture
