#include "bakers/verify/compare_page.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/picture.hpp"
#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kLargestFace = 64, kLargestPicture = 256;  // texels a side of a picture on the page
constexpr std::array<std::uint8_t, 3> kBackground{128, 128, 128};
/// Relative errors at which the colours of a difference end.
constexpr double kLeastShown = 1e-4, kMostErrorShown = 1;
/// Share of values that a picture of light shows unclipped.
constexpr double kUnclipped = 0.98;

/// One level as an image of its own, three channels, divided by the scale; sides halved until small enough.
Image shown_level(const ProductFile& product, int level) {
    const Level& from = product.image.levels[static_cast<std::size_t>(level)];
    const int most = product.image.is_cube() ? kLargestFace : kLargestPicture;
    int step = 1;
    while (std::max(from.width, from.height) / step > most) step *= 2;
    const int width = std::max(1, from.width / step), height = std::max(1, from.height / step);
    const int channels = product.image.channel_count();
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = product.image.faces;
    image.is_volume = product.image.is_volume;
    image.levels.push_back(
        {width, height, std::vector<float>(static_cast<std::size_t>(image.faces) * width * height * 3)});
    for (int face = 0; face < image.faces; ++face)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    if (c >= channels && channels != 1) continue;  // of two channels, the third is black
                    double sum = 0;
                    for (int k = 0; k < step * step; ++k)
                        sum += product.image.texel(
                            level, face, std::min(y * step + k / step, from.height - 1),
                            std::min(x * step + k % step, from.width - 1))[channels == 1 ? 0 : c];
                    image.texel(0, face, y, x)[c] = static_cast<float>(sum / (step * step) / product.scale);
                }
    return image;
}

/// What makes nearly all values of an image fit below 1.
double exposure_of(const Image& image) {
    std::vector<float> values;
    for (const float value : image.levels.front().texels)
        if (std::isfinite(value)) values.push_back(value);
    const double most = quantile(values, kUnclipped);
    return most > 0 ? 1 / most : 1;
}

/// A picture of every texel: a cube map unfolded, a volume's slices below each other, or the picture itself.
template <class Colour>
Picture laid_out(const Image& image, const Colour& colour) {
    const Level& level = image.levels.front();
    const bool is_cube = image.is_cube();
    const int n = level.width;
    static constexpr int kColumns[] = {2, 0, 1, 1, 1, 3}, kRows[] = {1, 1, 0, 2, 1, 1};
    Picture picture(is_cube ? 4 * n : level.width, is_cube ? 3 * n : level.height * image.faces);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = kBackground[i % 3];
    for (int face = 0; face < image.faces; ++face)
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                colour(face, y, x, picture, x + (is_cube ? kColumns[face] * n : 0),
                       y + (is_cube ? kRows[face] * n : face * level.height));
    return picture;
}

Picture values_picture(const Image& image, double factor) {
    return laid_out(image, [&](int face, int y, int x, Picture& picture, int px, int py) {
        const float* texel = image.texel(0, face, y, x);
        put(picture, px, py, factor * glm::dvec3(texel[0], texel[1], texel[2]));
    });
}

void put_false(Picture& picture, int x, int y, double at) {
    const glm::dvec3 colour = 255.0 * false_colour(at);
    for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = static_cast<std::uint8_t>(std::lround(colour[c]));
}

/// The largest relative error of a texel's channels, on a logarithmic scale; NaN is red.
Picture difference_picture(const Image& a, const Image& b) {
    std::array<double, 3> typical{};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (std::size_t i = c; i < b.levels.front().texels.size(); i += 3)
            if (std::isfinite(b.levels.front().texels[i]))
                values.push_back(std::abs(b.levels.front().texels[i]));
        typical[c] = quantile(values, 0.5);
    }
    return laid_out(b, [&](int face, int y, int x, Picture& picture, int px, int py) {
        double worst = 0;
        for (int c = 0; c < 3; ++c) {
            const double of_a = a.texel(0, face, y, x)[c], of_b = b.texel(0, face, y, x)[c];
            if (!std::isfinite(of_a) || !std::isfinite(of_b)) return put(picture, px, py, {1, 0, 0});
            const double size = std::max(std::abs(of_b), typical[static_cast<std::size_t>(c)]);
            if (of_a != of_b)
                worst = std::max(worst, size > 0 ? std::abs(of_a - of_b) / size : kMostErrorShown);
        }
        put_false(picture, px, py,
                  std::log(std::max(worst / kLeastShown, 1.0)) / std::log(kMostErrorShown / kLeastShown));
    });
}

