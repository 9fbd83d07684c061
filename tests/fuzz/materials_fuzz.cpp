// Any bytes as a file of materials, of each format: finite factors in their ranges, or an error.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "bakers/parse/materials.hpp"

namespace {

void expect(bool holds) {
    if (!holds) std::abort();
}

bool is_in(const glm::dvec3& v, double largest) {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && std::max({v.x, v.y, v.z}) <= largest;
}

void check(const pbrbake::parse::LegacyMaterial& material) {
    expect(is_in(material.diffuse_factor, 1e4));
    expect(!material.specular_factor || is_in(*material.specular_factor, 1e4));
    expect(!material.emissive_factor || is_in(*material.emissive_factor, 1e300));
    expect(!material.exponent || (*material.exponent >= 0 && *material.exponent <= 1e6));
    for (const double unit : {material.glossiness, material.opacity_factor, material.metallic,
                              material.perceptual_roughness, material.occlusion_strength})
        expect(unit >= 0 && unit <= 1);
    expect(std::isfinite(material.normal_scale) && material.alpha_cutoff >= 0);
    for (const auto* map : {&material.diffuse, &material.specular, &material.normal})
        expect(std::isfinite(map->transform.offset.x + map->transform.scale.y + map->transform.rotation));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pbrbake;
    for (const char* file : {"fuzz.mtl", "fuzz.dae", "fuzz.json"}) try {
            const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
            for (const parse::LegacyMaterial& material : parse::parse_materials(bytes, file).materials)
                if (!material.error) check(material);
        } catch (const Error& error) {
            expect(error.code() == ExitCode::unreadable_input && !error.message().empty());
        }
    return 0;
}
