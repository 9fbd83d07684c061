#pragma once
// One bake through all its stages.

#include "bakers/run/run.hpp"

namespace pbrbake::run {

/// What a bake will read and write, before it runs.
BakeReport plan_bake(const job::Job& job, const job::Bake& bake);

/// Runs it. Throws nothing: every failure is in the report.
BakeReport run_bake(const job::Job& job, const job::Bake& bake, const Options& options);

}  // namespace pbrbake::run
