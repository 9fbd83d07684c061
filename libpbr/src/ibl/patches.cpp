#include "pbr/ibl/patches.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr int kBlockSide = 8;

double texel_angle_of(const EquirectView& source) {
    return std::max(2 * std::numbers::pi / source.width, std::numbers::pi / source.height);
}

std::vector<QuadratureRule> rules_of_orders() {
    std::vector<QuadratureRule> rules;
    for (const int order : PatchBlocks::kOrders) rules.push_back(gauss_legendre(order));
    return rules;
}

}  // namespace

double angle_of_chord(double chord) {
    const double sine = std::min(1.0, chord / 2);  // of half the angle
    return 2 * atan2_exact(sine, std::sqrt((1 - sine) * (1 + sine)));
}

void PatchPoints::resize(std::size_t count) {
    for (std::vector<float>* array : {&x, &y, &z, &weight, &r, &g, &b}) array->resize(count);
}

PatchBlocks::PatchBlocks(const EquirectView& source)
    : equirect_(source), texel_angle_(texel_angle_of(source)), rules_(rules_of_orders()) {
    add_blocks(0, source.width, source.height);
}

PatchBlocks::PatchBlocks(const CubeView& source)
    : cube_(source), texel_angle_(2.0 / source.size), rules_(rules_of_orders()) {
    for (int face = 0; face < 6; ++face) add_blocks(face, source.size, source.size);
}

glm::dvec3 PatchBlocks::direction(int face, double x, double y) const {
    if (cube_.rgb) return glm::normalize(cube_vector(face, 2 * x / cube_.size - 1, 2 * y / cube_.size - 1));
    // world_to_source is orthogonal: its transpose leads back.
    return glm::transpose(equirect_.world_to_source) *
           equirect_direction(x / equirect_.width, y / equirect_.height);
}

PatchBlocks::PatchBlocks(const EquirectView& source, std::span<const CubeTexel> texels)
    : equirect_(source), texel_angle_(texel_angle_of(source)), rules_(rules_of_orders()) {
    for (const CubeTexel& texel : texels) add_block({0, texel.x, texel.y, 1, 1, {}});
}

PatchBlocks::PatchBlocks(const CubeView& source, std::span<const CubeTexel> texels)
    : cube_(source), texel_angle_(2.0 / source.size), rules_(rules_of_orders()) {
    for (const CubeTexel& texel : texels) add_block({texel.face, texel.x, texel.y, 1, 1, {}});
}

void PatchBlocks::add_blocks(int face, int width, int height) {
    for (int y = 0; y < height; y += kBlockSide)
        for (int x = 0; x < width; x += kBlockSide)
            add_block({face, x, y, std::min(kBlockSide, width - x), std::min(kBlockSide, height - y), {}});
}

void PatchBlocks::add_block(Block block) {
    block.cone.axis = direction(block.face, block.x + block.width / 2.0, block.y + block.height / 2.0);
    // A cell of a grid is not convex on the sphere, but no point of it is farther out than its outline by
    // more than a texel.
    double farthest = 0;
    for (int j = 0; j <= block.height; ++j)
        for (int i = 0; i <= block.width; ++i) {
            const glm::dvec3 d = direction(block.face, block.x + i, block.y + j);
            farthest = std::max(farthest, glm::length(d - block.cone.axis));
        }
    block.cone.half_angle = angle_of_chord(farthest) + texel_angle_ / 2;
    blocks_.push_back(block);
}

void PatchBlocks::points(int index, int order_index, PatchPoints& points) const {
    const Block& block = blocks_[index];
    const QuadratureRule& rule = rules_[order_index];
    const std::size_t nodes = static_cast<std::size_t>(rule.size());
    points.resize(nodes * nodes * block.width * block.height);
    if (cube_.rgb) {
        cube_points(block, rule, points);
    } else {
        equirect_points(block, rule, points);
    }
}

