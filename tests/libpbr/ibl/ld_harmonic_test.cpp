#include "pbr/ibl/ld_harmonic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "tests/libpbr/ibl/pictures.hpp"

namespace pbr {
namespace {

struct Picture {
    std::string name;
    int width;
    std::vector<float> rgb;
    EquirectView view() const { return {rgb.data(), width, width / 2}; }
};

void add_texel(Picture& picture, int x, int y, float value) {
    for (std::size_t c = 0; c < 3; ++c)
        picture.rgb[(static_cast<std::size_t>(y) * picture.width + x) * 3 + c] += value;
}

Picture sky(const std::string& name, int sun_x, int sun_y, float sun) {
    Picture picture{name, 256, picture_of(256, 128, [](const glm::dvec3& d) {
                        return d.y > 0 ? glm::dvec3(0.5 + d.y, 0.8, 1.2) : glm::dvec3(0.2, 0.15, 0.1);
                    })};
    add_texel(picture, sun_x, sun_y, sun);
    return picture;
}

std::vector<Picture> pictures() {
    std::vector<Picture> all{{"noise", 256, noise_picture(256, 128)}};
    all.push_back({"stripes", 256, picture_of(256, 128, [](const glm::dvec3& d) {
                       const int column = static_cast<int>(equirect_point(d).x * 256);
                       return glm::dvec3(column % 2);
                   })});
    all.push_back(sky("sun high", 100, 30, 1e7f));
    all.push_back(sky("sun at the pole", 5, 0, 1e9f));
    all.push_back(sky("sun at the horizon", 255, 64, 1e6f));
    Picture lamps{"a hundred lamps", 256, std::vector<float>(std::size_t{256} * 128 * 3, 0.1f)};
    for (int i = 0; i < 100; ++i)
        add_texel(lamps, static_cast<int>(256 * random_unit(7, i, 0)),
                  static_cast<int>(128 * random_unit(7, i, 1)), 300);
    all.push_back(lamps);
    return all;
}

/// Texels of a level, faces one after the other.
std::vector<glm::dvec3> level_of(int size) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 6 * size * size; ++i)
        directions.push_back(cubemap_texel_direction({i / (size * size), i % size, i / size % size}, size));
    return directions;
}

struct Errors {
    double rms;      ///< over the mean
    double largest;  ///< over the largest value
    double lowest;   ///< value
};

Errors errors(const LdHarmonic& harmonic, const PatchBlocks& blocks, double alpha) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 320; ++i) directions.push_back(random_direction(11, i));
    std::vector<double> truth(directions.size() * 3);
    std::uint64_t evaluations = 0;
    // By the tree, which cuts suns where the horizon does.
    ld_exact(MomentTree(blocks, for_each_in_turn), alpha, 1e-4, directions, truth, evaluations);
    std::vector<float> found(truth.size());
    harmonic.level(alpha, for_each_in_turn).integrate(directions, found);
    double squared = 0, mean = 0, largest = 0, peak = 0, lowest = 1e300;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double error = std::abs(static_cast<double>(found[i]) - truth[i]);
        squared += error * error;
        mean += truth[i];
        largest = std::max(largest, error);
        peak = std::max(peak, truth[i]);
        lowest = std::min(lowest, static_cast<double>(found[i]));
    }
    return {std::sqrt(squared * static_cast<double>(truth.size())) / mean, largest / peak, lowest};
}

TEST(LdHarmonic, MeetsTheErrorAskedForOnHardPictures) {
    for (const Picture& picture : pictures()) {
        const PatchBlocks blocks(picture.view());
        for (const double max_error : {1e-2, 1e-3, 1e-4}) {
            const LdHarmonic harmonic(picture.view(), 0.04, max_error, for_each_in_turn);
            for (const double alpha : {0.04, 0.16, 0.36, 1.0}) {
                const Errors found = errors(harmonic, blocks, alpha);
                EXPECT_LT(found.rms, max_error) << picture.name << " " << alpha;
                EXPECT_GE(found.lowest, 0);
            }
        }
    }
}

TEST(LdHarmonic, ResolvesNarrowLobes) {
    const Picture picture = sky("sun", 100, 30, 1e6f);
    const PatchBlocks blocks(picture.view());
    for (const double alpha : {0.0036, 0.01}) {
        const LdHarmonic harmonic(picture.view(), alpha, 1e-3, for_each_in_turn);
        EXPECT_LT(errors(harmonic, blocks, alpha).rms, 1e-3) << alpha;
    }
}

