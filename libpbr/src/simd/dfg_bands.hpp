// Rows of views cut into bands of one rule, for the DFG kernels. Included once a target by the kernels; hence
// the toggled guard.

#if defined(PBR_SIMD_DFG_BANDS_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PBR_SIMD_DFG_BANDS_HPP_
#undef PBR_SIMD_DFG_BANDS_HPP_
#else
#define PBR_SIMD_DFG_BANDS_HPP_
#endif

#include <hwy/highway.h>

#include "pbr/ibl/dfg.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Fills E and Fc with integrate(views, band).E and .Fc, lanes holding views of one band. Whichever views
/// share a vector, each lane is for itself.
template <class Integrate>
HWY_INLINE void integrate_by_bands(const double* NoV, std::size_t count, const DfgRule& rule, double* E,
                                   double* Fc, const Integrate& integrate) {
    const hn::ScalableTag<double> d;
    const std::size_t lanes = hn::Lanes(d);
    double buffer[hn::MaxLanes(d)];
    std::size_t view[hn::MaxLanes(d)];
    for (const DfgRule::Band& band : rule.bands) {
        std::size_t used = 0;
        const auto flush = [&]() HWY_ATTR {
            if (used == 0) return;
            for (std::size_t i = 0; i < lanes; ++i) buffer[i] = NoV[view[i < used ? i : 0]];
            const auto sums = integrate(hn::LoadU(d, buffer), band);
            hn::StoreU(sums.E, d, buffer);
            for (std::size_t i = 0; i < used; ++i) E[view[i]] = buffer[i];
            hn::StoreU(sums.Fc, d, buffer);
            for (std::size_t i = 0; i < used; ++i) Fc[view[i]] = buffer[i];
            used = 0;
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (&rule.band_of(NoV[i]) != &band) continue;
            view[used++] = i;
            if (used == lanes) flush();
        }
        flush();
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#endif
