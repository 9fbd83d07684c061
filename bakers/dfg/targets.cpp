#include "bakers/dfg/targets.hpp"

#include <array>

namespace pbrbake::dfg {

const TargetLayout& layout_of(Target target) {
    using enum Term;
    static const std::array<TargetLayout, EnumNames<Target>::names.size()> layouts{
        // none: the axis and alignment that leave the least error between texels
        TargetLayout{128,
                     128,
                     {ggx},
                     Axis::sqrt_nov,
                     Align::ends,
                     Form::scale_bias,
                     false,
                     Disney::renormalised,
                     Cloth::charlie},
        // filament
        {128,
         128,
         {ggx, charlie},
         Axis::nov,
         Align::center,
         Form::mix,
         true,
         Disney::original,
         Cloth::neubelt},
        // unity-hdrp
        {64,
         64,
         {ggx, disney_diffuse},
         Axis::sqrt_nov,
         Align::ends,
         Form::mix,
         false,
         Disney::unity,
         Cloth::charlie},
        // unreal
        {128, 32, {ggx}, Axis::nov, Align::center, Form::scale_bias, false, Disney::original, Cloth::charlie},
        // bevy
        {64, 64, {ggx}, Axis::nov, Align::center, Form::scale_bias, false, Disney::original, Cloth::charlie},
        // babylon
        {256,
         256,
         {ggx, charlie},
         Axis::nov,
         Align::center,
         Form::mix,
         false,
         Disney::original,
         Cloth::neubelt},
        // o3de
        {256, 256, {ggx}, Axis::nov, Align::center, Form::scale_bias, true, Disney::original, Cloth::charlie},
    };
    return layouts[static_cast<std::size_t>(target)];
}

}  // namespace pbrbake::dfg