TEST(LdHarmonic, ResolvesNarrowLobesOverManyFineTexels) {
    const Picture lamps{"lamps", 1024, picture_of(1024, 512, [](const glm::dvec3& d) {
                            const double x = std::sin(20 * d.x) * std::sin(20 * d.y) * std::sin(20 * d.z);
                            return glm::dvec3(0.1 + 100 * std::pow(x, 6));
                        })};
    const PatchBlocks blocks(lamps.view());
    for (const double max_error : {1e-3, 1e-4}) {
        const LdHarmonic harmonic(lamps.view(), 0.0072, max_error, for_each_in_turn);
        EXPECT_GT(harmonic.level(0.0072, for_each_in_turn).near_radius(), 0);
        EXPECT_LT(errors(harmonic, blocks, 0.0072).rms, max_error);
    }
}

TEST(LdHarmonic, OfACubeMeetsTheErrorToo) {
    std::vector<float> cube = noise_cube(32);
    cube[100] = 1e6f;                    // a sun in the middle of a face
    cube[0] = cube[1] = cube[2] = 1e5f;  // and one at a corner
    const CubeView view{cube.data(), 32};
    const PatchBlocks blocks(view);
    for (const double max_error : {1e-2, 1e-3}) {
        const LdHarmonic harmonic(view, 0.04, max_error, for_each_in_turn);
        EXPECT_EQ(harmonic.bright_texels(), 2);
        for (const double alpha : {0.04, 0.36, 1.0})
            EXPECT_LT(errors(harmonic, blocks, alpha).rms, max_error) << alpha;
    }
}

std::vector<float> filtered(const LdHarmonic& harmonic, double alpha,
                            const std::vector<glm::dvec3>& directions) {
    std::vector<float> rgb(directions.size() * 3);
    harmonic.level(alpha, for_each_in_turn).integrate(directions, rgb);
    return rgb;
}

TEST(LdHarmonic, TurnsWithACubeTurnedByAQuarterAboutAnyAxis) {
    const std::vector<float> cube = noise_cube(16);
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 100; ++i) directions.push_back(random_direction(2, i));
    for (const glm::dmat3& turn :
         {glm::dmat3(1, 0, 0, 0, 0, 1, 0, -1, 0), glm::dmat3(0, 0, 1, 0, 1, 0, -1, 0, 0),
          glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1)}) {
        std::vector<float> turned(cube.size());
        for (int i = 0; i < 6 * 16 * 16; ++i) {
            const CubeTexel to{i / 256, i % 16, i / 16 % 16},
                from = cubemap_texel(turn * cubemap_texel_direction(to, 16), 16);
            for (int c = 0; c < 3; ++c)
                turned[i * 3 + c] = cube[((from.face * 16 + from.y) * 16 + from.x) * 3 + c];
        }
        std::vector<glm::dvec3> directions_turned;
        for (const glm::dvec3& d : directions) directions_turned.push_back(turn * d);
        for (const double alpha : {0.04, 0.5}) {
            const std::vector<float> a =
                filtered({CubeView{turned.data(), 16}, 0.04, 1e-4, for_each_in_turn}, alpha, directions);
            const std::vector<float> b =
                filtered({CubeView{cube.data(), 16}, 0.04, 1e-4, for_each_in_turn}, alpha, directions_turned);
            for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5f);
        }
    }
}

TEST(LdHarmonic, TurnsWithAnEquirectTurnedByWholeTexels) {
    const std::vector<float> picture = noise_picture(64, 32);
    std::vector<float> moved(picture.size());
    constexpr int kBy = 13;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            std::copy_n(&picture[(static_cast<std::size_t>(y) * 64 + x) * 3], 3,
                        &moved[(static_cast<std::size_t>(y) * 64 + (x + kBy) % 64) * 3]);
    const double angle = 2 * std::numbers::pi * kBy / 64;
    std::vector<glm::dvec3> directions, directions_moved;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 d = random_direction(2, i);
        directions.push_back(d);  // u grows where longitude atan2(x, z) falls
        directions_moved.push_back({std::cos(angle) * d.x - std::sin(angle) * d.z, d.y,
                                    std::sin(angle) * d.x + std::cos(angle) * d.z});
    }
    const std::vector<float> a =
        filtered({EquirectView{picture.data(), 64, 32}, 0.1, 1e-4, for_each_in_turn}, 0.1, directions);
    const std::vector<float> b =
        filtered({EquirectView{moved.data(), 64, 32}, 0.1, 1e-4, for_each_in_turn}, 0.1, directions_moved);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5f);
}

