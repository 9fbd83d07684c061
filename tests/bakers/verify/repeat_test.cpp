#include "bakers/verify/repeat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pbr/numerics/sequence.hpp"

namespace pbrbake::verify {
namespace {

/// A machine on which time passes as told: tasks take their cost times its present slowness.
struct FakeMachine {
    double now_s = 0;
    double slowness = 1;
    std::uint64_t calls = 0;

    /// `noise` is the half width of an even spread, as a share.
    double run(double cost_s, double noise, int times) {
        const double factor = 1 + noise * (2 * pbr::random_unit(1, calls++) - 1);
        now_s += cost_s * factor * slowness * times;
        return cost_s * factor * slowness;
    }
    RepeatTask task(double cost_s, double noise, std::size_t base) {
        return {[this, cost_s, noise](int times) { return run(cost_s, noise, times); }, base};
    }
    std::function<double()> clock() {
        return [this] { return now_s; };
    }
};

TEST(Median, HasTheIntervalOfOrderStatistics) {
    std::vector<double> values;
    for (int i = 1; i <= 25; ++i) values.push_back(i);
    const Median median = median_of(values);
    EXPECT_EQ(median.value, 13);
    // Tables of the sign test: 8th and 18th of 25 hold the median with 95.7 %.
    EXPECT_EQ(median.low, 8);
    EXPECT_EQ(median.high, 18);
    EXPECT_DOUBLE_EQ(median.spread, 6. / 13);
}

TEST(Median, OfSixIsKnownByItsEndsAndOfFiveNotAtAll) {
    EXPECT_EQ(median_of({3, 1, 2, 6, 5, 4}).low, 1);
    EXPECT_EQ(median_of({3, 1, 2, 6, 5, 4}).high, 6);
    EXPECT_TRUE(std::isinf(median_of({3, 1, 2, 5, 4}).known_to()));
    EXPECT_EQ(median_of({}).count, 0);
}

TEST(Median, IsInItsIntervalNineteenTimesOfTwenty) {
    int held = 0;
    constexpr int kTrials = 2000;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
        std::vector<double> values;
        for (std::uint64_t i = 0; i < 15; ++i) values.push_back(pbr::random_unit(7, trial, i));
        const Median median = median_of(values);
        held += median.low <= .5 && .5 <= median.high;
    }
    EXPECT_GE(held, .95 * kTrials);  // 96.5 % by the binomial distribution
    EXPECT_LE(held, .98 * kTrials);
}

TEST(Repeat, EndsWhenAllIsKnown) {
    FakeMachine machine;
    const std::vector<RepeatTask> tasks{machine.task(1, .01, 0), machine.task(3, .01, 0)};
    const auto timings = repeat_until_known(tasks, {.budget_s = 1e9}, machine.clock());
    EXPECT_EQ(timings[1].seconds.count, 7);
    EXPECT_NEAR(timings[1].seconds.value, 3, .03);
    EXPECT_NEAR(timings[1].ratio.value, 3, .05);
    EXPECT_EQ(timings[0].ratio.value, 1);
}

TEST(Repeat, GoesOnWithWhatIsNoisyAndItsBaseAlone) {
    FakeMachine machine;
    const std::vector<RepeatTask> tasks{machine.task(1, .001, 0), machine.task(1, .001, 0),
                                        machine.task(1, .2, 0), machine.task(1, .001, 3)};
    const auto timings = repeat_until_known(tasks, {.most = 500, .budget_s = 1e9}, machine.clock());
    EXPECT_EQ(timings[1].seconds.count, 7);
    EXPECT_EQ(timings[3].seconds.count, 7);
    EXPECT_GT(timings[2].seconds.count, 20);
    EXPECT_GE(timings[0].seconds.count, 2 * timings[2].seconds.count);  // before and after
    EXPECT_LE(timings[2].ratio.known_to(), .05);
}

TEST(Repeat, RatiosStandOnAMachineThatDrifts) {
    FakeMachine machine;
    const auto drifting = [&](double cost) {
        return [&machine, cost](int times) {
            machine.slowness = 1 + .5 * std::sin(machine.now_s / 50);
            return machine.run(cost, .01, times);
        };
    };
    const std::vector<RepeatTask> tasks{{drifting(1), 0}, {drifting(2.5), 0}};
    const auto timings = repeat_until_known(tasks, {.most = 200, .budget_s = 1e9}, machine.clock());
    EXPECT_NEAR(timings[1].ratio.value, 2.5, .1);
    EXPECT_LE(timings[1].ratio.known_to(), .05);
}

TEST(Repeat, RatiosStandBesideWorkThatComesAndGoes) {
    FakeMachine machine;
    std::vector<RepeatTask> tasks;
    for (int i = 0; i < 12; ++i) {
        const double cost = .05 * (i + 1);
        tasks.push_back({[&machine, cost](int times) {  // another program runs for 3 s of every 7
                             machine.slowness = std::fmod(machine.now_s, 7) < 3 ? 1.8 : 1;
                             return machine.run(cost, .01, times);
                         },
                         0});
    }
    const auto timings = repeat_until_known(tasks, {.budget_s = 1e9}, machine.clock());
    for (std::size_t i = 0; i < tasks.size(); ++i)
        EXPECT_NEAR(timings[i].ratio.value / static_cast<double>(i + 1), 1, .03) << i;
}

TEST(Repeat, KeepsToItsBudgetButNotBelowTheFewestRounds) {
    FakeMachine machine;
    const std::vector<RepeatTask> tasks{machine.task(1, .5, 0), machine.task(1, .5, 0)};
    EXPECT_EQ(repeat_until_known(tasks, {.budget_s = 3}, machine.clock())[1].seconds.count, 7);
    machine.now_s = 0;
    EXPECT_EQ(repeat_until_known(tasks, {.known_to = 0, .most = 60, .budget_s = 1e9}, machine.clock())[1]
                  .seconds.count,
              60);
}

TEST(Repeat, MeasuresShortTasksManyTimesInOneGo) {
    FakeMachine machine;
    std::vector<int> asked;
    const std::vector<RepeatTask> tasks{{[&](int times) {
                                             asked.push_back(times);
                                             return machine.run(asked.size() == 1 ? 1e-2 : 1e-4, 0, times);
                                         },
                                         0}};
    const auto timings = repeat_until_known(tasks, {.least_s = .02}, machine.clock());
    EXPECT_EQ(asked[1], 2);  // as the first run, which is cold, has it
    EXPECT_EQ(asked[2], 200);
    EXPECT_EQ(asked.back(), 200);
    EXPECT_DOUBLE_EQ(timings[0].seconds.value, 1e-4);
}

TEST(Repeat, TellsHowItGoes) {
    FakeMachine machine;
    const std::vector<RepeatTask> tasks{machine.task(1, .01, 0)};
    std::vector<int> rounds;
    repeat_until_known(tasks, {}, machine.clock(),
                       [&](int round, std::size_t, double) { rounds.push_back(round); });
    EXPECT_THAT(rounds, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7));
}

}  // namespace
}  // namespace pbrbake::verify
