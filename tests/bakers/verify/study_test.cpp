#include "bakers/verify/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/registry.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/verify/study_effects.hpp"
#include "bakers/verify/study_job.hpp"
#include "bakers/verify/study_plot.hpp"
#include "bakers/verify/study_report.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::verify {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

const RepeatLimits kOneRound{.fewest = 1, .most = 1, .budget_s = 1, .least_s = 0};

/// A probe of 16 texels: four levels of perceptual roughness 0, 1/3, 2/3 and 1.
StudyCase small_probe() {
    StudyCase asked;
    asked.name = "probe";
    asked.title = "A <small> probe";
    asked.bake = {
        {"kind", "probe"}, {"source", "builtin:indoor"}, {"size", 16}, {"levels", 4}, {"pixel", "float"}};
    asked.reference = Json{{"integrator", "reference"}};
    for (const char* integrator : {"is", "fis"}) {
        Series series{integrator, "samples", {}};
        for (const int samples : {4, 16, 64})
            series.steps.push_back(
                {std::to_string(samples), {{"integrator", integrator}, {"samples", samples}}, ""});
        asked.series.push_back(std::move(series));
    }
    return asked;
}

StudyCase small_table() {
    StudyCase asked;
    asked.name = "table";
    asked.title = "A small table";
    asked.bake = {{"kind", "dfg"}, {"size", 8}, {"pixel", "float"}};
    asked.free_figure = "analytic_fit_error";
    asked.free_title = "a fit";
    Series series{"quadrature", "accuracy", {}};
    for (const double error : {1e-2, 1e-4, 1e-6})
        series.steps.push_back({"e", {{"accuracy", {{"max_error", error}}}}, ""});
    series.steps.push_back({"bad", {{"size", -1}}, ""});
    asked.series.push_back(std::move(series));
    return asked;
}

StudyOptions options_in(const TemporaryFolder& folder) {
    StudyOptions options;
    options.folder = folder.path();
    options.limits = kOneRound;
    return options;
}

/// Prefiltered radiance at a direction, by midpoints of quarters of the source's texels, the kernel as
/// bakers/probe/README.md has it: no code of the reference's.
glm::dvec3 radiance_by_midpoints(const Image& source, double alpha, const glm::dvec3& n) {
    constexpr int kParts = 2;
    const int width = source.levels[0].width * kParts, height = source.levels[0].height * kParts;
    std::vector<glm::dvec2> turns;  // cosine and sine of each column, taken from a row on the horizon
    for (int x = 0; x < width; ++x) {
        const glm::dvec3 d = pbr::equirect_direction((x + .5) / width, .5);
        turns.emplace_back(d.x, d.z);
    }
    glm::dvec3 sum(0);
    double weights = 0;
    for (int y = 0; y < height; ++y) {
        const double polar = std::numbers::pi * (y + .5) / height, sine = std::sin(polar),
                     up = std::cos(polar);
        for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            const double mu = n.x * sine * turns[i].x + n.y * up + n.z * sine * turns[i].y;
            if (mu <= 0) continue;
            const double f = alpha * alpha + (1 - alpha * alpha) * (1 - mu) / 2;
            const double weight = mu / (f * f) * sine;
            const float* texel = source.texel(0, 0, y / kParts, x / kParts);
            sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
            weights += weight;
        }
    }
    return sum / weights;
}

TEST(Study, ErrorsAgreeWithAnIndependentEvaluationAtTenRandomPoints) {
    const TemporaryFolder folder;
    StudyOptions options = options_in(folder);
    std::vector<BakedImage> products;
    BakedImage reference;
    options.inspect = [&](const StudiedCase&, const StudyPoint&, const BakedImage& product,
                          const BakedImage* truth, const auto&) {
        products.push_back(product);
        reference = *truth;
    };
    run_study({small_probe()}, options);
    ASSERT_EQ(products.size(), 6u);
    const Image source = find_baker("probe")->builtin("indoor").image;
    int judged = 0;  // to 1 %
    for (std::uint64_t i = 0; i < 10; ++i) {
        const auto pick = [i](std::uint64_t what, std::size_t count) {
            return static_cast<std::size_t>(pbr::random_bits(11, i, what) % count);
        };
        const std::size_t method = pick(0, products.size());
        const int level = 1 + static_cast<int>(pick(1, 3)), size = 16 >> level;
        const int face = static_cast<int>(pick(2, 6)), x = static_cast<int>(pick(3, size)),
                  y = static_cast<int>(pick(4, size));
        const auto channel = pick(5, 3);
        const double p = level / 3.0;
        const double truth = radiance_by_midpoints(
            source, p * p, pbr::cubemap_texel_direction({face, x, y}, size))[static_cast<int>(channel)];
        const std::size_t index = ((static_cast<std::size_t>(face) * size + y) * size + x) * 3 + channel;
        const BakedImage& product = products[method];
        const double stored =
            product.image.levels[static_cast<std::size_t>(level)].texels[index] / product.scale;
        const double error = value_error(product, reference, level, index);
        // The reference promises 3e-5 of the value; an error smaller than a hundred of that can't be had to 1
        // %.
        judged += .01 * std::abs(stored - truth) >= 3e-5 * truth;
        EXPECT_NEAR(error, stored - truth, std::max(.01 * std::abs(stored - truth), 3e-5 * truth))
            << "method " << method << " level " << level << " face " << face << " " << x << ", " << y;
    }
    EXPECT_GE(judged, 5);
}