TEST(LdHarmonic, IsLinear) {
    const std::vector<float> a = noise_picture(64, 32, 1), b = noise_picture(64, 32, 2);
    std::vector<float> sum(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] = a[i] + b[i];
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 200; ++i) directions.push_back(random_direction(2, i));
    const auto of = [&](const std::vector<float>& picture) {
        return filtered({EquirectView{picture.data(), 64, 32}, 0.1, 1e-4, for_each_in_turn}, 0.1, directions);
    };
    const std::vector<float> fa = of(a), fb = of(b), fsum = of(sum);
    for (std::size_t i = 0; i < fa.size(); ++i) EXPECT_NEAR(fa[i] + fb[i], fsum[i], 3e-4f);
}

TEST(LdHarmonic, KeepsAConstantConstantAndBlackBlack) {
    for (const float value : {0.0f, 1e-20f, 0.7f, 1e30f})
        for (const int width : {1, 2, 3, 8, 50}) {
            const int height = std::max(1, width / 2);
            const std::vector<float> picture(static_cast<std::size_t>(width) * height * 3, value);
            const LdHarmonic harmonic(EquirectView{picture.data(), width, height}, 0.2, 1e-4,
                                      for_each_in_turn);
            for (const float found : filtered(harmonic, 0.2, {{1, 0, 0}, {0, 1, 0}, {0.6, 0, 0.8}}))
                EXPECT_NEAR(found, value, std::nextafter(value, 1e38f) - value) << width;  // an ulp
        }
}

TEST(LdHarmonic, StaysFiniteWithTheLargestTexel) {
    Picture picture{"huge", 64, noise_picture(64, 32)};
    add_texel(picture, 20, 10, 3e38f);
    const LdHarmonic harmonic(picture.view(), 0.04, 1e-3, for_each_in_turn);
    const PatchBlocks blocks(picture.view());
    for (const double alpha : {0.04, 1.0}) EXPECT_LT(errors(harmonic, blocks, alpha).rms, 1e-3);
    // Where the sun is below the horizon of every lobe, the rest is seen as if it weren't there.
    const glm::dvec3 away = -equirect_direction(20.5 / 64, 10.5 / 32);
    const std::vector<float> dark = filtered(harmonic, 0.16, {away});
    EXPECT_GT(dark[0], 0.3f);
    EXPECT_LT(dark[0], 0.7f);
}

TEST(LdHarmonic, ASunLeftInIsASunTakenOutAndPutBack) {
    const Picture without = sky("no sun", 0, 0, 0), with = sky("sun", 100, 30, 1e7f);
    const std::vector<CubeTexel> sun{{0, 100, 30}};
    std::vector<glm::dvec3> directions{equirect_direction(100.5 / 256, 30.5 / 128)};
    for (int i = 0; i < 100; ++i) directions.push_back(random_direction(2, i));
    const double mean = 1e7 * equirect_texel_solid_angle(256, 128, 30) / (4 * std::numbers::pi);
    for (const double max_error : {1e-3, 1e-4})
        for (const double alpha : {0.04, 0.5, 1.0}) {
            const std::vector<float> a =
                filtered({with.view(), 0.04, max_error, for_each_in_turn}, alpha, directions);
            const std::vector<float> b =
                filtered({without.view(), 0.04, max_error, for_each_in_turn}, alpha, directions);
            std::vector<double> of_sun(a.size()), behind_sun(a.size());
            std::uint64_t evaluations = 0;
            ld_partial(PatchBlocks(with.view(), sun), alpha, directions, of_sun, evaluations);
            ld_partial(PatchBlocks(without.view(), sun), alpha, directions, behind_sun, evaluations);
            for (std::size_t i = 0; i < a.size(); ++i) {
                // A horizon through the sun takes its share of the error, over the mean; else it is that of
                // the sun's own points, and what the sky rings for what its mean isn't.
                const bool is_cut = std::abs(glm::dot(directions[i / 3], directions[0])) < 0.025;
                const double allowed = is_cut ? 1e-4 * mean : 3e-5 * of_sun[i] + 2e-5;
                EXPECT_NEAR(a[i], b[i] + of_sun[i] - behind_sun[i], allowed) << i;
            }
        }
}

