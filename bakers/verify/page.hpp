#pragma once
// Self-contained HTML pages: one file, no script, nothing from a network.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::verify {

/// Text as it may stand in an element or a quoted attribute: & < > " ' replaced.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);

/// A number with three significant digits: "0.00123", "1.50", "12.3", "1,230", "1.23e-6". Zero is "0"; NaN
/// and Inf are named.
std::string number(double value);

/// A share as per cent, three significant digits: "1.23 %".
std::string percent(double share);

/// A count with its thousands set apart: "134,217,728".
std::string count(unsigned long long value);

/// A table. Cells are HTML: escape what isn't. Columns after the first are aligned right unless named as
/// text.
class Table {
  public:
    explicit Table(std::vector<std::string> heads) : heads_(std::move(heads)) {}
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    /// This column holds words.
    void set_text(std::size_t column) { text_columns_.push_back(column); }
    std::string html() const;

  private:
    std::string cell(const char* tag, std::size_t column, const std::string& html) const;

    std::vector<std::string> heads_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<std::size_t> text_columns_;
};

/// The whole document around a body (HTML). The style follows the reader's light or dark scheme.
std::string page(std::string_view title, std::string_view body);

}  // namespace pbrbake::verify
