// Eight pairs of rings are transformed at once, a northern ring as the real part of a signal and its mirror
// image as the imaginary part.

#include "src/ibl/ring_modes.hpp"

#include <algorithm>

namespace pbr {
namespace {

constexpr int kElement = 2 * kFourierLanes;

int batches_of(int pairs) { return (pairs + kFourierLanes - 1) / kFourierLanes; }

/// Coefficients of one order from the transform of a batch of pairs: north = (Z_m + conj Z_-m) / 2, south =
/// (Z_m - conj Z_-m) / 2i.
void store_order(const std::vector<double>& data, int width, int order, std::complex<double> factor,
                 int channel, int first, int count, RingModes& modes) {
    const double* z = &data[static_cast<std::size_t>(order % width) * kElement];
    const double* mirrored = &data[static_cast<std::size_t>((width - order % width) % width) * kElement];
    const double fr = factor.real() / 2, fi = factor.imag() / 2;
    const auto store = [&](int parity, double re, double im, int pair) {
        modes.part(order, parity, 2 * channel)[pair] = fr * re - fi * im;
        modes.part(order, parity, 2 * channel + 1)[pair] = fr * im + fi * re;
    };
    for (int lane = 0; lane < count; ++lane) {
        const double a = z[lane], b = z[lane + kFourierLanes];
        const double c = mirrored[lane], d = mirrored[lane + kFourierLanes];
        const double north_re = a + c, north_im = b - d, south_re = b + d, south_im = c - a;
        store(0, north_re + south_re, north_im + south_im, first + lane);
        store(1, north_re - south_re, north_im - south_im, first + lane);
    }
}

}  // namespace

RingModes::RingModes(int orders, int pairs)
    : orders_(orders),
      stride_((pairs + kRingGroup - 1) / kRingGroup * kRingGroup),
      modes_(static_cast<std::size_t>(orders) * 2 * kParts * stride_) {}

RingModes analyse_rings(const RingSource& source, const ForEach& each) {
    const int pairs = source.pairs(), batches = batches_of(pairs);
    RingModes modes(static_cast<int>(source.factors.size()), pairs);
    const FourierPlan plan(source.width);
    each(3 * batches, [&](int batch) {
        const int channel = batch / batches, first = batch % batches * kFourierLanes;
        const int count = std::min(kFourierLanes, pairs - first);
        std::vector<double> data(static_cast<std::size_t>(plan.batch_doubles())), work(data.size());
        for (int lane = 0; lane < count; ++lane) {
            source.read(first + lane, channel, &data[lane]);
            source.read(source.height - 1 - first - lane, channel, &data[kFourierLanes + lane]);
        }
        plan.transform(data.data(), work.data());
        for (int m = 0; m < modes.orders(); ++m)
            store_order(data, source.width, m, source.factors[static_cast<std::size_t>(m)], channel, first,
                        count, modes);
    });
    return modes;
}

void synthesise_rings(RingModes& modes, int width, int height,
                      const std::function<void(int y, int channel, const double* in)>& write,
                      const ForEach& each) {
    const int pairs = height / 2, batches = batches_of(pairs);
    const FourierPlan plan(width);
    each(3 * batches, [&](int batch) {
        const int channel = batch / batches, first = batch % batches * kFourierLanes;
        const int count = std::min(kFourierLanes, pairs - first);
        std::vector<double> data(static_cast<std::size_t>(plan.batch_doubles())), work(data.size());
        // North as the real part of a signal, south as its imaginary part; the forward transform of swapped
        // parts is the inverse. Real signals have conjugate coefficients at -m.
        for (int m = 0; m < modes.orders(); ++m) {
            const double *even_re = modes.part(m, 0, 2 * channel),
                         *even_im = modes.part(m, 0, 2 * channel + 1);
            const double *odd_re = modes.part(m, 1, 2 * channel), *odd_im = modes.part(m, 1, 2 * channel + 1);
            double* plus = &data[static_cast<std::size_t>(m) * kElement];
            double* minus = &data[static_cast<std::size_t>((width - m) % width) * kElement];
            for (int lane = 0; lane < count; ++lane) {
                const int pair = first + lane;
                const double north_re = (even_re[pair] + odd_re[pair]) / 2,
                             south_re = (even_re[pair] - odd_re[pair]) / 2;
                const double north_im = (even_im[pair] + odd_im[pair]) / 2,
                             south_im = (even_im[pair] - odd_im[pair]) / 2;
                plus[lane] += north_im + south_re;
                plus[lane + kFourierLanes] += north_re - south_im;
                minus[lane] += south_re - north_im;
                minus[lane + kFourierLanes] += north_re + south_im;
            }
        }
        plan.transform(data.data(), work.data());
        for (int lane = 0; lane < count; ++lane) {
            write(first + lane, channel, &data[kFourierLanes + lane]);
            write(height - 1 - first - lane, channel, &data[lane]);
        }
    });
}

}  // namespace pbr