double mean_of(const BakedImage& baked, int level) {
    double sum = 0;
    const std::vector<float>& texels = baked.image.levels[static_cast<std::size_t>(level)].texels;
    for (const float value : texels) sum += value / baked.scale;
    return sum / static_cast<double>(texels.size());
}

TEST(Study, ErrorIsWhatAFullCertificateFinds) {
    const TemporaryFolder folder;
    StudyCase asked = small_probe();
    asked.series.front().steps.resize(1);
    asked.series.pop_back();
    StudyOptions options = options_in(folder);
    double product_mean = 0, true_mean = 0;
    options.inspect = [&](const StudiedCase&, const StudyPoint& point, const BakedImage& product,
                          const BakedImage* reference, const auto&) {
        product_mean = mean_of(product, point.level);
        true_mean = mean_of(*reference, point.level);
    };
    const StudyPoint point = run_study({asked}, options).cases[0].points[0];
    Json bake = with_overrides(asked.bake, point.step.overrides);
    bake["certify"] = "full";
    const job::Job job = single_bake_job({}, bake, "certified", folder.path());
    const Json headline = run::run_bake(job, job.bakes[0], {}).entry["certificate"]["headline"];
    // The certificate is over the product's mean, which is all it has; the study over the reference's.
    EXPECT_NEAR(point.error * true_mean, headline["value"].get<double>() * product_mean,
                1e-4 * point.error * true_mean);
}

TEST(Study, IsTheSameAsJsonCsvTableAndPage) {
    const TemporaryFolder folder;
    StudyOptions options = options_in(folder);
    PictureBook pictures(1'000'000);
    options.inspect = [&](auto&&... seen) { pictures.take(seen...); };
    const Study study = run_study({small_probe(), small_table()}, options);
    ASSERT_EQ(study.cases.size(), 2u);
    EXPECT_EQ(study.cases[1].points.size(), 4u);
    EXPECT_THAT(study.cases[1].points[3].failure, HasSubstr("/size"));
    EXPECT_GT(study.cases[1].free_error.value_or(0), .1);

    const Json json = study_json(study);
    const std::string schema_file = PBRBAKE_SOURCE_DIR "/schemas/study.schema.json";
    const job::Schema schema(job::parse_json(job::read_text(schema_file), schema_file));
    for (const Mistake& mistake : schema.mistakes(json))
        ADD_FAILURE() << mistake.pointer << " " << mistake.message;
    EXPECT_DOUBLE_EQ(json["cases"][0]["points"][2]["error"].get<double>(), study.cases[0].points[2].error);

    std::istringstream csv(study_csv(study));
    std::size_t rows = 0, commas = 0;
    for (std::string line; std::getline(csv, line); ++rows) {
        // Only the failure's text is quoted, and it has the last column.
        const std::string plain = line.substr(0, line.find('"'));
        const auto found = static_cast<std::size_t>(std::count(plain.begin(), plain.end(), ','));
        if (rows == 0) commas = found;
        EXPECT_EQ(found, commas) << line;
    }
    EXPECT_EQ(rows, 1 + 6 + 4u);

    const std::string page = study_page(study, pictures, "pbrbake study", "");
    for (const char* word : {"http:", "https:", "url(", "@import", "A <small>", ">NaN", " Inf"})
        EXPECT_EQ(page.find(word), std::string::npos) << word;
    for (const char* word : {"A &lt;small&gt; probe", "data-tip=", "data:image/png;base64,", "study.csv"})
        EXPECT_NE(page.find(word), std::string::npos) << word;
    EXPECT_THAT(plot_file(study.cases[1]), HasSubstr("a fit: 0.5"));
    EXPECT_THAT(study_table(study), HasSubstr("failed"));
}

