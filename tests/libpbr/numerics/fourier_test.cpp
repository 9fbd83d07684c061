#include "pbr/numerics/fourier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

using Signal = std::vector<std::complex<double>>;

/// Transforms eight signals and returns that of a lane.
Signal transformed(const std::vector<Signal>& signals, int lane) {
    const int size = static_cast<int>(signals[0].size());
    const FourierPlan plan(size);
    std::vector<double> data(static_cast<std::size_t>(plan.batch_doubles())), work(data.size());
    for (int j = 0; j < size; ++j)
        for (int k = 0; k < kFourierLanes; ++k) {
            data[j * 16 + k] = signals[k][j].real();
            data[j * 16 + 8 + k] = signals[k][j].imag();
        }
    plan.transform(data.data(), work.data());
    Signal result(static_cast<std::size_t>(size));
    for (int j = 0; j < size; ++j) result[j] = {data[j * 16 + lane], data[j * 16 + 8 + lane]};
    return result;
}

std::vector<Signal> noise(int size) {
    std::vector<Signal> signals(kFourierLanes, Signal(static_cast<std::size_t>(size)));
    for (int k = 0; k < kFourierLanes; ++k)
        for (int j = 0; j < size; ++j)
            signals[k][j] = {random_unit(1, k, j) - 0.5, random_unit(2, k, j) - 0.5};
    return signals;
}

TEST(Fourier, IsTheSumItIsDefinedAs) {
    for (const int size : {1, 2, 3, 4, 5, 7, 8, 12, 30, 64, 77, 96, 250, 257}) {
        const std::vector<Signal> signals = noise(size);
        for (const int lane : {0, 3, 7}) {
            const Signal result = transformed(signals, lane);
            for (int k = 0; k < size; ++k) {
                std::complex<long double> sum = 0;
                for (int j = 0; j < size; ++j) {
                    const long double angle =
                        -2 * std::numbers::pi_v<long double> * (static_cast<long>(j) * k % size) / size;
                    sum += std::complex<long double>(signals[lane][j]) *
                           std::complex<long double>(std::cos(angle), std::sin(angle));
                }
                EXPECT_NEAR(std::abs(std::complex<double>(sum) - result[k]), 0,
                            3e-16 * std::log2(size + 1) * std::sqrt(size))
                    << size << " " << k;
            }
        }
    }
}

TEST(Fourier, TransformedTwiceIsTheSignalBackwards) {
    const int size = 4096;
    const std::vector<Signal> signals = noise(size);
    std::vector<Signal> once(kFourierLanes);
    for (int lane = 0; lane < kFourierLanes; ++lane) once[lane] = transformed(signals, lane);
    const Signal twice = transformed(once, 5);
    for (int j = 0; j < size; ++j)
        EXPECT_NEAR(std::abs(twice[j] / double(size) - signals[5][(size - j) % size]), 0, 3e-15);
}

TEST(Fourier, FastSizesHaveNoFactorAboveFive) {
    EXPECT_EQ(fast_fourier_size(1), 1);
    EXPECT_EQ(fast_fourier_size(7), 8);
    EXPECT_EQ(fast_fourier_size(121), 125);
    EXPECT_EQ(fast_fourier_size(361), 375);
}

}  // namespace
}  // namespace pbr