void PatchBlocks::equirect_points(const Block& block, const QuadratureRule& rule, PatchPoints& points) const {
    // The points are a product of longitudes and colatitudes: sines and cosines are taken along the axes
    // alone.
    const std::size_t order = static_cast<std::size_t>(rule.size());
    std::vector<SinCos> longitudes(order * block.width), colatitudes(order * block.height);
    for (std::size_t i = 0; i < longitudes.size(); ++i)
        longitudes[i] = sin_cos_pi(1 - 2 * (block.x + static_cast<int>(i / order) + rule.nodes[i % order]) /
                                           equirect_.width);
    for (std::size_t i = 0; i < colatitudes.size(); ++i)
        colatitudes[i] =
            sin_cos_pi((block.y + static_cast<int>(i / order) + rule.nodes[i % order]) / equirect_.height);
    const glm::dmat3 to_world = glm::transpose(equirect_.world_to_source);  // it is orthogonal

    std::size_t at = 0;
    for (int y = 0; y < block.height; ++y) {
        // Solid angle of a texel, and the sum its points' sines have.
        const double exact = equirect_texel_solid_angle(equirect_.width, equirect_.height, block.y + y);
        double sines = 0;
        for (std::size_t b = 0; b < order; ++b) sines += rule.weights[b] * colatitudes[y * order + b].sin;
        for (std::size_t b = 0; b < order; ++b) {
            const SinCos colatitude = colatitudes[y * order + b];
            const double row_weight = exact * rule.weights[b] * colatitude.sin / sines;
            const glm::dvec3 up = to_world[1] * colatitude.cos;
            const glm::dvec3 right = to_world[0] * colatitude.sin, ahead = to_world[2] * colatitude.sin;
            for (std::size_t i = 0; i < longitudes.size(); ++i, ++at) {
                const glm::dvec3 d = up + right * longitudes[i].sin + ahead * longitudes[i].cos;
                const float* rgb = equirect_.texel(block.x + static_cast<int>(i / order), block.y + y);
                points.x[at] = static_cast<float>(d.x);
                points.y[at] = static_cast<float>(d.y);
                points.z[at] = static_cast<float>(d.z);
                points.weight[at] = static_cast<float>(row_weight * rule.weights[i % order]);
                points.r[at] = rgb[0];
                points.g[at] = rgb[1];
                points.b[at] = rgb[2];
            }
        }
    }
}

void PatchBlocks::cube_points(const Block& block, const QuadratureRule& rule, PatchPoints& points) const {
    // The measure on a face is (1 + s^2 + t^2)^-3/2 ds dt.
    const double n = cube_.size;
    std::size_t at = 0;
    for (int y = block.y; y < block.y + block.height; ++y)
        for (int x = block.x; x < block.x + block.width; ++x) {
            const float* rgb = cube_.texel(block.face, x, y);
            const std::size_t first = at;
            double sum = 0;
            for (int b = 0; b < rule.size(); ++b)
                for (int a = 0; a < rule.size(); ++a, ++at) {
                    const double s = 2 * (x + rule.nodes[a]) / n - 1, t = 2 * (y + rule.nodes[b]) / n - 1;
                    const double inverse_length = 1 / std::sqrt(1 + s * s + t * t);
                    const double share =
                        rule.weights[a] * rule.weights[b] * inverse_length * inverse_length * inverse_length;
                    const glm::dvec3 d = cube_vector(block.face, s, t) * inverse_length;
                    points.x[at] = static_cast<float>(d.x);
                    points.y[at] = static_cast<float>(d.y);
                    points.z[at] = static_cast<float>(d.z);
                    points.weight[at] = static_cast<float>(share);
                    points.r[at] = rgb[0];
                    points.g[at] = rgb[1];
                    points.b[at] = rgb[2];
                    sum += share;
                }
            const float to_exact = static_cast<float>(cubemap_texel_solid_angle(cube_.size, x, y) / sum);
            for (std::size_t i = first; i < at; ++i) points.weight[i] *= to_exact;
        }
}

}  // namespace pbr
