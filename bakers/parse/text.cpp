#include "bakers/parse/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace pbrbake::parse {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\v' || c == '\f'; }

/// Length of the well-formed UTF-8 sequence at the start of `text`, 0 if there is none (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool beyond = (lead == 0xED && byte(1) > 0x9F) || (lead == 0xF4 && byte(1) > 0x8F);
    return overlong || beyond ? 0 : length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

/// Windows-1252's 0x80 to 0x9F; the five that it leaves open map to themselves, as the WHATWG's encoding has
/// it.
constexpr std::array<std::uint16_t, 32> kWindows1252{
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

std::string from_windows_1252(std::string_view text) {
    std::string out;
    out.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        const unsigned byte = static_cast<unsigned char>(c);
        const unsigned code = byte >= 0x80 && byte < 0xA0 ? kWindows1252[byte - 0x80] : byte;
        if (code < 0x80) {
            out += static_cast<char>(code);
        } else if (code < 0x800) {
            out += static_cast<char>(0xC0 | code >> 6);
            out += static_cast<char>(0x80 | (code & 0x3F));
        } else {
            out += static_cast<char>(0xE0 | code >> 12);
            out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
            out += static_cast<char>(0x80 | (code & 0x3F));
        }
    }
    return out;
}

}  // namespace

std::string decode_text(std::span<const std::byte> bytes, std::string_view file,
                        std::vector<Diagnostic>& diagnostics) {
    using namespace std::string_view_literals;
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.empty()) throw malformed(file, 0, "is empty");
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv))
        throw malformed(file, 0, "is UTF-16; save it as UTF-8 or Latin-1");
    if (text.find('\0') != text.npos)
        throw malformed(file, 0, "holds NUL bytes, so it is UTF-16 or no text; save it as UTF-8 or Latin-1");
    if (text.starts_with("\xEF\xBB\xBF"sv)) {
        text.remove_prefix(3);
        diagnostics.push_back(
            {Severity::note, "byte_order_mark", 1, "begins with a UTF-8 byte order mark; ignored"});
    }
    if (is_utf8(text)) return std::string(text);
    diagnostics.push_back(
        {Severity::note, "encoding", 0, "is neither ASCII nor UTF-8; read as Windows-1252 (Latin-1)"});
    return from_windows_1252(text);
}

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.push_back(text.substr(0, end));
        const bool crlf = text.substr(end, 2) == "\r\n";
        text.remove_prefix(std::min(text.size(), end + (crlf ? 2 : 1)));
    }
    return lines;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string shown = "'";
    for (const char c : text.substr(0, kLongest))
        shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    if (text.size() > kLongest) {
        while (!is_utf8(std::string_view(shown).substr(1))) shown.pop_back();  // a cut sequence
        shown += "…";
    }
    return shown + "'";
}

std::optional<double> number_of(std::string_view word) {
    if (word.starts_with('+') && word.size() > 1 && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) return {};
    if (error == std::errc::result_out_of_range) {  // too large, or so small that it is 0
        const bool small = word.find("e-") != word.npos || word.find("E-") != word.npos;
        return small ? std::optional(0.) : std::nullopt;
    }
    if (error != std::errc{} || !(std::abs(value) <= kLargestNumber)) return {};
    return value;
}

std::string number_text(double value) {
    std::array<char, 64> buffer;
    const double size = std::abs(value);
    const auto format = value != 0 && (size >= 1e15 || size < 1e-5) ? std::chars_format::scientific
                                                                    : std::chars_format::fixed;
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0 ? 0 : value, format);
    return {buffer.data(), result.ptr};
}

std::optional<std::string_view> Words::next() {
    for (; line_ < lines_.size(); ++line_, column_ = 0) {
        const std::string_view line = lines_[line_];
        while (column_ < line.size() && is_separator(line[column_])) ++column_;
        if (column_ == line.size()) continue;
        const std::size_t begin = column_;
        while (column_ < line.size() && !is_separator(line[column_])) ++column_;
        last_line_ = static_cast<int>(line_) + 1;
        return line.substr(begin, column_ - begin);
    }
    return {};
}

double Words::number(std::string_view what) {
    const auto word = next();
    if (!word)
        throw malformed(file_, static_cast<int>(lines_.size()),
                        "ends where " + std::string(what) + " should be; it may be truncated");
    const auto value = number_of(*word);
    if (!value)
        throw malformed(file_, last_line_,
                        std::string("found ") + quoted(*word) + " as " + std::string(what) +
                            "; allowed: a finite number up to 1e10");
    return *value;
}

int Words::integer(std::string_view what, int low, int high) {
    const double value = number(what);
    if (value != std::floor(value) || value < low || value > high)
        throw malformed(file_, last_line_,
                        std::string("found ") + number_text(value) + " as " + std::string(what) +
                            std::string("; allowed: a whole number from ") + std::to_string(low) + " to " +
                            std::to_string(high));
    return static_cast<int>(value);
}

std::vector<double> Words::numbers(std::size_t count, std::string_view what) {
    if (count > bytes_left() / 2 + 1)  // a digit and what parts it from the next
        throw malformed(file_, last_line_,
                        std::string("claims ") + std::to_string(count) + " of " + std::string(what) +
                            ", but only " + std::to_string(bytes_left()) +
                            " bytes are left; it may be truncated");
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) values.push_back(number(what));
    return values;
}

std::size_t Words::bytes_left() const {
    if (line_ >= lines_.size()) return 0;
    const char* here = lines_[line_].data() + column_;
    return static_cast<std::size_t>(lines_.back().data() + lines_.back().size() - here);
}

}  // namespace pbrbake::parse
