// The runner with bakers of the tests' own.

#include "bakers/run/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::run {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

Product flat_product(float value) {
    Image image;
    image.channels = {"R", "G", "B"};
    image.levels.push_back({8, 8, std::vector<float>(8 * 8 * 3, value)});
    Product product;
    product.images.push_back(std::move(image));
    return product;
}

/// A baker whose parts a test may replace.
Baker fake_baker() {
    Baker baker;
    baker.kind = "fake";
    baker.algorithm_version = 7;
    baker.check = [](const Json&) { return std::vector<Mistake>{}; };
    baker.reads = [](const Json&) { return std::vector<Read>{}; };
    baker.run = [](const Json& bake, const Inputs&, Context& context) {
        context.count("flat", 3);
        return flat_product(bake["value"].get<float>());
    };
    baker.certify = [](const Json&, const Inputs&, const Product&, Context& context) {
        context.count("flat", 2);
        const Figure figure{"max_abs_error", 0.25, Evidence::bound, "by hand", std::nullopt, std::nullopt};
        return Certificate{{figure}, figure};
    };
    return baker;
}

job::Bake make_bake(const Baker& baker, const std::string& name, float value = 1) {
    job::Bake bake;
    bake.baker = &baker;
    bake.kind = "fake";
    bake.name = name;
    bake.format = "exr";
    bake.file = name + ".exr";
    bake.params = {{"value", value}, {"pixel", "half"}};
    bake.json = bake.params;
    return bake;
}

job::Job make_job(const fs::path& output, std::vector<job::Bake> bakes) {
    job::Job job;
    job.file = "job.json";
    job.output = output;
    job.working_space = "lin_rec709";
    job.bakes = std::move(bakes);
    return job;
}

RunReport run_one(const job::Job& job, Options options = {}) { return run(std::span(&job, 1), options); }

