// Products of every baker against those that are kept in the tree.

#include <gtest/gtest.h>

#include <set>

#include "bakers/registry.hpp"
#include "bakers/run/run.hpp"
#include "bakers/verify/compare.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PBRBAKE_SOURCE_DIR) / "tests/golden";

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
constexpr bool kIsPrimaryPlatform = true;
#else
constexpr bool kIsPrimaryPlatform = false;
#endif

TEST(Golden, ProductsAreAsTheyWere) {
    const TemporaryFolder folder;
    for (const auto& entry : fs::directory_iterator(kFolder))
        if (entry.is_regular_file()) fs::copy(entry.path(), folder.path());
    const job::Job job = job::load(folder / "job.json");
    run::Options options;
    options.threads = 2;
    ASSERT_EQ(run::run(std::span(&job, 1), options).code, ExitCode::done);

    const verify::Comparison comparison =
        verify::compare(folder / "baked", kFolder / "baked", verify::read_thresholds({}, {}));
    EXPECT_GE(comparison.products.size(), job.bakes.size());
    for (const verify::ProductComparison& product : comparison.products) {
        const bool is_right =
            kIsPrimaryPlatform ? product.verdict == verify::Verdict::identical : product.passed();
        EXPECT_TRUE(is_right) << verify::verdict_line(product)
                              << "\nIf that is as it should be: ./dev golden --update";
    }
}

TEST(Golden, ThereAreSomeOfEveryBaker) {
    std::set<std::string> kinds;
    for (const job::Bake& bake : job::load(kFolder / "job.json").bakes) kinds.insert(bake.kind);
    for (const Baker& baker : bakers()) EXPECT_TRUE(kinds.contains(std::string(baker.kind))) << baker.kind;
}

}  // namespace
}  // namespace pbrbake::test