TEST(LdHarmonic, OneTexelBecomesARoundSpotWhereverItLies) {
    // At a corner, an edge and a pole of the cube, at the seam, and where the picture's rows meet.
    for (const glm::dvec3& at :
         {glm::dvec3(1, 1, 1), {1, 1, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0.3, -0.9, 0.1}}) {
        std::vector<float> picture(std::size_t{1024} * 512 * 3, 0.0f);
        const glm::dvec2 uv = equirect_point(at);
        const int x = std::min(1023, static_cast<int>(uv.x * 1024)),
                  y = std::min(511, static_cast<int>(uv.y * 512));
        picture[(static_cast<std::size_t>(y) * 1024 + x) * 3] = 1e6f;
        // The centre of the texel's area: a texel at a pole is a wedge.
        double sine_sum = 0, v_sum = 0;
        for (int k = 0; k < 64; ++k) {
            const double v = (y + (k + 0.5) / 64) / 512, sine = std::sin(std::numbers::pi * v);
            sine_sum += sine;
            v_sum += v * sine;
        }
        const glm::dvec3 centre = equirect_direction((x + 0.5) / 1024, v_sum / sine_sum);
        const glm::dvec3 side = glm::normalize(glm::cross(centre, glm::dvec3(0.31, 0.55, -0.7)));
        const LdHarmonic harmonic(EquirectView{picture.data(), 1024, 512}, 0.04, 1e-3, for_each_in_turn);
        for (const double angle : {0.03, 0.1, 0.5}) {
            std::vector<glm::dvec3> ring;
            for (int i = 0; i < 24; ++i) {
                const double turn = 2 * std::numbers::pi * i / 24;
                const glm::dvec3 out = std::cos(turn) * side + std::sin(turn) * glm::cross(centre, side);
                ring.push_back(std::cos(angle) * centre + std::sin(angle) * out);
            }
            const std::vector<float> found = filtered(harmonic, 0.04, ring);
            float low = found[0], high = found[0];
            for (std::size_t i = 0; i < found.size(); i += 3)
                low = std::min(low, found[i]), high = std::max(high, found[i]);
            EXPECT_LT(high / low, 1.01f) << angle;
        }
    }
}

TEST(LdHarmonic, EveryLevelHoldsTheLightOfThePicture) {
    for (const Picture& picture : pictures()) {
        double flux = 0;
        for (int y = 0; y < picture.width / 2; ++y)
            for (int x = 0; x < picture.width; ++x)
                flux += equirect_texel_solid_angle(picture.width, picture.width / 2, y) *
                        static_cast<double>(picture.view().texel(x, y)[1]);
        const LdHarmonic harmonic(picture.view(), 0.04, 1e-3, for_each_in_turn);
        constexpr int kSize = 128;
        const std::vector<glm::dvec3> directions = level_of(kSize);
        for (const double alpha : {0.04, 0.3, 1.0}) {
            const std::vector<float> found = filtered(harmonic, alpha, directions);
            double sum = 0;
            for (int i = 0; i < 6 * kSize * kSize; ++i)
                sum += cubemap_texel_solid_angle(kSize, i % kSize, i / kSize % kSize) *
                       static_cast<double>(found[static_cast<std::size_t>(i) * 3 + 1]);
            EXPECT_NEAR(sum / flux, 1, 1e-4) << picture.name << " " << alpha;
        }
    }
}

TEST(LdHarmonic, DoesNotDependOnTheOrderOfItsTasks) {
    const std::vector<float> picture = noise_picture(96, 48);
    const ForEach backwards = [](int count, const std::function<void(int)>& body) {
        for (int i = count - 1; i >= 0; --i) body(i);
    };
    const std::vector<glm::dvec3> directions{{1, 0, 0}, {0, 1, 0}, {0.6, 0, 0.8}};
    const LdHarmonic a(EquirectView{picture.data(), 96, 48}, 0.1, 1e-3, for_each_in_turn);
    const LdHarmonic b(EquirectView{picture.data(), 96, 48}, 0.1, 1e-3, backwards);
    std::vector<float> from_a(9), from_b(9);
    a.level(0.1, for_each_in_turn).integrate(directions, from_a);
    b.level(0.1, backwards).integrate(directions, from_b);
    EXPECT_EQ(from_a, from_b);
}

/// Texels of a level of `size` along a third of a face's height and over its edges onto the next ones.
std::vector<glm::dvec3> belt(int size) {
    std::vector<glm::dvec3> result;
    for (const int face : {4, 0, 5, 1})  // +Z, +X, -Z, -X: s runs on from each to the next
        for (int x = 0; x < size; ++x) result.push_back(cubemap_texel_direction({face, x, size / 3}, size));
    return result;
}

