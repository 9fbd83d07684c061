#pragma once
// Entities of Quake maps and Source's VMF: braces that hold "key" "value" pairs. Brushes, patches and deeper
// blocks are passed over.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::parse {

/// One entity: its pairs, the last of a key wins, as in the games.
struct MapEntity {
    int line = 0;  ///< of its opening brace, from 1
    std::map<std::string, std::string, std::less<>> pairs;

    bool has(std::string_view key) const { return pairs.find(key) != pairs.end(); }
    std::string_view value(std::string_view key) const {
        const auto found = pairs.find(key);
        return found == pairs.end() ? std::string_view() : std::string_view(found->second);
    }
};

/// Outermost blocks, in order. Comments run from // to the end of a line. Throws for a brace or quote that
/// isn't closed, a key without a value, and blocks nested deeper than 64.
std::vector<MapEntity> read_map_entities(std::string_view text, std::string_view file);

}  // namespace pbrbake::parse