std::string image_html(const Picture& picture, const std::string& alt) {
    return "<figure><img style=\"width:100%;image-rendering:pixelated\" alt=\"" + escaped(alt) +
           "\" width=" + std::to_string(picture.width) + " height=" + std::to_string(picture.height) +
           " src=\"" + data_uri(picture) + "\"><figcaption>" + escaped(alt) + "</figcaption></figure>\n";
}

/// Spheres at an exposure; what is beyond their rims, where colours go on, is left grey.
Picture spheres_picture(const LinearPicture& spheres, double factor) {
    Picture picture(spheres.width, spheres.height);
    const int size = spheres.height;
    for (int y = 0; y < spheres.height; ++y)
        for (int x = 0; x < spheres.width; ++x) {
            const double u = (2 * (x % size) + 1.0) / size - 1, v = (2 * y + 1.0) / size - 1;
            if (u * u + v * v < 1)
                put(picture, x, y, factor * spheres.at(x, y));
            else
                std::ranges::copy(kBackground, picture.pixel(x, y));
        }
    return picture;
}

/// What makes nearly all luminances of a picture fit below 1.
double exposure_of(const LinearPicture& picture) {
    std::vector<float> values;
    for (const glm::dvec3& rgb : picture.rgb)
        values.push_back(static_cast<float>(std::max({rgb.x, rgb.y, rgb.z})));
    const double most = quantile(values, 0.9);
    return most > 0 ? 1 / most : 1;
}

std::string flip_html(const ShadedFlip& flip) {
    Picture map(flip.map.width, flip.map.height);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            put_false(map, x, y, flip.map.error[static_cast<std::size_t>(y) * map.width + x]);
    const double factor = exposure_of(flip.b);
    return "<h3>Shaded spheres</h3>\n<p class=soft>White metal spheres of the levels' roughness. HDR-FLIP "
           "over "
           "exposures from " +
           number(flip.start_exposure) + " to " + number(flip.stop_exposure) + " stops: mean " +
           number(flip.mean) + ", largest " + number(flip.max) + ".</p>\n" +
           image_html(spheres_picture(flip.a, factor), "A") +
           image_html(spheres_picture(flip.b, factor), "B") + image_html(map, "HDR-FLIP, 0 to 1");
}

std::string level_table(const ProductComparison& product) {
    Table table({"level", "channel", "max ulp", "relative RMS", "p50", "p95", "p99", "largest relative error",
                 "largest error", "energy A", "energy B", "change", "not finite"});
    table.set_text(1);
    for (const PlaceErrors& place : product.levels) {
        const ErrorFigures& f = place.figures;
        table.add({std::to_string(place.level),
                   escaped(product.channels[static_cast<std::size_t>(place.channel)]), count(f.max_ulp),
                   number(f.relative_rms), number(f.relative_p50), number(f.relative_p95),
                   number(f.relative_p99), number(f.relative_max), number(f.max_abs), number(f.energy_a),
                   number(f.energy_b), percent(f.energy_change), count(f.non_finite_a + f.non_finite_b)});
    }
    return table.html();
}

/// The place of the largest relative root mean square, of finite figures if there are any.
const PlaceErrors& worst_place(const ProductComparison& product) {
    return *std::ranges::max_element(product.faces, {}, [](const PlaceErrors& place) {
        const ErrorFigures& f = place.figures;
        return f.non_finite_a > 0 ? 1e300 : f.relative_rms;
    });
}

int index_of_size(const Image& image, const Level& level) {
    for (int i = 0; i < static_cast<int>(image.levels.size()); ++i)
        if (image.levels[static_cast<std::size_t>(i)].width == level.width &&
            image.levels[static_cast<std::size_t>(i)].height == level.height)
            return i;
    return -1;
}