TEST(LdHarmonic, HasNoSeamsWhereFacesMeet) {
    // Steps from texel to texel, against those of the exact sum: no worse over edges than inside faces.
    constexpr int kSize = 64;
    const std::vector<glm::dvec3> at = belt(kSize);
    for (const Picture& picture : pictures()) {
        const PatchBlocks blocks(picture.view());
        for (const double alpha : {0.0064, 0.04}) {
            if (alpha < 0.04 && picture.name != "noise") continue;  // the near field's
            const LdHarmonic harmonic(picture.view(), alpha, 1e-3, for_each_in_turn);
            const std::vector<float> found = filtered(harmonic, alpha, at);
            std::vector<double> truth(found.size());
            std::uint64_t evaluations = 0;
            ld_exact(blocks, alpha, at, truth, evaluations);
            double inside = 0, across = 0, mean = 0;
            for (std::size_t i = 0; i < at.size(); ++i) {
                const std::size_t next = (i + 1) % at.size();
                const auto error = [&](std::size_t k) {
                    return static_cast<double>(found[k * 3]) - truth[k * 3];
                };
                double& worst = next % kSize == 0 ? across : inside;
                worst = std::max(worst, std::abs(error(next) - error(i)));
                mean += truth[i * 3] / static_cast<double>(at.size());
            }
            EXPECT_LE(across, std::max(inside, 1e-5 * mean)) << picture.name << " " << alpha;
        }
    }
}

TEST(LdHarmonic, MeetsTheErrorOnThousandsOfLamps) {
    for (const int count : {300, 3000}) {
        Picture lamps{"lamps", 512, std::vector<float>(std::size_t{512} * 256 * 3, 0.1f)};
        for (int i = 0; i < count; ++i)
            add_texel(lamps, static_cast<int>(512 * random_unit(7, i, 0)),
                      static_cast<int>(256 * random_unit(7, i, 1)), 1000);
        const LdHarmonic harmonic(lamps.view(), 0.04, 1e-3, for_each_in_turn);
        const PatchBlocks blocks(lamps.view());
        for (const double alpha : {0.04, 0.36})
            EXPECT_LT(errors(harmonic, blocks, alpha).rms, 1e-3) << count << " " << alpha;
    }
}

/// Noise of a spectrum that falls like a power of frequency, its logarithm scaled: exp(contrast noise).
Picture power_noise(int width, double slope, double contrast, std::uint64_t seed) {
    Picture picture{
        "noise of slope " + std::to_string(slope) + ", contrast " + std::to_string(contrast), width, {}};
    const int height = width / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double value = 0, norm = 0;
            for (int cells = 4; cells <= width; cells *= 2) {
                const double size = std::pow(cells, -slope);
                value += size * (2 * random_unit(seed + cells, x * cells / width, y * cells / width) - 1);
                norm += size * size;
            }
            for (int c = 0; c < 3; ++c)
                picture.rgb.push_back(static_cast<float>(std::exp(contrast * value / std::sqrt(norm))));
        }
    return picture;
}

/// Lamps of 1 to `side` texels a side over a dim ground, strengths apart by up to e^spread.
Picture random_lamps(int width, int count, int side, double spread, std::uint64_t seed) {
    Picture picture{std::to_string(count) + " lamps, seed " + std::to_string(seed), width,
                    std::vector<float>(static_cast<std::size_t>(width) * width / 2 * 3, 0.1f)};
    for (int i = 0; i < count; ++i) {
        const auto random = [&](int k, int below) {
            return static_cast<int>(below * random_unit(seed, i, k));
        };
        const float value = static_cast<float>(100 * std::exp(spread * (random_unit(seed, i, 9) - 0.5)));
        const int size = 1 + random(0, side), left = random(1, width), top = random(2, width / 2 - size);
        for (int y = top; y < top + size; ++y)
            for (int x = left; x < left + size; ++x) add_texel(picture, x % width, y, value);
    }
    return picture;
}

TEST(LdHarmonic, MeetsAnyErrorOnGeneratedPictures) {
    std::vector<Picture> all;
    for (int i = 0; i < 8; ++i) all.push_back(power_noise(128, 0.5 * (i % 4), i < 4 ? 0.5 : 2, 10 + i));
    for (int i = 0; i < 12; ++i) all.push_back(random_lamps(128, 1 << i, 1 + i % 4, 2.0 * (i % 5), 100 + i));
    double largest_share = 0;
    for (const Picture& picture : all) {
        const PatchBlocks blocks(picture.view());
        for (const double max_error : {1e-1, 1e-2, 1e-3, 1e-4}) {
            const LdHarmonic harmonic(picture.view(), 0.04, max_error, for_each_in_turn);
            for (const double alpha : {0.04, 0.16, 0.36, 0.64, 1.0}) {
                const double rms = errors(harmonic, blocks, alpha).rms;
                EXPECT_LT(rms, max_error) << picture.name << " " << alpha;
                if (max_error > 1e-4) largest_share = std::max(largest_share, rms / max_error);
            }
        }
    }
    EXPECT_GT(largest_share, 0.3);  // else it works for nothing
}

