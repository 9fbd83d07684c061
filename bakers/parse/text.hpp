#pragma once
// Text as found in the wild: its encoding, its lines, its numbers.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/parse/diagnostic.hpp"

namespace pbrbake::parse {

/// Bytes as UTF-8. A UTF-8 byte order mark is dropped and bytes that are no UTF-8 are read as Windows-1252
/// (which Latin-1 is part of); both are diagnosed. Throws for an empty file, UTF-16, UTF-32 and NUL bytes.
std::string decode_text(std::span<const std::byte> bytes, std::string_view file,
                        std::vector<Diagnostic>& diagnostics);

/// Lines without their ends, which may be LF, CRLF or CR, mixed. A last line that is empty is none. Views
/// into `text`.
std::vector<std::string_view> split_lines(std::string_view text);

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// For messages: in quotes, cut to 40 bytes, control characters as '?'.
std::string quoted(std::string_view text);

/// No lamp's number is larger. The bound keeps products of a few of them finite, in float too.
inline constexpr double kLargestNumber = 1e10;

/// The number that a whole word is; nothing for other words, NaN, infinities and numbers beyond
/// kLargestNumber. Decimal points alone: a comma parts numbers.
std::optional<double> number_of(std::string_view word);

/// The shortest decimal that reads back as `value`; finite. Never in a locale's form, and exponents only
/// beyond 1e15 and below 1e-5.
std::string number_text(double value);

/// Words parted by blanks, tabs, commas and line ends, from a line on.
class Words {
  public:
    /// `lines` must outlive it; `first` is an index from 0.
    Words(std::span<const std::string_view> lines, std::size_t first, std::string_view file)
        : lines_(lines), line_(first), file_(file) {}

    /// The next word, or nothing at the end of the file.
    std::optional<std::string_view> next();
    /// The next finite number, or an error that names `what`.
    double number(std::string_view what);
    /// The next number that is whole and in [low, high]. "37.0" is whole.
    int integer(std::string_view what, int low, int high);
    /// `count` numbers. The count is held against the bytes that are left before memory is taken.
    std::vector<double> numbers(std::size_t count, std::string_view what);

    /// Bytes from here to the end, at least.
    std::size_t bytes_left() const;
    /// The line of the last word, counted from 1.
    int line() const { return last_line_; }

  private:
    std::span<const std::string_view> lines_;
    std::size_t line_, column_ = 0;
    int last_line_ = 0;
    std::string_view file_;
};

}  // namespace pbrbake::parse
