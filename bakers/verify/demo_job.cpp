#include "bakers/verify/demo.hpp"

namespace pbrbake::verify {

Json demo_job(bool with_reference) {
    Json bakes = Json::array();
    bakes.push_back({{"kind", "dfg"},
                     {"name", "dfg"},
                     {"size", 128},
                     {"terms", {"ggx", "disney_diffuse"}},
                     {"format", "exr"}});
    for (const std::string environment : {"outdoor", "indoor"}) {
        const auto probe = [&](const std::string& suffix) {
            return Json{{"kind", "probe"},
                        {"name", environment + "_" + suffix},
                        {"source", "builtin:" + environment},
                        {"size", 256}};
        };
        for (const int samples : {32, 1024}) {
            Json bake = probe(std::to_string(samples));
            bake["integrator"] = "fis";
            bake["samples"] = samples;
            bake["format"] = "ktx2";
            bakes.push_back(std::move(bake));
        }
        if (!with_reference) continue;
        Json reference = probe("ref");
        reference["integrator"] = "reference";
        reference["format"] = "exr";
        reference["pixel"] = "float";
        bakes.push_back(std::move(reference));
    }
    return {{"version", 1}, {"output", "."}, {"accuracy", "production"}, {"bakes", std::move(bakes)}};
}

}  // namespace pbrbake::verify
