#pragma once
// Conversions of files in memory.

#include <string>

#include "bakers/light/light.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::light::test {

/// The schema's defaults, with an illuminance of 1 lx for a relative 1.
inline LightParams defaults() {
    LightParams params{};
    params.ev100 = 8;
    params.reference_illuminance_lx = 1;
    params.efficacy_lm_per_w = 683;
    params.documents = {DocumentKind::json, DocumentKind::gltf};
    return params;
}

struct Baked {
    Product product;
    Certificate certificate;

    const Json& json() const { return product.documents.at(0).json; }
    const Json& gltf() const { return product.documents.at(1).json; }
    const Json& light(std::size_t i = 0) const { return json()["lights"].at(i); }
    double figure(const std::string& metric) const {
        for (const Figure& figure : certificate.figures)
            if (figure.metric == metric) return figure.value;
        return -1;
    }
};

inline Inputs inputs_of(const std::string& text, const std::string& name) {
    Inputs inputs;
    SourceImage& source = inputs["source"];
    const auto bytes = parse::test::bytes_of(text);
    source.bytes.assign(bytes.begin(), bytes.end());
    source.name = name;
    return inputs;
}

inline Baked bake_text(const std::string& text, const LightParams& params = defaults(),
                       const std::string& name = "lights.json") {
    const Inputs inputs = inputs_of(text, name);
    Context context(1, {});
    Baked baked{bake(params, inputs, context), {}};
    baked.certificate = certify(params, inputs, baked.product, context);
    return baked;
}

/// One light of the plain JSON format, by its fields.
inline Baked bake_one(const std::string& fields, const LightParams& params = defaults()) {
    return bake_text("{\"lights\": [{" + fields + "}]}", params);
}

inline bool has_flag(const Json& light, const std::string& code) {
    for (const Json& flag : light["flags"])
        if (flag["code"] == code) return true;
    return false;
}

}  // namespace pbrbake::light::test
