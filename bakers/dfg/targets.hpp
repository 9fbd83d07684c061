#pragma once
// How engines lay their tables out. README.md says in which of their sources each was read.

#include <vector>

#include "bakers/dfg/params.hpp"

namespace pbrbake::dfg {

/// What a target stands for where the job leaves it open; of Target::none, the defaults.
struct TargetLayout {
    int width, height;
    std::vector<Term> terms;
    Axis axis;
    Align align;
    Form form;
    bool flip_rows;
    Disney disney;
    Cloth cloth;
};

const TargetLayout& layout_of(Target target);

}  // namespace pbrbake::dfg
