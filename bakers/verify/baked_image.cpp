#include "bakers/verify/baked_image.hpp"

#include <cmath>

#include "bakers/io/io.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::verify {

BakedImage read_baked(const run::BakeReport& bake) {
    return {io::read_product(bake.writes.front()).image, bake.entry["scale"].get<double>()};
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
