#include "pbr/ibl/patches.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/simd/patch_kernel.hpp"

namespace pbr {
namespace {

/// Texels a side of a block: small ones let far fields come near, but a tree over too many costs more than it
/// spares.
int block_side(double texels) { return texels <= 0x1p14 ? 4 : texels <= 0x1p20 ? 8 : kMostLatLongWidth; }

double texel_angle_of(const EquirectView& source) {
    return std::max(2 * std::numbers::pi / source.width, std::numbers::pi / source.height);
}

/// Points around a picture of which sines and cosines are tabulated, but for one a texel: larger pictures
/// take more of them at few places.
constexpr int kMostTabulated = 4096;

/// Where a single point of a row of texels belongs, in rows: the middle of their area, two thirds of a row
/// from a pole. To second order in the row's height h it is h^2/12 cot(colatitude) beside the middle of the
/// row.
double middle_of_area(int row, int height) {
    const SinCos middle = sin_cos_pi((row + 0.5) / height);
    return row + 0.5 + std::numbers::pi / height / 12 * middle.cos / middle.sin;
}

const std::vector<QuadratureRule>& rules_of_orders() {
    static const std::vector<QuadratureRule> rules = [] {
        std::vector<QuadratureRule> all;
        for (const int order : PatchBlocks::kOrders) all.push_back(gauss_legendre(order));
        return all;
    }();
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
    tabulate_axes();
    add_blocks(1, source.width, source.height);
}

PatchBlocks::PatchBlocks(const CubeView& source)
    : cube_(source), texel_angle_(2.0 / source.size), rules_(rules_of_orders()) {
    add_blocks(6, source.size, source.size);
}

glm::dvec3 PatchBlocks::direction(int face, int half_x, int half_y) const {
    if (cube_.rgb)
        return glm::normalize(cube_vector(face, static_cast<double>(half_x) / cube_.size - 1,
                                          static_cast<double>(half_y) / cube_.size - 1));
    const SinCos longitude = half_columns_[static_cast<std::size_t>(half_x)],
                 colatitude = half_rows_[static_cast<std::size_t>(half_y)];
    // world_to_source is orthogonal: its transpose leads back.
    return glm::dvec3(colatitude.sin * longitude.sin, colatitude.cos, colatitude.sin * longitude.cos) *
           equirect_.world_to_source;
}

PatchBlocks::PatchBlocks(const EquirectView& source, std::span<const CubeTexel> texels)
    : equirect_(source), texel_angle_(texel_angle_of(source)), rules_(rules_of_orders()) {
    tabulate_halves();
    for (const CubeTexel& texel : texels) add_block({0, texel.x, texel.y, 1, 1, {}});
}

PatchBlocks::PatchBlocks(const CubeView& source, std::span<const CubeTexel> texels)
    : cube_(source), texel_angle_(2.0 / source.size), rules_(rules_of_orders()) {
    for (const CubeTexel& texel : texels) add_block({texel.face, texel.x, texel.y, 1, 1, {}});
}

void PatchBlocks::add_blocks(int faces, int width, int height) {
    const int side = block_side(static_cast<double>(faces) * width * height);
    grid_ = {faces, (width + side - 1) / side, (height + side - 1) / side, side};
    blocks_.reserve(static_cast<std::size_t>(faces) * grid_.columns * grid_.rows);
    for (int face = 0; face < faces; ++face)
        for (int y = 0; y < height; y += side)
            for (int x = 0; x < width; x += side)
                add_block({face, x, y, std::min(side, width - x), std::min(side, height - y), {}});
}

double PatchBlocks::reach(const Cells& cells, const glm::dvec3& from) const {
    // The cosine from a fixed vector is a sinusoid along a great circle and along a parallel, and so along
    // the edges of a face and of an equirect's cell no wider than a quarter of the circle: least at a corner.
    const int width = cube_.rgb ? cube_.size : equirect_.width;
    const int height = cube_.rgb ? cube_.size : equirect_.height;
    const int left = cells.left * grid_.side, right = std::min(width, cells.right * grid_.side);
    const int top = cells.top * grid_.side, bottom = std::min(height, cells.bottom * grid_.side);
    if (!cube_.rgb && 4 * (right - left) > width) return 2;
    double farthest = 0;
    for (const int y : {top, bottom})
        for (const int x : {left, right})
            farthest = std::max(farthest, glm::length(direction(cells.face, 2 * x, 2 * y) - from));
    return farthest;
}

void PatchBlocks::add_block(Block block) {
    block.cone.axis = direction(block.face, 2 * block.x + block.width, 2 * block.y + block.height);
    // No point of a cell is farther out than its corners by more than half a texel.
    double farthest = 0;
    for (const int j : {0, block.height})
        for (const int i : {0, block.width}) {
            const glm::dvec3 d = direction(block.face, 2 * (block.x + i), 2 * (block.y + j));
            farthest = std::max(farthest, glm::length(d - block.cone.axis));
        }
    if (!cube_.rgb && 4 * block.width > equirect_.width) farthest = 2;
    block.cone.half_angle = angle_of_chord(farthest) + texel_angle_ / 2;
    blocks_.push_back(block);
}

PatchBlocks::AxisPoints PatchBlocks::longitudes(int first, int count, const QuadratureRule& rule) const {
    AxisPoints points;
    for (int x = first; x < first + count; ++x)
        for (const double node : rule.nodes) {
            const SinCos longitude = sin_cos_pi(1 - 2 * (x + node) / equirect_.width);
            points.sines.push_back(longitude.sin);
            points.cosines.push_back(longitude.cos);
        }
    for (int x = 0; x < count; ++x)
        points.weights.insert(points.weights.end(), rule.weights.begin(), rule.weights.end());
    return points;
}

PatchBlocks::AxisPoints PatchBlocks::colatitudes(int first, int count, const QuadratureRule& rule) const {
    AxisPoints points;
    const std::size_t order = static_cast<std::size_t>(rule.size());
    for (int y = first; y < first + count; ++y) {
        double sum = 0;
        for (std::size_t b = 0; b < order; ++b) {
            const double row = order == 1 ? middle_of_area(y, equirect_.height) : y + rule.nodes[b];
            const SinCos colatitude = sin_cos_pi(row / equirect_.height);
            points.sines.push_back(colatitude.sin);
            points.cosines.push_back(colatitude.cos);
            points.weights.push_back(rule.weights[b] * colatitude.sin);
            sum += points.weights.back();
        }
        // The points of a texel have its exact solid angle.
        const double to_exact = equirect_texel_solid_angle(equirect_.width, equirect_.height, y) / sum;
        for (std::size_t b = points.weights.size() - order; b < points.weights.size(); ++b)
            points.weights[b] *= to_exact;
    }
    return points;
}

void PatchBlocks::tabulate_halves() {
    half_columns_.reserve(2 * static_cast<std::size_t>(equirect_.width) + 1);
    half_rows_.reserve(2 * static_cast<std::size_t>(equirect_.height) + 1);
    for (int i = 0; i <= 2 * equirect_.width; ++i)
        half_columns_.push_back(sin_cos_pi(1 - static_cast<double>(i) / equirect_.width));
    for (int i = 0; i <= 2 * equirect_.height; ++i)
        half_rows_.push_back(sin_cos_pi(static_cast<double>(i) / (2 * equirect_.height)));
}

void PatchBlocks::tabulate_axes() {
    tabulate_halves();
    for (std::size_t k = 0; k < longitudes_.size(); ++k) {
        if (k > 0 && kOrders[k] * equirect_.width > kMostTabulated) break;
        longitudes_[k] = longitudes(0, equirect_.width, rules_[k]);
        for (std::vector<double>* table :
             {&longitudes_[k].sines, &longitudes_[k].cosines, &longitudes_[k].weights})
            table->resize(table->size() + kLatLongPadding);
        colatitudes_[k] = colatitudes(0, equirect_.height, rules_[k]);
    }
}

void PatchBlocks::points(int index, int order_index, PatchPoints& points) const {
    points.resize(0);
    append_points(index, order_index, points);
}

void PatchBlocks::middle_points(int index, int order_index, PatchPoints& points) const {
    const Block& block = blocks_[index];
    points.resize(0);
    append({block.face, block.x + block.width / 2, block.y + block.height / 2, 1, 1, {}}, order_index,
           points);
}

void PatchBlocks::append_points(int index, int order_index, PatchPoints& points) const {
    append(blocks_[index], order_index, points);
}

void PatchBlocks::append(const Block& block, int order_index, PatchPoints& points) const {
    const std::size_t at = points.size(), nodes = static_cast<std::size_t>(kOrders[order_index]);
    points.resize(at + nodes * nodes * block.width * block.height);
    if (cube_.rgb) {
        cube_points(block, rules_[order_index], at, points);
    } else {
        equirect_points(block, order_index, at, points);
    }
}

bool PatchBlocks::is_tabulated(int order_index) const {
    return order_index < static_cast<int>(longitudes_.size()) &&
           !longitudes_[static_cast<std::size_t>(order_index)].sines.empty();
}

LatLongPatch PatchBlocks::lat_long_patch(const Block& block, int order_index, const AxisPoints& columns,
                                         const AxisPoints& rows) const {
    const bool tabulated = is_tabulated(order_index);
    const std::size_t order = static_cast<std::size_t>(kOrders[order_index]),
                      column = tabulated ? block.x * order : 0, row = tabulated ? block.y * order : 0;
    const glm::dmat3 to_world = glm::transpose(equirect_.world_to_source);  // it is orthogonal
    return {{&columns.sines[column], &columns.cosines[column], &columns.weights[column]},
            {&rows.sines[row], &rows.cosines[row], &rows.weights[row]},
            to_world[0],
            to_world[1],
            to_world[2],
            equirect_.texel(block.x, block.y),
            static_cast<std::size_t>(equirect_.width) * 3,
            block.width,
            block.height,
            static_cast<int>(order)};
}

bool PatchBlocks::tabulated_patch(int index, int order_index, LatLongPatch& patch) const {
    if (!is_tabulated(order_index)) return false;
    patch = lat_long_patch(blocks_[index], order_index, longitudes_[order_index], colatitudes_[order_index]);
    return true;
}

void PatchBlocks::equirect_points(const Block& block, int order_index, std::size_t at,
                                  PatchPoints& points) const {
    // The points are a product of longitudes and colatitudes: sines and cosines are taken along the axes
    // alone, and for the orders that most points have but once.
    if (is_tabulated(order_index))
        return fill_lat_long_points(
            lat_long_patch(block, order_index, longitudes_[order_index], colatitudes_[order_index]), at,
            points);
    const QuadratureRule& rule = rules_[order_index];
    const AxisPoints columns = longitudes(block.x, block.width, rule),
                     rows = colatitudes(block.y, block.height, rule);
    fill_lat_long_points(lat_long_patch(block, order_index, columns, rows), at, points);
}

void PatchBlocks::cube_points(const Block& block, const QuadratureRule& rule, std::size_t at,
                              PatchPoints& points) const {
    // The measure on a face is (1 + s^2 + t^2)^-3/2 ds dt.
    const double n = cube_.size;
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
