#pragma once
// Pictures of a study: what each step of a dial looks like.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bakers/verify/display_transform.hpp"
#include "bakers/verify/legacy_pictures.hpp"
#include "bakers/verify/study.hpp"

namespace pbrbake::verify {

/// Takes pictures while a study runs. A probe's step has a filtered level unfolded, its difference from the
/// reference, and a metal ball by the split sum; a legacy set of the suite a sphere before and after, and
/// their difference; a light its curve; another flat product is shown as it is. At most five steps of a
/// series, and no more bytes than `most_bytes` in all.
class PictureBook {
  public:
    explicit PictureBook(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    /// For StudyOptions::inspect.
    void take(const StudiedCase& studied, const StudyPoint& point, const BakedImage& product,
              const BakedImage* reference, const std::vector<std::filesystem::path>& files);

    /// What spheres of legacy sets go through.
    const char* display_name() const { return display_.name(); }

    /// The pictures of a case as HTML, a row a series; "" if there are none.
    std::string html(const StudiedCase& studied) const;

  private:
    struct Tile {
        std::string picture;  ///< an img element
        std::string what;     ///< "level 2"
    };
    using Key = std::pair<std::string, std::size_t>;  ///< name of the case, index of the point

    void keep(const Key& key, std::vector<Tile> tiles);
    std::vector<Tile> before_and_after(const LegacySet& set, const std::vector<std::filesystem::path>& files);

    DisplayTransform display_;
    std::size_t most_bytes_, bytes_ = 0;
    std::map<Key, std::vector<Tile>> tiles_;
    std::map<std::string, LinearPicture> legacy_spheres_;  ///< by the set's name
};

}  // namespace pbrbake::verify
