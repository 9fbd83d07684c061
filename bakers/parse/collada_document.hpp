#pragma once
// A COLLADA document, and where in its text a node stands: what readers of its libraries share.

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::parse {

class ColladaDocument {
  protected:
    /// Throws malformed() unless `text` is XML whose root is COLLADA. `file` must outlive this.
    ColladaDocument(std::string_view text, const std::string& file);

    /// The line of a node, from 1; 0 if it isn't of the text.
    int line_of(const pugi::xml_node& node) const;

    const std::string& file_;
    pugi::xml_node root_;

  private:
    int line_at(std::size_t offset) const;
    std::vector<std::size_t> ends_;  ///< of lines
    pugi::xml_document document_;
};

}  // namespace pbrbake::parse
