#pragma once
// What a texture bake kept of its set, and how the set was read, as a part of pages.

#include <memory>
#include <string>

#include "bakers/run/run.hpp"
#include "bakers/verify/display_transform.hpp"
#include "bakers/verify/legacy_pictures.hpp"

namespace pbrbake::verify {

/// The set of a texture bake that is done: its sources decoded again, its images read back. Throws Error,
/// Cancelled.
class ReadBackSet {
  public:
    ReadBackSet(const run::BakeReport& bake, int threads);
    const texture::BeforeAndAfter& operator*() const { return *set_; }
    const texture::BeforeAndAfter* operator->() const { return set_.get(); }
    Context& context() { return context_; }

  private:
    Context context_;
    Inputs inputs_;
    std::unique_ptr<const texture::BeforeAndAfter> set_;
};

/// Whether there is proof of a bake: a texture set, done.
bool has_proof(const run::BakeReport& bake);

/// Spheres before and after, their difference, and maps of what changed. Of a set whose files are gone by now
/// a sentence. Needs has_proof(), and takes about a CPU second beside decoding.
std::string texture_proof_html(const run::BakeReport& bake, const DisplayTransform& display, int threads);

/// What was read as what and why, of the record. Needs has_proof().
std::string texture_reading_html(const run::BakeReport& bake);

}  // namespace pbrbake::verify
