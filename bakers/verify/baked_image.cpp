#include "bakers/verify/baked_image.hpp"

#include <cmath>

#include "bakers/io/io.hpp"
#include "bakers/verify/face.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::verify {

std::vector<double> perceptual_roughness_of_levels(const Json& record, std::size_t levels) {
    std::vector<double> list;
    if (record.is_object() && record.contains("levels") && record["levels"].is_array())
        for (const Json& level : record["levels"])
            if (level.is_object() && level.contains("perceptual_roughness"))
                list.push_back(level["perceptual_roughness"].get<double>());
    if (list.size() == levels) return list;
    list.clear();
    for (std::size_t level = 0; level < levels; ++level)
        list.push_back(
            pbr::perceptual_roughness_from_level(static_cast<double>(level), static_cast<int>(levels)));
    return list;
}

BakedImage read_baked(const run::BakeReport& bake) {
    Image image = io::read_product(bake.writes.front()).image;
    std::vector<double> perceptual_roughness =
        perceptual_roughness_of_levels(bake.entry, image.levels.size());
    return {std::move(image), bake.entry["scale"].get<double>(), std::move(perceptual_roughness)};
}

BakedImage resampled(const BakedImage& flat, int width, int height) {
    const Face texels = face_of(flat.image, 0, 0);
    Image image = flat.image;
    image.levels.assign(1, {width, height, {}});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < texels.channels; ++c)
                image.levels[0].texels.push_back(texels.between((x + 0.5) / width * texels.width - 0.5,
                                                                (y + 0.5) / height * texels.height - 0.5, c));
    return {std::move(image), flat.scale, flat.perceptual_roughness};
}

double value_error(const BakedImage& product, const BakedImage& reference, int level, std::size_t index) {
    const auto l = static_cast<std::size_t>(level);
    return product.image.levels[l].texels[index] / product.scale -
           reference.image.levels[l].texels[index] / reference.scale;
}

double relative_rmse(const BakedImage& product, const BakedImage& reference, int level) {
    const std::vector<float>& truth = reference.image.levels[static_cast<std::size_t>(level)].texels;
    pbr::CompensatedSum squared, sum;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double error = value_error(product, reference, level, i);
        squared += error * error;
        sum += truth[i] / reference.scale;
    }
    const double size = static_cast<double>(truth.size()), mean = sum.value() / size;
    return std::sqrt(squared.value() / size) / (mean > 0 ? mean : 1);
}

WorstLevel worst_level(const BakedImage& product, const BakedImage& reference) {
    const Image &a = product.image, &b = reference.image;
    bool alike = a.levels.size() == b.levels.size() && a.faces == b.faces && a.channels == b.channels;
    for (std::size_t l = 0; alike && l < a.levels.size(); ++l)
        alike = a.levels[l].texels.size() == b.levels[l].texels.size();
    if (!alike)
        throw Error(ExitCode::invalid_job, "", "differs from its reference in size, levels or channels");
    WorstLevel worst;
    for (int level = 0; level < static_cast<int>(a.levels.size()); ++level) {
        const double here = relative_rmse(product, reference, level);
        if (here > worst.relative_rmse) worst = {here, level};
    }
    return worst;
}

}  // namespace pbrbake::verify
