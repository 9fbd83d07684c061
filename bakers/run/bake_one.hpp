#pragma once
// One bake through all its stages.

#include "bakers/run/run.hpp"

namespace pbrbake::run {

/// What a bake will read and write, of the job alone.
BakeReport outline_bake(const job::Job& job, const job::Bake& bake);

/// What it will read and write, and what files a source names besides, which is opened for that. Throws
/// nothing: a source that can't be read fails, as it would the bake.
BakeReport plan_bake(const job::Job& job, const job::Bake& bake, const Options& options);

/// Runs it. Throws nothing: every failure is in the report.
BakeReport run_bake(const job::Job& job, const job::Bake& bake, const Options& options);

/// What a bake reads, decoded as run_bake decodes it. Throws Error, Cancelled.
Inputs decoded_inputs(const job::Job& job, const job::Bake& bake, const Options& options);

/// Time of the stage "bake" of run_bake alone, for who measures it again and again: nothing is certified or
/// written. Throws Error, Cancelled.
Seconds time_bake_stage(const job::Bake& bake, const Inputs& inputs, const Options& options);

}  // namespace pbrbake::run
