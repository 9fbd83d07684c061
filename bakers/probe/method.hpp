#pragma once
// How the levels of a probe are had: what a job's integrator, samples and accuracy come to.

#include <string>

#include "bakers/context.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/params.hpp"

namespace pbrbake::probe {

struct Method {
    Integrator integrator;  ///< never automatic
    double max_error;       ///< root mean square over mean that was asked for
    std::string reason;     ///< why auto chose it, else empty
};

/// Root mean square error over the mean that an accuracy stands for: 1e-2, 1e-3, 1e-4, or what the job
/// states.
double error_asked(const Accuracy& accuracy);

/// The method of a job on a machine of any kind: it depends on nothing else.
Method method_of(const ProbeParams& params, const Accuracy& accuracy);

/// Samples a texel of a level for `is`, `mis` and `fis`: the job's, or those that usually reach the accuracy.
int samples_of_level(const ProbeParams& params, const Accuracy& accuracy, int level);

}  // namespace pbrbake::probe