std::string pictures_html(const ProductComparison& product) {
    const ProductFile a = read_product_file(product.pair.a, product.pair.entry_a),
                      b = read_product_file(product.pair.b, product.pair.entry_b);
    const int level = worst_place(product).level;
    const int level_a = index_of_size(a.image, b.image.levels[static_cast<std::size_t>(level)]);
    if (level_a < 0 || a.image.faces != b.image.faces) return "";
    const Image of_a = shown_level(a, level_a), of_b = shown_level(b, level);
    const bool is_light = b.image.is_cube();
    const double factor = is_light ? exposure_of(of_b) : 1;
    return "<div class=charts>" +
           image_html(values_picture(of_a, factor), "A, level " + std::to_string(level)) +
           image_html(values_picture(of_b, factor), "B, the reference") +
           image_html(difference_picture(of_a, of_b), "Relative error") + "</div>\n" +
           false_colour_scale(percent(kLeastShown) + " or less", percent(kMostErrorShown) + " or more");
}

std::string product_html(const ProductComparison& product) {
    std::string html = "<h2>" + escaped(product.pair.name) + "</h2>\n";
    if (!product.looks_like.empty())
        html += "<p class=lead>Looks like: " + escaped(product.looks_like) + ".</p>\n";
    html += "<ul>";
    for (const std::string& reason : product.reasons) html += "<li>" + escaped(reason) + "</li>";
    for (const std::string& note : product.notes) html += "<li class=soft>" + escaped(note) + "</li>";
    html += "</ul>\n";
    if (product.faces.empty()) return html;
    html += pictures_html(product);
    if (product.flip) html += flip_html(*product.flip);
    return html + "<h3>Figures</h3>\n" + level_table(product);
}

std::string overview(const std::vector<const ProductComparison*>& products) {
    Table table({"product", "verdict", "max ulp", "relative RMS", "p99", "largest", "energy", "FLIP", "why"});
    table.set_text(1);
    table.set_text(8);
    for (const ProductComparison* product : products) {
        const ErrorFigures& worst = product->worst;
        const bool measured = worst.values > 0;
        const auto figure = [&](double value) { return measured ? number(value) : std::string("–"); };
        std::string why = product->reasons.empty() ? "" : product->reasons.front();
        if (!product->looks_like.empty()) why = "looks like: " + product->looks_like;
        table.add({"<code>" + escaped(product->pair.name) + "</code>",
                   std::string(product->passed() ? "" : "<b>") +
                       std::string(kVerdictNames[static_cast<std::size_t>(product->verdict)]) +
                       (product->passed() ? "" : "</b>"),
                   measured ? count(worst.max_ulp) : "–", figure(worst.relative_rms),
                   figure(worst.relative_p99), figure(worst.relative_max), figure(worst.energy_change),
                   product->flip ? number(product->flip->mean) : "–", escaped(why)});
    }
    return table.html();
}

std::string thresholds_html(const Thresholds& t) {
    Table table({"threshold", "in force"});
    const Json thresholds = thresholds_json(t);
    for (const auto& [name, value] : thresholds.items())
        table.add({"<code>" + escaped(name) + "</code>",
                   value.is_number() ? number(value.get<double>())
                   : value.is_array()
                       ? number(value[0].get<double>()) + " to " + number(value[1].get<double>())
                   : value.get<bool>() ? "yes"
                                       : "no"});
    return "<h2>Thresholds</h2>\n" + table.html();
}

}  // namespace

std::string comparison_page(const Comparison& comparison) {
    std::vector<const ProductComparison*> products;
    for (const ProductComparison& product : comparison.products) products.push_back(&product);
    std::ranges::stable_sort(products, {},
                             [](const ProductComparison* product) { return product->passed(); });
    std::string body = "<h1>Comparison</h1>\n<p class=lead>" + escaped(summary_line(comparison)) +
                       ". A is held against B, the reference.</p>\n" + overview(products);
    std::size_t shown = 0;
    for (const ProductComparison* product : products) {
        if (product->passed()) break;
        if (product->verdict == Verdict::differs && shown++ < kMostShown) body += product_html(*product);
    }
    if (shown > kMostShown)
        body += "<p class=soft>" + std::to_string(shown - kMostShown) +
                " more products differ; compare them by name to see them.</p>\n";
    return page("pbrbake compare", body + thresholds_html(comparison.thresholds));
}

}  // namespace pbrbake::verify