TEST(LdHarmonic, StaysAboveAnEvenGroundWhateverStandsOutOfIt) {
    // LD of ground plus light is ground plus what isn't negative: what falls below is ringing.
    const std::vector<glm::dvec3> directions = level_of(32);
    for (const int count : {1, 7, 40, 300})
        for (const double spread : {0.0, 8.0}) {
            const Picture picture = random_lamps(128, count, 1, spread, 5);
            for (const double max_error : {1e-2, 1e-3, 1e-4}) {
                const LdHarmonic harmonic(picture.view(), 0.04, max_error, for_each_in_turn);
                for (const double alpha : {0.04, 0.16, 1.0}) {
                    const std::vector<float> found = filtered(harmonic, alpha, directions);
                    const auto [lowest, highest] = std::ranges::minmax(found);
                    // Equal lamps are all apart. Dim ones beside much brighter ones aren't, and may ring by
                    // the error asked for.
                    const double allowed = spread > 0 ? max_error * 0.1 : 1e-5 * static_cast<double>(highest);
                    EXPECT_GT(lowest, 0.1 - allowed) << count << " " << spread << " " << alpha;
                }
            }
        }
}

TEST(LdHarmonic, LeavesAnEvenGroundEvenAroundASun) {
    const std::vector<glm::dvec3> directions = level_of(32);
    const Picture picture = random_lamps(128, 1, 1, 0, 5);
    std::vector<float> cube(std::size_t{6} * 32 * 32 * 3, 0.1f);
    cube[3000] = cube[3001] = cube[3002] = 1e4f;
    const LdHarmonic of_picture(picture.view(), 0.04, 1e-3, for_each_in_turn);
    const LdHarmonic of_cube(CubeView{cube.data(), 32}, 0.04, 1e-3, for_each_in_turn);
    for (const LdHarmonic* harmonic : {&of_picture, &of_cube})
        for (const double alpha : {0.04, 0.16, 1.0}) {
            EXPECT_EQ(harmonic->level(alpha, for_each_in_turn).bands(), 0);  // nothing is left to ring
            EXPECT_NEAR(std::ranges::min(filtered(*harmonic, alpha, directions)), 0.1f, 1e-7f) << alpha;
        }
}

TEST(LdHarmonic, ManyLampsCostLittleMoreThanSome) {
    const std::vector<glm::dvec3> directions = level_of(64);
    std::vector<float> found(directions.size() * 3);
    std::vector<std::uint64_t> evaluations;
    for (const int count : {16, 90, 720}) {
        const Picture picture = random_lamps(512, count, 1, 0.5, 3);
        const LdHarmonic harmonic(picture.view(), 0.04, 1e-3, for_each_in_turn);
        EXPECT_GT(harmonic.bright_texels(), count / 2);
        evaluations.push_back(harmonic.level(0.04, for_each_in_turn).integrate(directions, found));
        EXPECT_EQ(harmonic.level(0.16, for_each_in_turn).integrate(directions, found) > 0, count == 16);
    }
    EXPECT_LT(evaluations[1], evaluations[0]);
    EXPECT_LT(evaluations[2], 8 * evaluations[1]);
}

TEST(LdHarmonic, SaysWhatItLeftOut) {
    const std::vector<float> picture = noise_picture(64, 32);
    const LdHarmonic harmonic(EquirectView{picture.data(), 64, 32}, 0.04, 1e-3, for_each_in_turn);
    EXPECT_GE(harmonic.bands(), LdHarmonic::bands_for(0.04, 1e-3));
    const LdHarmonic::Level level = harmonic.level(1, for_each_in_turn);
    EXPECT_LT(level.bands(), harmonic.bands() / 4);  // a wide lobe of noise needs few degrees
    EXPECT_GT(level.truncation_error(), 1e-4);       // it spends what it is given
    EXPECT_LE(level.truncation_error(), 3.6e-4);
}

}  // namespace
}  // namespace pbr
