#include "bakers/probe/source_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bakers/probe/probe.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::probe {
namespace {

constexpr int kSize = 8;

ProbeParams defaults() {
    ProbeParams params{};
    params.source = "test.exr";
    params.colour_space = "auto";
    params.size = kSize;
    params.levels = 3;
    params.integrator = Integrator::harmonic;
    params.samples = {0};
    params.level_bias = 1;
    return params;
}

SourceImage picture(int width, int height, int faces = 1) {
    SourceImage source;
    source.image.channels = {"R", "G", "B"};
    source.image.faces = faces;
    source.image.levels.push_back(
        {width, height, std::vector<float>(static_cast<std::size_t>(width) * height * faces * 3)});
    return source;
}

/// What a texel of the cube that all layouts hold is: its direction.
glm::vec3 value_of(int face, int x, int y) {
    return glm::vec3(pbr::cubemap_texel_direction({face, x, y}, kSize)) + glm::vec3(2);
}

void put(SourceImage& source, int column, int row, int face, bool turned = false) {
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const glm::vec3 value =
                turned ? value_of(face, kSize - 1 - x, kSize - 1 - y) : value_of(face, x, y);
            for (int c = 0; c < 3; ++c)
                source.image.texel(0, 0, row * kSize + y, column * kSize + x)[c] = value[c];
        }
}

SourceImage lying_cross() {
    SourceImage source = picture(4 * kSize, 3 * kSize);
    put(source, 1, 0, 2), put(source, 0, 1, 1), put(source, 1, 1, 4), put(source, 2, 1, 0),
        put(source, 3, 1, 5), put(source, 1, 2, 3);
    return source;
}

SourceImage standing_cross() {
    SourceImage source = picture(3 * kSize, 4 * kSize);
    put(source, 1, 0, 2), put(source, 0, 1, 1), put(source, 1, 1, 4), put(source, 2, 1, 0),
        put(source, 1, 2, 3), put(source, 1, 3, 5, true);
    return source;
}

std::vector<Level> baked(const Inputs& inputs, ProbeParams params = defaults()) {
    Context context(1, {});
    return bake(params, inputs, context).images[0].levels;
}

std::string refusal(const SourceImage& source, SourceLayout layout) {
    ProbeParams params = defaults();
    params.source_layout = layout;
    SourceImage storage;
    try {
        environment_source(params, {{"source", source}}, storage);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        return error.message();
    }
    return "";
}

TEST(SourceLayout, TheSameCubeInAnyLayoutGivesTheSameBytes) {
    SourceImage cube = picture(kSize, kSize, 6), column = picture(kSize, 6 * kSize),
                row = picture(6 * kSize, kSize);
    Inputs six;
    const char* const names[] = {"px", "nx", "py", "ny", "pz", "nz"};
    for (int face = 0; face < 6; ++face) {
        put(column, 0, face, face), put(row, face, 0, face);
        SourceImage one = picture(kSize, kSize);
        put(one, 0, 0, face);
        std::copy(one.image.levels[0].texels.begin(), one.image.levels[0].texels.end(),
                  cube.image.texel(0, face, 0, 0));
        six.emplace(std::string("source.") + names[face], one);
    }
    const std::vector<Level> expected = baked({{"source", cube}});
    ProbeParams pattern = defaults();
    pattern.source = "room_{face}.exr";
    for (const std::vector<Level>& levels :
         {baked({{"source", column}}), baked({{"source", row}}), baked({{"source", lying_cross()}}),
          baked({{"source", standing_cross()}}), baked(six, pattern)})
        for (std::size_t l = 0; l < levels.size(); ++l) EXPECT_EQ(levels[l].texels, expected[l].texels) << l;
}

TEST(SourceLayout, NeighboursInACrossAreNeighboursOnTheCube) {
    // The second witness of where faces lie and how they are turned: directions go on smoothly within a
    // cross.
    for (const SourceImage& cross : {lying_cross(), standing_cross()}) {
        const Level& level = cross.image.levels[0];
        const auto at = [&](int x, int y) {
            const float* v = cross.image.texel(0, 0, y, x);
            return glm::vec3(v[0], v[1], v[2]);
        };
        int edges = 0;
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                for (const auto& [nx, ny] : {std::pair{x + 1, y}, {x, y + 1}}) {
                    if (nx >= level.width || ny >= level.height) continue;
                    const glm::vec3 a = at(x, y), b = at(nx, ny);
                    if (a == glm::vec3(0) || b == glm::vec3(0)) continue;  // outside the cross
                    edges += x / kSize != nx / kSize || y / kSize != ny / kSize;
                    ASSERT_LT(glm::length(a - b), 2.5 / kSize) << x << " " << y << " to " << nx << " " << ny;
                }
        EXPECT_EQ(edges, 5 * kSize);
    }
}

TEST(SourceLayout, RefusalsNameWhatWasFoundAndWhatIsAllowed) {
    EXPECT_NE(
        refusal(picture(10, 7), SourceLayout::automatic).find("is 10 x 7 texels; allowed: twice as wide"),
        std::string::npos);
    EXPECT_NE(refusal(picture(10, 7), SourceLayout::strip).find("n x 6n"), std::string::npos);
    EXPECT_NE(refusal(picture(16, 8), SourceLayout::cross).find("3n x 4n"), std::string::npos);
    EXPECT_NE(refusal(picture(16, 8), SourceLayout::cube).find("{face}"), std::string::npos);
    EXPECT_NE(refusal(picture(8, 8, 6), SourceLayout::equirect).find("says that it is a cube map"),
              std::string::npos);
    EXPECT_EQ(refusal(picture(1001, 499), SourceLayout::equirect), "");
    EXPECT_EQ(refusal(picture(8, 8, 6), SourceLayout::cube), "");
}

TEST(SourceLayout, FacesMustBeSquareAndOfOneSize) {
    ProbeParams params = defaults();
    params.source = "room_{face}.exr";
    const std::vector<Read> files = source_files(params);
    ASSERT_EQ(files.size(), 6u);
    EXPECT_EQ(files[3].path, "room_ny.exr");
    const auto message = [&](int width, int height) {
        Inputs inputs;
        for (const Read& file : files) inputs.emplace(file.field, picture(4, 4));
        inputs.at("source.ny") = picture(width, height);
        SourceImage storage;
        try {
            environment_source(params, inputs, storage);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message(4, 4), "");
    EXPECT_NE(message(4, 3).find("room_ny.exr"), std::string::npos);
    EXPECT_NE(message(4, 3).find("is 4 x 3 texels; allowed for a face"), std::string::npos);
    EXPECT_NE(message(5, 5).find("the size of room_px.exr, 4 x 4"), std::string::npos);
}

}  // namespace
}  // namespace pbrbake::probe
