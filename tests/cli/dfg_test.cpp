// pbrbake dfg, as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The settings of a table of 6 x 5 texels with three channels, in a pixel type.
Outcome bake(const fs::path& product, const std::string& pixel) {
    return run_program({"dfg", "--size", "6x5", "--terms", "ggx,disney_diffuse", "--disney", "renormalised",
                        "--min-perceptual-roughness", "0.1", "--pixel", pixel, "-o", product});
}

TEST(DfgCommand, WritesTheSameTableToEveryContainer) {
    const TemporaryFolder folder;
    for (const std::string pixel : {"half", "float", "unorm16"}) {
        std::vector<float> first;
        for (const char* extension : {"ktx2", "dds", "exr", "png"}) {
            if ((pixel == "unorm16") == (extension == std::string("exr")) ||
                (extension == std::string("png") && pixel != "unorm16"))
                continue;
            SCOPED_TRACE(pixel + " " + extension);
            const fs::path product = folder / ("table." + std::string(extension));
            const Outcome outcome = bake(product, pixel);
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            const io::ReadBack back = io::read_product(product);
            const std::size_t stored = back.image.channels.size();
            std::vector<float> texels;
            for (std::size_t i = 0; i < 30; ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    texels.push_back(back.image.levels[0].texels[i * stored + c]);
            if (first.empty()) first = texels;
            ASSERT_EQ(texels.size(), first.size());
            for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_NEAR(texels[i], first[i], 1e-7) << i;
            EXPECT_THAT(read_file(product.string() + ".json"), HasSubstr("\"pixel\": \"" + pixel + "\""));
        }
    }
}

/// What a C program prints that includes a header of ours, compiled as `language`.
std::string print_header(const TemporaryFolder& folder, const fs::path& header, const char* language) {
    const fs::path source = folder.write("main.c", "#include \"" + header.string() + R"("
#include <stdio.h>
int main(void) {
    int i;
    printf("%d %d %d\n", (int)table_width, (int)table_height, (int)table_channels);
    for (i = 0; i < (int)(sizeof table_texels / sizeof *table_texels); ++i)
        printf("%.9g\n", (double)table_texels[i]);
    return 0;
}
)");
    const fs::path program = folder / "program", output = folder / "printed";
    const std::string command = std::string(PBRBAKE_COMPILER) + " -x " + language +
                                " -Wall -Wextra -Werror -pedantic " + source.string() + " -o " +
                                program.string() + " && " + program.string() + " > " + output.string();
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(header);
    return read_file(output);
}

TEST(DfgCommand, WritesCHeadersThatCompile) {
    const TemporaryFolder folder;
    ASSERT_EQ(bake(folder / "table.h", "float").code, 0);
    ASSERT_EQ(bake(folder / "table.exr", "float").code, 0);
    const Image image = io::read_product(folder / "table.exr").image;
    for (const char* language : {"c", "c++"}) {
        std::istringstream printed(print_header(folder, folder / "table.h", language));
        int width = 0, height = 0, channels = 0;
        printed >> width >> height >> channels;
        EXPECT_EQ(width, 6);
        EXPECT_EQ(height, 5);
        ASSERT_EQ(channels, 3);
        for (const float texel : image.levels[0].texels) {
            double value = -1;
            printed >> value;
            EXPECT_EQ(static_cast<float>(value), texel);
        }
    }
    ASSERT_EQ(bake(folder / "table.h", "half").code, 0);
    EXPECT_THAT(print_header(folder, folder / "table.h", "c"), HasSubstr("\n15360\n"));  // the bits of 1
    ASSERT_EQ(bake(folder / "table.h", "unorm16").code, 0);
    EXPECT_THAT(read_file(folder / "table.h"), HasSubstr("0 to 65535 for 0 to 1"));
    EXPECT_THAT(read_file(folder / "table.h"), HasSubstr("pbrbake:scale \"0.5\""));  // Disney exceeds 1
}

TEST(DfgCommand, StatesAccuracyAsSampledOnTheCommandLine) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"dfg", "--accuracy", "0.02:sampled", "-o", folder / "table.exr"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json record = job::parse_json(read_file(folder / "table.exr.json"), "record");
    EXPECT_EQ(record["certificate"]["headline"]["metric"], "max_abs_error_sampled");
    EXPECT_LT(record["layout"]["size"][0], 48);
}

}  // namespace
}  // namespace pbrbake::test