TEST(Study, RatiosAreToTheBase) {
    const TemporaryFolder folder;
    StudyCase asked = small_table();
    asked.series[0].steps.pop_back();
    asked.base_step = 1;
    const Study study = run_study({asked}, options_in(folder));
    EXPECT_EQ(study.cases[0].base, 1u);
    EXPECT_EQ(study.cases[0].points[1].timing.ratio.value, 1);
    for (const StudyPoint& point : study.cases[0].points) EXPECT_GT(point.timing.ratio.value, 0);
}

TEST(Study, EndsWhereItsBaseCantBeBaked) {
    const TemporaryFolder folder;
    StudyCase asked = small_table();
    asked.base_step = 3;
    EXPECT_THROW(run_study({asked}, options_in(folder)), Error);
}

TEST(Study, StopsWhenItIsTold) {
    const TemporaryFolder folder;
    const std::atomic<bool> cancel{true};
    StudyOptions options = options_in(folder);
    options.cancel = &cancel;
    EXPECT_THROW(run_study({small_table()}, options), Cancelled);
    EXPECT_THROW(study_effects(options), Cancelled);
}

TEST(Suite, HasAReferenceAndABaseThatItsDialsReach) {
    const TemporaryFolder folder;
    for (const Depth depth : {Depth::quick, Depth::full})
        for (const StudyCase& asked : suite_cases(depth, folder.path())) {
            ASSERT_LT(asked.base_series, asked.series.size()) << asked.name;
            EXPECT_FALSE(asked.base_series == 0 && asked.base_step == 0) << asked.name;  // else none was set
            for (const Series& series : asked.series)
                for (const Step& step : series.steps)
                    EXPECT_NO_THROW(single_bake_job(asked.around, with_overrides(asked.bake, step.overrides),
                                                    "x", folder.path()))
                        << asked.name << " " << series.name << " " << step.label;
        }
}

TEST(Suite, ShowsNoFolderOfTheMachine) {
    const TemporaryFolder folder;
    for (const StudyCase& asked : suite_cases(Depth::quick, folder.path()))
        EXPECT_EQ(job::to_line(without_folders(asked.bake)).find(folder.path().string()), std::string::npos);
}

TEST(Suite, TriesEveryIntegratorThatTheSchemaLists) {
    const TemporaryFolder folder;
    const Json& properties = job::job_schema().root()["definitions"]["probe"]["properties"];
    const StudyCase asked = suite_cases(Depth::quick, folder.path())[0];
    for (const Json& integrator : properties["integrator"]["enum"]) {
        if (integrator == "reference") continue;
        EXPECT_EQ(std::count_if(asked.series.begin(), asked.series.end(),
                                [&](const Series& series) { return series.name == integrator; }),
                  1)
            << integrator;
    }
}

TEST(JobCases, TurnTheDialsOfAJobsOwnBakes) {
    const TemporaryFolder folder;
    folder.write("job.json", R"({"version": 1, "bakes": [
        {"kind": "dfg", "name": "table", "size": 16},
        {"kind": "probe", "name": "sky", "source": "builtin:outdoor", "size": 16, "samples": 99}]})");
    const auto cases = job_cases(folder / "job.json", Depth::quick);
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_FALSE(cases[0].reference);
    EXPECT_TRUE(cases[1].reference);
    EXPECT_EQ(cases[1].series[0].steps[0].overrides, Json::object());
    for (const StudyCase& asked : cases)
        for (const Series& series : asked.series)
            for (const Step& step : series.steps)
                EXPECT_NO_THROW(single_bake_job(asked.around, with_overrides(asked.bake, step.overrides), "x",
                                                folder.path()))
                    << asked.name << " " << series.name << " " << step.label;
}

TEST(Effects, ThatAreOffAreNotEvaluatedAndChangeNothing) {
    const TemporaryFolder folder;
    const auto groups = study_effects(options_in(folder));
    ASSERT_EQ(groups.size(), 4u);
    for (const EffectCost& row : groups.back().rows) {
        EXPECT_TRUE(row.rest_unchanged) << row.name;
        if (&row == &groups.back().rows[0]) {
            EXPECT_EQ(row.evaluations.size(), 1u);
            EXPECT_TRUE(row.evaluations.contains("ggx"));
        } else if (row.evaluations.contains("ggx")) {  // the one term that is asked for, and no other
            EXPECT_EQ(row.evaluations.size(), 2u) << row.name;
            EXPECT_EQ(row.evaluations.at("ggx"), groups.back().rows[0].evaluations.at("ggx"));
        }
    }
    EXPECT_THAT(groups[0].rows[0].evaluations, testing::ElementsAre(testing::Pair("f", 1)));
    EXPECT_EQ(effects_json(groups).size(), 4u);
    EXPECT_THAT(effects_html(groups), HasSubstr("clear coat"));
}

}  // namespace
}  // namespace pbrbake::verify
