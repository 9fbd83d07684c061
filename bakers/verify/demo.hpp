#pragma once
// The demo: a job on built-in inputs, and a page that shows what it made, what it cost and how far off it is.

#include <string>

#include "bakers/baker.hpp"
#include "bakers/run/run.hpp"

namespace pbrbake::verify {

/// The job, as a user would write it: a table, and each built-in environment by 32 and 1,024 filtered samples
/// and, if wanted, by the reference, which takes ten times as long as all the rest. Products go beside the
/// job file.
Json demo_job(bool with_reference);

/// The page (HTML) of a run of that job. Reads the products back. All bakes must be done.
std::string demo_page(const run::RunReport& report);

}  // namespace pbrbake::verify
