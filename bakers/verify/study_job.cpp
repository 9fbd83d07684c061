#include "bakers/verify/study_job.hpp"

namespace pbrbake::verify {

job::Job single_bake_job(const Json& around, Json bake, const std::string& name,
                         const std::filesystem::path& folder) {
    bake["name"] = name;
    Json document = around.is_object() ? around : Json::object();
    document["version"] = 1;
    const std::string format = bake.value("format", "exr");
    document["bakes"] = Json::array({std::move(bake)});
    return job::from_document(std::move(document), {folder / (name + "." + format), {}});
}

Json without_folders(Json bake) {
    for (auto& [key, value] : bake.items()) {
        if (!value.is_string()) continue;
        const std::filesystem::path path(value.get<std::string>());
        if (path.is_absolute()) value = path.filename().string();
    }
    return bake;
}

Json with_overrides(Json bake, const Json& overrides) {
    for (const auto& [key, value] : overrides.items())
        if (value.is_null())
            bake.erase(key);
        else
            bake[key] = value;
    return bake;
}

}  // namespace pbrbake::verify
