#include "bakers/verify/page.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace pbrbake::verify {
namespace {

constexpr std::string_view kStyle = R"css(
:root{color-scheme:light dark;--ground:#fbfbfa;--panel:#fff;--text:#1c1d1f;--soft:#5d6167;--line:#e3e3df;--mark:#0b62a8}
@media(prefers-color-scheme:dark){:root{--ground:#131416;--panel:#1b1d20;--text:#e9e9e6;--soft:#9ba0a8;--line:#303338;--mark:#7cbcf4}}
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--text);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
main{max-width:1120px;margin:0 auto;padding:40px 24px 80px}
h1{font-size:30px;line-height:1.2;margin:0 0 8px;letter-spacing:-.01em}
h2{font-size:22px;line-height:1.25;margin:64px 0 8px;padding-top:20px;border-top:1px solid var(--line);letter-spacing:-.01em}
h3{font-size:16px;margin:32px 0 8px}
p{margin:8px 0 12px;max-width:74ch}
.lead{font-size:18px;color:var(--soft)}
.soft,figcaption,.note{color:var(--soft);font-size:14px}
code{font:.9em ui-monospace,SFMono-Regular,Menlo,"Liberation Mono",monospace}
a{color:var(--mark)}
img{display:block;max-width:100%;height:auto}
figure{margin:16px 0}
figcaption{margin-top:8px;max-width:80ch}
.hero img{width:100%;border-radius:10px}
.hero img+img{margin-top:10px}
.cross img{clip-path:polygon(25% 0,50% 0,50% 33.33%,100% 33.33%,100% 66.67%,50% 66.67%,50% 100%,25% 100%,25% 66.67%,0 66.67%,0 33.33%,25% 33.33%)}
.wide{overflow-x:auto;margin:12px 0}
table{border-collapse:collapse;font-size:14px;line-height:1.4;font-variant-numeric:tabular-nums;min-width:100%}
th,td{padding:6px 10px;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap;vertical-align:baseline}
th{font-weight:600;color:var(--soft);font-size:13px;line-height:1.3;border-bottom-color:var(--soft);white-space:normal;vertical-align:bottom}
th:first-child,td:first-child{text-align:left;padding-left:0}
th.t,td.t{text-align:left}
td.t{white-space:normal}
td small{color:var(--soft);font-size:12px}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:24px 0;padding:0;list-style:none}
.facts li{background:var(--panel);border:1px solid var(--line);border-radius:8px;padding:12px 14px;font-size:13px;color:var(--soft);line-height:1.35}
.facts b{display:block;font-size:22px;color:var(--text);font-weight:600;line-height:1.3;font-variant-numeric:tabular-nums}
.balls{display:grid;gap:10px 12px;align-items:center;font-size:13px;color:var(--soft);min-width:640px;margin:8px 0}
.balls img{width:100%;border-radius:50%}
.balls .head{text-align:center;line-height:1.3}
.balls .row b{display:block;color:var(--text);font-size:14px}
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(230px,1fr));gap:24px;margin:16px 0}
.charts figure{margin:0}
.chart{display:grid;grid-template-columns:18px 1fr;grid-template-rows:auto 18px;gap:4px 6px;font-size:12px;color:var(--soft)}
.chart img{width:100%;image-rendering:pixelated}
.chart .y{writing-mode:vertical-rl;display:flex;justify-content:space-between;line-height:18px}
.chart .x{grid-column:2;display:flex;justify-content:space-between}
.proof{display:flex;flex-wrap:wrap;gap:16px 20px;margin:12px 0}
.proof figure{margin:0;width:144px}
.proof figcaption{font-size:13px;line-height:1.35}
.proof img{image-rendering:pixelated;border-radius:3px}
.proof .ball img{border-radius:50%}
.scale{height:10px;border-radius:5px;margin-top:8px}
.ends{display:flex;justify-content:space-between;font-size:12px;color:var(--soft);font-variant-numeric:tabular-nums}
pre{background:var(--panel);border:1px solid var(--line);border-radius:8px;padding:12px 14px;overflow-x:auto;font-size:13px;line-height:1.5}
dl{display:grid;grid-template-columns:max-content 1fr;gap:6px 18px;font-size:14px;margin:12px 0;max-width:90ch}
dt{color:var(--soft)}
dd{margin:0}
@media(max-width:600px){main{padding:24px 16px 48px}td:first-child{white-space:normal;min-width:8em}h1{font-size:25px}h2{margin-top:44px}dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:8px}}
)css";

std::string to_chars(double value, std::chars_format format, int precision) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr;
    return {text.data(), end};
}

/// "1.23e-06" -> "1.23e-6"
std::string scientific(double value) {
    std::string text = to_chars(value, std::chars_format::scientific, 2);
    const std::size_t sign = text.find('e') + 1;
    while (text.size() > sign + 2 && text[sign + 1] == '0') text.erase(sign + 1, 1);
    if (text[sign] == '+') text.erase(sign, 1);
    return text;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string html;
    html.reserve(text.size());
    for (const char c : text) switch (c) {
            case '&':
                html += "&amp;";
                break;
            case '<':
                html += "&lt;";
                break;
            case '>':
                html += "&gt;";
                break;
            case '"':
                html += "&quot;";
                break;
            case '\'':
                html += "&#39;";
                break;
            default:
                html += c;
        }
    return html;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t given = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < given ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= given ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string count(unsigned long long value) {
    std::string text = std::to_string(value);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, 1, ',');
    return text;
}

std::string number(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Inf" : "-Inf";
    if (value == 0) return "0";
    const std::string rounded = to_chars(value, std::chars_format::scientific, 2);
    const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));  // after rounding: 9.999 is 10.0
    if (exponent < -3 || exponent > 8) return scientific(value);
    if (exponent <= 2) return to_chars(value, std::chars_format::fixed, 2 - exponent);
    const double unit = std::pow(10.0, exponent - 2);
    const auto whole =
        static_cast<unsigned long long>(std::llround(std::abs(value) / unit) * std::llround(unit));
    std::string text = count(whole);
    if (value < 0) text.insert(0, 1, '-');
    return text;
}

std::string percent(double share) { return number(100 * share) + " %"; }

std::string Table::cell(const char* tag, std::size_t column, const std::string& html) const {
    const bool is_text = std::find(text_columns_.begin(), text_columns_.end(), column) != text_columns_.end();
    return std::string("<") + tag + (is_text ? " class=t>" : ">") + html + "</" + tag + ">";
}

std::string Table::html() const {
    std::string html = "<div class=wide><table><thead><tr>";
    for (std::size_t i = 0; i < heads_.size(); ++i) html += cell("th", i, heads_[i]);
    html += "</tr></thead><tbody>\n";
    for (const std::vector<std::string>& row : rows_) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) html += cell("td", i, row[i]);
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string page(std::string_view title, std::string_view body) {
    return "<!DOCTYPE html>\n<html lang=en>\n<head>\n<meta charset=utf-8>\n"
           "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
           "<meta name=generator content=pbrbake>\n<link rel=icon href=\"data:,\">\n<title>" +
           escaped(title) + "</title>\n<style>" + std::string(kStyle) +
           "</style>\n</head>\n<body>\n<main>\n" + std::string(body) + "</main>\n</body>\n</html>\n";
}

}  // namespace pbrbake::verify
