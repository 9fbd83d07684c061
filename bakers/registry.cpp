#include "bakers/registry.hpp"

#include <array>
#include <utility>

#include "bakers/dfg/dfg.hpp"
#include "bakers/ies/ies.hpp"
#include "bakers/light/light.hpp"
#include "bakers/params.hpp"
#include "bakers/probe/probe.hpp"
#include "bakers/texture/scene.hpp"
#include "bakers/texture/texture.hpp"

namespace pbrbake {
namespace {

template <class Params>
Baker make_baker(std::string_view kind, int algorithm_version,
                 std::vector<Mistake> (*check)(const Params&, const std::string& format),
                 std::vector<Read> (*reads)(const Params&),
                 Product (*bake)(const Params&, const Inputs&, Context&),
                 Certificate (*certify)(const Params&, const Inputs&, const Product&, Context&)) {
    return {kind,
            algorithm_version,
            field_names<Params>(),
            [=](const Json& json) {
                return check(read_params<Params>(json), json.at("format").get<std::string>());
            },
            [=](const Json& json) { return reads(read_params<Params>(json)); },
            [=](const Json& json, const Inputs& inputs, Context& context) {
                return bake(read_params<Params>(json), inputs, context);
            },
            [=](const Json& json, const Inputs& inputs, const Product& product, Context& context) {
                return certify(read_params<Params>(json), inputs, product, context);
            },
            {},
            {},
            {},
            {},
            {}};
}

/// The baker of whole glTF documents. What their materials keep is in these materials' certificates.
const Baker& scene_baker() {
    static const Baker baker = [] {
        Baker scene;
        scene.kind = "texture";
        scene.algorithm_version = texture::kAlgorithmVersion;
        scene.check = [](const Json&) { return std::vector<Mistake>(); };
        scene.reads = texture::scene_reads;
        scene.run = [](const Json&, const Inputs& inputs, Context& context) {
            return texture::bake_scene(inputs, context.product_file());
        };
        scene.certify = [](const Json&, const Inputs&, const Product&, Context&) { return Certificate(); };
        scene.follow = texture::scene_files;
        scene.documents = [](const Json&, const Inputs& known) { return texture::scene_documents(known); };
        return scene;
    }();
    return baker;
}

}  // namespace

std::span<const Baker> bakers() {
    static const std::array list = [] {
        Baker dfg =
            make_baker("dfg", dfg::kAlgorithmVersion, dfg::check, dfg::reads, dfg::bake, dfg::certify);
        Baker probe = make_baker("probe", probe::kAlgorithmVersion, probe::check, probe::reads, probe::bake,
                                 probe::certify);
        probe.builtin = probe::builtin_environment;
        Baker ies =
            make_baker("ies", ies::kAlgorithmVersion, ies::check, ies::reads, ies::bake, ies::certify);
        ies.follow = ies::follow;
        ies.documents = [](const Json& json, const Inputs&) {
            return ies::documents(read_params<ies::IesParams>(json));
        };
        Baker texture = make_baker("texture", texture::kAlgorithmVersion, texture::check, texture::reads,
                                   texture::bake, texture::certify);
        texture.expand = texture::expand;
        texture.images = [](const Json& json) {
            return texture::images(read_params<texture::TextureParams>(json),
                                   json.at("format").get<std::string>());
        };
        texture.documents = [](const Json& json, const Inputs&) {
            return texture::documents(json.at("format").get<std::string>());
        };
        texture.joiner = &scene_baker();
        texture.is_joined = texture::is_scene;
        texture.part_document = texture::kPartDocument;
        Baker light = make_baker("light", light::kAlgorithmVersion, light::check, light::reads, light::bake,
                                 light::certify);
        light.documents = [](const Json& json, const Inputs&) {
            return light::documents(read_params<light::LightParams>(json));
        };
        return std::array{std::move(dfg), std::move(probe), std::move(ies), std::move(texture),
                          std::move(light)};
    }();
    return list;
}

const Baker* find_baker(std::string_view kind) {
    for (const Baker& baker : bakers())
        if (baker.kind == kind) return &baker;
    return nullptr;
}

}  // namespace pbrbake