std::vector<std::string> files_in(const fs::path& folder) {
    std::vector<std::string> names;
    if (fs::exists(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> listed(const fs::path& output) {
    std::vector<std::string> names;
    const Json manifest = job::parse_json(test::read_file(output / "manifest.json"), "manifest.json");
    for (const Json& product : manifest["products"]) names.push_back(product["name"].get<std::string>());
    return names;
}

TEST(Run, WritesProductsAndAManifestOfThem) {
    const test::TemporaryFolder folder;
    const Baker baker = fake_baker();
    const RunReport report =
        run_one(make_job(folder / "out", {make_bake(baker, "a"), make_bake(baker, "b")}));
    EXPECT_EQ(report.code, ExitCode::done);
    EXPECT_THAT(files_in(folder / "out"), ElementsAre("a.exr", "b.exr", "manifest.json"));

    const Json manifest = job::parse_json(test::read_file(folder / "out/manifest.json"), "manifest.json");
    const Json& entry = manifest["products"][0];
    EXPECT_EQ(entry["algorithm_version"], 7);
    EXPECT_EQ(entry["outputs"][0]["path"], "a.exr");
    EXPECT_EQ(entry["outputs"][0]["bytes"], fs::file_size(folder / "out/a.exr"));
    EXPECT_EQ(entry["outputs"][0]["xxh3"], io::hash_file(folder / "out/a.exr"));
    EXPECT_EQ(entry["certificate"]["headline"]["evidence"], "bound");
    EXPECT_EQ(entry["certificate"]["work"]["flat"], 3) << "the bake's work, not the certificate's";
}

TEST(Run, GoesOnAfterAFailure) {
    const test::TemporaryFolder folder;
    const Baker good = fake_baker();
    Baker bad = fake_baker();
    bad.run = [](const Json&, const Inputs&, Context&) -> Product {
        throw Error(ExitCode::unreadable_input, "x.hdr", "truncated");
    };
    Baker broken = fake_baker();
    broken.run = [](const Json&, const Inputs&, Context&) -> Product { throw std::runtime_error("oops"); };

    const RunReport report = run_one(make_job(folder.path(), {make_bake(bad, "a"), make_bake(good, "b")}));
    EXPECT_EQ(report.code, ExitCode::unreadable_input);
    EXPECT_EQ(report.bakes[0].error, "x.hdr: truncated");
    EXPECT_EQ(report.bakes[1].status, Status::done);
    EXPECT_THAT(files_in(folder.path()), ElementsAre("b.exr", "manifest.json"));
    EXPECT_THAT(listed(folder.path()), ElementsAre("b"));

    job::Job mixed = make_job(folder.path(), {make_bake(bad, "a"), make_bake(broken, "c")});
    EXPECT_EQ(run_one(mixed).code, ExitCode::mixed_failures);
}

TEST(Run, WritesNothingWhenNothingSucceeds) {
    const test::TemporaryFolder folder;
    Baker bad = fake_baker();
    bad.run = [](const Json&, const Inputs&, Context&) -> Product {
        throw Error(ExitCode::unreadable_input, "", "no");
    };
    run_one(make_job(folder / "out", {make_bake(bad, "a")}));
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Run, TakesAFailedBakeOutOfTheManifest) {
    const test::TemporaryFolder folder;
    const Baker good = fake_baker();
    Baker bad = fake_baker();
    bad.run = [](const Json&, const Inputs&, Context&) -> Product {
        throw Error(ExitCode::unreadable_input, "", "no");
    };
    run_one(make_job(folder.path(), {make_bake(good, "a")}));
    run_one(make_job(folder.path(), {make_bake(bad, "a")}));
    EXPECT_THAT(listed(folder.path()), ElementsAre());
    EXPECT_THAT(files_in(folder.path()), ElementsAre("a.exr", "manifest.json"))
        << "the old product is left alone";
}

TEST(Run, KeepsEntriesOfBakesItDidNotTryWhileTheyHold) {
    const test::TemporaryFolder folder;
    const Baker baker = fake_baker();
    const job::Job job =
        make_job(folder.path(), {make_bake(baker, "a"), make_bake(baker, "b"), make_bake(baker, "c")});
    Options only_b;
    only_b.only = {"b"};
    run_one(job);
    const std::string before = test::read_file(folder / "manifest.json");
    run_one(job, only_b);
    EXPECT_EQ(test::read_file(folder / "manifest.json"), before);

    folder.write("a.exr", "changed by hand");
    run_one(job, only_b);
    EXPECT_THAT(listed(folder.path()), ElementsAre("b", "c"));

    run_one(make_job(folder.path(), {make_bake(baker, "b"), make_bake(baker, "c", 2)}), only_b);
    EXPECT_THAT(listed(folder.path()), ElementsAre("b")) << "the job says another thing of c now";
}

TEST(Run, StopsWhenCancelledAndRecordsWhatWasDone) {
    const test::TemporaryFolder folder;
    std::atomic<bool> cancel{false};
    const Baker first = fake_baker();
    Baker second = fake_baker();
    second.run = [&](const Json&, const Inputs&, Context& context) -> Product {
        cancel = true;
        context.check_cancelled();
        return {};
    };
    Options options;
    options.cancel = &cancel;
    const RunReport report = run_one(
        make_job(folder.path(), {make_bake(first, "a"), make_bake(second, "b"), make_bake(first, "c")}),
        options);
    EXPECT_EQ(report.code, ExitCode::interrupted);
    EXPECT_EQ(report.bakes.size(), 2u);
    EXPECT_THAT(listed(folder.path()), ElementsAre("a"));
    EXPECT_THAT(files_in(folder.path()), ElementsAre("a.exr", "manifest.json"));
}

TEST(Run, FailsByAStatedErrorAlone) {
    const test::TemporaryFolder folder;
    const Baker baker = fake_baker();
    job::Job job = make_job(folder.path(), {make_bake(baker, "a")});
    EXPECT_EQ(run_one(job).code, ExitCode::done);
    job.bakes[0].accuracy = {"", 0.25};
    EXPECT_EQ(run_one(job).code, ExitCode::done);
    job.bakes[0].accuracy = {"", 0.2};
    const RunReport report = run_one(job);
    EXPECT_EQ(report.code, ExitCode::accuracy_missed);
    EXPECT_THAT(report.bakes[0].error, HasSubstr("max_abs_error is 0.25, above the max_error of 0.2"));
    EXPECT_THAT(listed(folder.path()), ElementsAre("a")) << "written all the same";
}

TEST(Run, HoldsAnErrorThatIsNoNumberAgainstTheBake) {
    const test::TemporaryFolder folder;
    Baker baker = fake_baker();
    baker.certify = [](const Json&, const Inputs&, const Product&, Context&) {
        const Figure figure{"max_abs_error", std::nan(""), Evidence::measured, "",
                            std::nullopt,    std::nullopt};
        return Certificate{{}, figure};
    };
    job::Job job = make_job(folder.path(), {make_bake(baker, "a")});
    job.bakes[0].accuracy = {"", 0.2};
    EXPECT_EQ(run_one(job).code, ExitCode::accuracy_missed);
}

TEST(Run, SkipsCertifyingWhenAskedTo) {
    const test::TemporaryFolder folder;
    Baker baker = fake_baker();
    baker.certify = [](const Json&, const Inputs&, const Product&, Context&) -> Certificate {
        throw std::runtime_error("not asked for");
    };
    job::Job job = make_job(folder.path(), {make_bake(baker, "a")});
    job.bakes[0].certify = job::Certify::none;
    const RunReport report = run_one(job);
    EXPECT_EQ(report.code, ExitCode::done);
    EXPECT_FALSE(report.bakes[0].seconds.contains(Stage::certify));
    EXPECT_FALSE(report.bakes[0].entry["certificate"].contains("headline"));
}

TEST(Run, TellsOfAScale) {
    const test::TemporaryFolder folder;
    const Baker baker = fake_baker();
    const RunReport report = run_one(make_job(folder.path(), {make_bake(baker, "a", 1e6f)}));
    EXPECT_LT(report.bakes[0].entry["scale"], 1.0);
    EXPECT_THAT(report.bakes[0].warnings, ElementsAre(HasSubstr("exceed what the pixel format holds")));
}

TEST(Run, PlansWithoutTouchingAnything) {
    const test::TemporaryFolder folder;
    const Baker baker = fake_baker();
    Options options;
    options.dry_run = true;
    const RunReport report = run_one(make_job(folder / "out", {make_bake(baker, "a")}), options);
    EXPECT_THAT(report.bakes[0].writes, ElementsAre(folder / "out/a.exr"));
    EXPECT_THAT(report.manifests, ElementsAre(folder / "out/manifest.json"));
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Run, RefusesAnUnknownName) {
    const Baker baker = fake_baker();
    Options options;
    options.only = {"bricks"};
    try {
        run_one(make_job("", {make_bake(baker, "brick")}), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_THAT(error.what(), HasSubstr("did you mean \"brick\"?"));
    }
}

TEST(Run, RefusesTwoJobsWithOneManifest) {
    const Baker baker = fake_baker();
    const std::vector<job::Job> jobs{make_job("out", {make_bake(baker, "a")}),
                                     make_job("./out/", {make_bake(baker, "b")})};
    EXPECT_THROW(run(jobs, {}), Error);
}

TEST(Run, NamesFurtherImagesAfterTheProduct) {
    const test::TemporaryFolder folder;
    Baker baker = fake_baker();
    baker.run = [](const Json&, const Inputs&, Context&) {
        Product product = flat_product(1);
        product.images.push_back(product.images.front());
        product.images.back().name = "depth";
        return product;
    };
    const RunReport report = run_one(make_job(folder.path(), {make_bake(baker, "a")}));
    EXPECT_EQ(report.code, ExitCode::done);
    EXPECT_THAT(files_in(folder.path()), ElementsAre("a.exr", "a_depth.exr", "manifest.json"));

    const RunReport clash =
        run_one(make_job(folder.path(), {make_bake(baker, "a"), make_bake(baker, "a_depth")}));
    EXPECT_EQ(clash.bakes[0].code, ExitCode::unwritable_output);
}

}  // namespace
}  // namespace pbrbake::run
