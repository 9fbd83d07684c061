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

}  // namespace

void PatchPoints::clear() {
    for (std::vector<float>* array : {&x, &y, &z, &weight, &r, &g, &b}) array->clear();
}

void PatchPoints::add(const glm::dvec3& direction, double solid_angle, const float* rgb) {
    x.push_back(static_cast<float>(direction.x));
    y.push_back(static_cast<float>(direction.y));
    z.push_back(static_cast<float>(direction.z));
    weight.push_back(static_cast<float>(solid_angle));
    r.push_back(rgb[0]);
    g.push_back(rgb[1]);
    b.push_back(rgb[2]);
}

PatchBlocks::PatchBlocks(const EquirectView& source)
    : equirect_(source), texel_angle_(std::max(2 * std::numbers::pi / source.width, std::numbers::pi / source.height)) {
    add_blocks(0, source.width, source.height);
}

PatchBlocks::PatchBlocks(const CubeView& source) : cube_(source), texel_angle_(2.0 / source.size) {
    for (int face = 0; face < 6; ++face) add_blocks(face, source.size, source.size);
}

glm::dvec3 PatchBlocks::direction(int face, double x, double y) const {
    if (cube_.rgb) return glm::normalize(cube_vector(face, 2 * x / cube_.size - 1, 2 * y / cube_.size - 1));
    // world_to_source is orthogonal: its transpose leads back.
    return glm::transpose(equirect_.world_to_source) *
           equirect_direction(x / equirect_.width, y / equirect_.height);
}

void PatchBlocks::add_blocks(int face, int width, int height) {
    for (int y = 0; y < height; y += kBlockSide)
        for (int x = 0; x < width; x += kBlockSide) {
            Block block{face, x, y, std::min(kBlockSide, width - x), std::min(kBlockSide, height - y), {}};
            block.cone.axis = direction(face, x + block.width / 2.0, y + block.height / 2.0);
            // A cell of a grid is not convex on the sphere, but no point of it is farther out than its outline by
            // more than a texel.
            double farthest = 0;
            for (int j = 0; j <= block.height; ++j)
                for (int i = 0; i <= block.width; ++i) {
                    const glm::dvec3 d = direction(face, x + i, y + j);
                    farthest = std::max(farthest, glm::length(d - block.cone.axis));
                }
            block.cone.half_angle = 2 * std::asin(std::min(1.0, farthest / 2)) + texel_angle_ / 2;
            blocks_.push_back(block);
        }
}

void PatchBlocks::points(int index, int order, PatchPoints& points) const {
    const Block& block = blocks_[index];
    const QuadratureRule rule = gauss_legendre(order);
    points.clear();
    for (int y = block.y; y < block.y + block.height; ++y)
        for (int x = block.x; x < block.x + block.width; ++x) {
            const float* rgb = cube_.rgb ? cube_.texel(block.face, x, y) : equirect_.texel(x, y);
            double exact, sum = 0;
            if (cube_.rgb) {
                exact = cubemap_texel_solid_angle(cube_.size, x, y);
            } else {
                const double h = equirect_.height;  // cos a - cos b without cancellation
                exact = 2 * std::numbers::pi / equirect_.width * 2 * sin_cos_pi((y + 0.5) / h).sin * sin_cos_pi(0.5 / h).sin;
            }
            // The measure varies within a texel like sin(theta), or like (1 + s^2 + t^2)^-3/2 on a cube.
            const auto measure = [&](double i, double j) {
                if (!cube_.rgb) return sin_cos_pi(j / equirect_.height).sin;
                const double s = 2 * i / cube_.size - 1, t = 2 * j / cube_.size - 1, q = 1 + s * s + t * t;
                return 1 / (q * std::sqrt(q));
            };
            for (int b = 0; b < order; ++b)
                for (int a = 0; a < order; ++a)
                    sum += rule.weights[a] * rule.weights[b] * measure(x + rule.nodes[a], y + rule.nodes[b]);
            for (int b = 0; b < order; ++b)
                for (int a = 0; a < order; ++a) {
                    const double px = x + rule.nodes[a], py = y + rule.nodes[b];
                    const double share = rule.weights[a] * rule.weights[b] * measure(px, py) / sum;
                    points.add(direction(block.face, px, py), exact * share, rgb);
                }
        }
}

}  // namespace pbr
