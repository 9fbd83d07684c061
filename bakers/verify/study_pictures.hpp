#pragma once
// Pictures of a study: what each step of a dial looks like.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bakers/verify/display_transform.hpp"
#include "bakers/verify/study.hpp"

namespace pbrbake::verify {

/// Takes pictures while a study runs. A probe's step has a filtered level unfolded, its difference from the
/// reference, and a metal ball by the split sum; a texture set a sphere before and after, their difference,
/// and at the case's first step the whole proof; a light its curve; another flat product is shown as it is.
/// At most five steps of a series, and no more bytes than `most_bytes` in all.
class PictureBook {
  public:
    explicit PictureBook(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    /// For StudyOptions::inspect.
    void take(const StudiedCase& studied, const StudyPoint& point, const BakedImage& product,
              const BakedImage* reference, const run::BakeReport& report);

    /// What spheres of texture sets go through.
    const char* display_name() const { return display_.name(); }

    /// What a case of a texture set kept, by its first step, as HTML; "" of other cases.
    std::string proof(const StudiedCase& studied) const;

    /// The pictures of a case as HTML, a row a series; "" if there are none.
    std::string html(const StudiedCase& studied) const;

  private:
    struct Tile {
        std::string picture;  ///< an img element
        std::string what;     ///< "level 2"
    };
    using Key = std::pair<std::string, std::size_t>;  ///< name of the case, index of the point

    void keep(const Key& key, std::vector<Tile> tiles);
    std::vector<Tile> before_and_after(const run::BakeReport& report) const;
    void keep_proof(const std::string& name, const run::BakeReport& report);

    DisplayTransform display_;
    std::size_t most_bytes_, bytes_ = 0;
    std::map<Key, std::vector<Tile>> tiles_;
    std::map<std::string, std::string> proofs_;  ///< by the case's name
};

}  // namespace pbrbake::verify
