#include "bakers/parse/collada_document.hpp"

#include <algorithm>

#include "bakers/parse/diagnostic.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {

ColladaDocument::ColladaDocument(std::string_view text, const std::string& file) : file_(file) {
    for (std::size_t i = text.find('\n'); i != text.npos; i = text.find('\n', i + 1)) ends_.push_back(i);
    const pugi::xml_parse_result result =
        document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        throw malformed(file, line_at(static_cast<std::size_t>(result.offset)),
                        std::string("is no XML: ") + result.description());
    root_ = document_.child("COLLADA");
    if (!root_)
        throw malformed(
            file, 0,
            "found the element " + quoted(document_.document_element().name()) + "; allowed: COLLADA");
}

int ColladaDocument::line_at(std::size_t offset) const {
    return 1 + static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin());
}

int ColladaDocument::line_of(const pugi::xml_node& node) const {
    return node.offset_debug() < 0 ? 0 : line_at(static_cast<std::size_t>(node.offset_debug()));
}

}  // namespace pbrbake::parse
