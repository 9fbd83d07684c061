#include "bakers/verify/compare.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bakers/formats.hpp"
#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/verify/diagnose.hpp"
#include "bakers/verify/face.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/product_file.hpp"
#include "bakers/workers.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

std::string size_text(const Level& level) {
    return std::to_string(level.width) + " x " + std::to_string(level.height);
}

bool same_size(const Level& a, const Level& b) { return a.width == b.width && a.height == b.height; }

std::string pair_text(const std::string& a, const std::string& b) { return a + " instead of " + b; }

std::string joined_text(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
}

std::string join_path(const std::string& path, const std::string& key) { return path + "/" + key; }

/// Where two JSON documents first differ, or "".
std::string document_difference(const Json& a, const Json& b, double most, const std::string& at) {
    const std::string place = at.empty() ? "the document" : at;
    if (a.is_number() && b.is_number()) {
        const double va = a.get<double>(), vb = b.get<double>();
        if (std::abs(va - vb) <= most * std::max(std::abs(va), std::abs(vb))) return "";
        return place + " is " + job::to_line(a) + " instead of " + job::to_line(b);
    }
    if (a.type() != b.type()) return place + " is of another type";
    if (a.is_object()) {
        for (const auto& [key, value] : b.items()) {
            if (!a.contains(key)) return join_path(at, key) + " is missing";
            if (const std::string found = document_difference(a[key], value, most, join_path(at, key));
                !found.empty())
                return found;
        }
        for (const auto& [key, value] : a.items())
            if (!b.contains(key)) return join_path(at, key) + " is not in the reference";
        return "";
    }
    if (a.is_array()) {
        if (a.size() != b.size())
            return place + " has " + pair_text(std::to_string(a.size()), std::to_string(b.size())) +
                   " elements";
        for (std::size_t i = 0; i < a.size(); ++i)
            if (const std::string found =
                    document_difference(a[i], b[i], most, join_path(at, std::to_string(i)));
                !found.empty())
                return found;
        return "";
    }
    return a == b ? "" : place + " differs";
}

/// One pair on its way to a verdict.
class ProductCheck {
  public:
    ProductCheck(const Pair& pair, const Thresholds& thresholds) : thresholds_(thresholds) {
        result_.pair = pair;
        if (!pair.note.empty()) result_.notes.push_back(pair.note);
    }

    ProductComparison run() {
        try {
            check();
        } catch (const Error& error) {
            result_.verdict = Verdict::unreadable;
            result_.reasons.assign(1, error.what());
        }
        return std::move(result_);
    }

  private:
    void check() {
        const Pair& pair = result_.pair;
        for (const bool is_a : {true, false}) {
            const fs::path& file = is_a ? pair.a : pair.b;
            std::error_code error;
            if (!file.empty() && fs::exists(file, error)) continue;
            result_.verdict = Verdict::missing;
            result_.reasons.push_back(is_a ? "missing: the reference has it" : "the reference hasn't got it");
            return;
        }
        identical_ = io::hash_file(pair.a) == io::hash_file(pair.b);
        if (!holds_pictures(pair.b)) return check_document();
        a_ = read_product_file(pair.a, pair.entry_a);
        b_ = read_product_file(pair.b, pair.entry_b);
        result_.channels = b_.image.channels;
        check_geometry();
        check_format();
        if (comparable_) {
            bring_to_one_scale();
            check_values();
        }
        if (!result_.reasons.empty()) result_.verdict = Verdict::differs;
    }

    static std::string extension(const fs::path& file) {
        const std::string text = file.extension().string();
        return text.empty() ? "" : text.substr(1);
    }

    static bool holds_pictures(const fs::path& file) {
        const Format* format = find_format(extension(file));
        return format && !format->is_document();
    }

    void check_document() {
        if (identical_) return;
        result_.verdict = Verdict::within;
        const std::string text_a = job::read_text(result_.pair.a), text_b = job::read_text(result_.pair.b);
        if (const std::string ending = extension(result_.pair.b); ending != "json" && ending != "gltf") {
            result_.reasons.push_back("the text differs");
        } else {
            const Json a = parsed(text_a, result_.pair.a), b = parsed(text_b, result_.pair.b);
            if (const std::string found = document_difference(a, b, thresholds_.max_document_change, "");
                !found.empty())
                result_.reasons.push_back(found);
        }
        if (!result_.reasons.empty()) result_.verdict = Verdict::differs;
    }

    static Json parsed(const std::string& text, const fs::path& file) {
        try {
            return job::parse_json(text, file.string());
        } catch (const Error& error) {
            throw Error(ExitCode::unreadable_input, error.where(), error.message());
        }
    }

    void check_geometry() {
        const Image &a = a_.image, &b = b_.image;
        if (a.faces != b.faces || a.is_volume != b.is_volume) {
            result_.reasons.push_back("has " + pair_text(std::to_string(a.faces), std::to_string(b.faces)) +
                                      (b.is_volume ? " slices" : " faces"));
            comparable_ = false;
        }
        if (a.channels.size() != b.channels.size()) comparable_ = false;
        if (a.channels != b.channels)
            result_.reasons.push_back("has channels " +
                                      pair_text(joined_text(a.channels), joined_text(b.channels)));
        const auto has = [](const Image& image, const Level& level) {
            return std::ranges::any_of(image.levels, [&](const Level& l) { return same_size(l, level); });
        };
        if (a.levels.size() != b.levels.size()) {
            std::string text = "has " +
                               pair_text(std::to_string(a.levels.size()), std::to_string(b.levels.size())) +
                               " levels";
            for (std::size_t i = 0; i < b.levels.size(); ++i)
                if (!has(a, b.levels[i]))
                    text += ": level " + std::to_string(i) + " (" + size_text(b.levels[i]) + ") is missing";
            result_.reasons.push_back(text);
        } else if (!same_size(a.levels.front(), b.levels.front())) {
            result_.reasons.push_back("is " +
                                      pair_text(size_text(a.levels.front()), size_text(b.levels.front())));
        }
        keep_common_levels();
    }

    /// Levels that both have, by size: with one missing, the others are still worth a comparison.
    void keep_common_levels() {
        Image a = a_.image, b = b_.image;
        a.levels.clear();
        b.levels.clear();
        for (std::size_t i = 0; i < b_.image.levels.size(); ++i)
            for (Level& level : a_.image.levels)
                if (same_size(level, b_.image.levels[i]) && level.width > 0) {
                    a.levels.push_back(std::move(level));
                    b.levels.push_back(b_.image.levels[i]);
                    level_numbers_.push_back(static_cast<int>(i));
                    level.width = 0;
                    break;
                }
        a_.image = std::move(a);
        b_.image = std::move(b);
        if (b_.image.levels.empty()) comparable_ = false;
    }

    void check_format() {
        const auto pixel = [](const ProductFile& file) { return std::string(pixel_name(file.info.pixel)); };
        const auto found = [&](const std::string& text) {
            (thresholds_.any_format ? result_.notes : result_.reasons).push_back(text);
        };
        if (a_.format != b_.format) found("is a " + pair_text(a_.format, b_.format) + " file");
        if (a_.info.pixel != b_.info.pixel) found("stores " + pair_text(pixel(a_), pixel(b_)));
        if (a_.scale != b_.scale) found("is stored times " + pair_text(number(a_.scale), number(b_.scale)));
        if (a_.units != b_.units) result_.reasons.push_back("is in " + pair_text(a_.units, b_.units));
    }

    void bring_to_one_scale() {
        const double factor = b_.scale / a_.scale;
        if (factor != 1)
            for (Level& level : a_.image.levels)
                for (float& value : level.texels) value = static_cast<float>(value * factor);
    }

    void check_values() {
        for (int level = 0; level < static_cast<int>(b_.image.levels.size()); ++level) measure(level);
        const ErrorFigures& worst = result_.worst;
        report_non_finite();
        if (identical_ && result_.reasons.empty()) return;
        if (worst.max_ulp <= thresholds_.max_ulp) {
            result_.verdict = identical_ ? Verdict::identical : Verdict::within_ulp;
            return;
        }
        result_.verdict = Verdict::within;
        hold_thresholds();
        if (b_.image.is_cube() && b_.image.channels.size() == 3 && !has_non_finite()) hold_flip();
        if (!result_.reasons.empty()) result_.looks_like = diagnose(a_.image, b_);
    }

    bool has_non_finite() const { return result_.worst.non_finite_a + result_.worst.non_finite_b > 0; }

    void measure(int level) {
        const Level &of_a = a_.image.levels[static_cast<std::size_t>(level)],
                    &of_b = b_.image.levels[static_cast<std::size_t>(level)];
        const std::size_t channels = b_.image.channels.size(),
                          texels = static_cast<std::size_t>(of_b.width) * of_b.height;
        const std::vector<double> weights = texel_weights(of_b, b_.image.is_cube());
        Samples samples;
        samples.weight = weights;
        for (std::size_t c = 0; c < channels; ++c) {
            std::vector<ErrorFigures> parts;
            for (int face = 0; face < b_.image.faces; ++face) {
                const std::size_t begin = static_cast<std::size_t>(face) * texels * channels;
                samples.a.clear();
                samples.b.clear();
                samples.brightest.clear();
                for (std::size_t i = 0; i < texels; ++i) {
                    const float* texel = &of_b.texels[begin + i * channels];
                    samples.a.push_back(of_a.texels[begin + i * channels + c]);
                    samples.b.push_back(texel[c]);
                    if (b_.info.pixel == PixelType::rgbe)
                        samples.brightest.push_back(*std::max_element(texel, texel + channels));
                }
                parts.push_back(error_figures(samples, b_.info.pixel, b_.scale));
                result_.faces.push_back({level_numbers_[static_cast<std::size_t>(level)], face,
                                         static_cast<int>(c), parts.back()});
            }
            result_.levels.push_back({level_numbers_[static_cast<std::size_t>(level)], -1,
                                      static_cast<int>(c), joined_figures(parts)});
            add_worst(result_.levels.back().figures, parts);
        }
    }

    void add_worst(const ErrorFigures& level, const std::vector<ErrorFigures>& faces) {
        ErrorFigures& worst = result_.worst;
        const auto raise = [](double& most, double value) { most = std::max(most, value); };
        worst.values += level.values;
        worst.differing += level.differing;
        worst.non_finite_a += level.non_finite_a;
        worst.non_finite_b += level.non_finite_b;
        worst.max_ulp = std::max(worst.max_ulp, level.max_ulp);
        raise(worst.max_abs, level.max_abs);
        raise(worst.mean_abs, level.mean_abs);
        raise(worst.rms, level.rms);
        raise(worst.relative_p50, level.relative_p50);
        raise(worst.relative_p95, level.relative_p95);
        raise(worst.relative_p99, level.relative_p99);
        raise(worst.relative_max, level.relative_max);
        raise(worst.energy_change, level.energy_change);
        for (const ErrorFigures& face : faces) raise(worst.relative_rms, face.relative_rms);
    }

    std::string place_text(const PlaceErrors& place) const {
        std::string text = b_.image.levels.size() > 1 || b_.image.is_cube()
                               ? "level " + std::to_string(place.level) + ", "
                               : "";
        if (place.face >= 0 && b_.image.is_volume) text += "slice " + std::to_string(place.face) + ", ";
        if (place.face >= 0 && b_.image.is_cube())
            text += std::string("face ") + kFaceNames[static_cast<std::size_t>(place.face)] + ", ";
        return text + "channel " + b_.image.channels[static_cast<std::size_t>(place.channel)];
    }

    void report_non_finite() {
        for (const bool in_a : {true, false}) {
            std::uint64_t count = 0;
            const PlaceErrors* first = nullptr;
            for (const PlaceErrors& place : result_.faces) {
                const std::uint64_t here = in_a ? place.figures.non_finite_a : place.figures.non_finite_b;
                if (here > 0 && !first) first = &place;
                count += here;
            }
            if (count > 0)
                result_.reasons.push_back(std::string(in_a ? "" : "the reference: ") + std::to_string(count) +
                                          (count == 1 ? " value is" : " values are") +
                                          " NaN or infinite, the first in " + place_text(*first));
        }
    }

    /// The place where a figure is largest, if it is above its threshold, as a reason.
    template <class Figure>
    void hold(const std::vector<PlaceErrors>& places, Figure figure, double most, const char* name) {
        const auto worst = std::ranges::max_element(
            places, {}, [&](const PlaceErrors& place) { return place.figures.*figure; });
        if (worst == places.end() || !(worst->figures.*figure > most)) return;
        result_.reasons.push_back(place_text(*worst) + ": " + name + " " + number(worst->figures.*figure) +
                                  " above " + number(most));
    }

    void hold_thresholds() {
        hold(result_.levels, &ErrorFigures::energy_change, thresholds_.max_energy_change, "energy change");
        hold(result_.faces, &ErrorFigures::relative_rms, thresholds_.max_relative_rms, "relative RMS");
        hold(result_.faces, &ErrorFigures::relative_p99, thresholds_.max_relative_p99,
             "99th percentile of relative errors");
        hold(result_.faces, &ErrorFigures::relative_max, thresholds_.max_relative, "largest relative error");
    }

    void hold_flip() {
        result_.flip = shaded_flip(a_.image, b_.image, b_.scale, thresholds_.flip_exposures);
        if (result_.flip->mean > thresholds_.max_flip)
            result_.reasons.push_back("HDR-FLIP of shaded spheres " + number(result_.flip->mean) + " above " +
                                      number(thresholds_.max_flip));
    }

    const Thresholds& thresholds_;
    ProductComparison result_;
    ProductFile a_, b_;
    std::vector<int> level_numbers_;  ///< of the common levels, in B
    bool identical_ = false, comparable_ = true;
};

ExitCode code_of(const std::vector<ProductComparison>& products) {
    ExitCode code = products.empty() ? ExitCode::comparison_failed : ExitCode::done;
    for (const ProductComparison& product : products) {
        if (product.verdict == Verdict::unreadable) return ExitCode::unreadable_input;
        if (!product.passed()) code = ExitCode::comparison_failed;
    }
    return code;
}

}  // namespace

Comparison compare(const fs::path& a, const fs::path& b, const Thresholds& thresholds, int threads) {
    const std::vector<Pair> pairs = pairs_of(a, b);
    Comparison comparison;
    comparison.thresholds = thresholds;
    comparison.products.resize(pairs.size());
    Workers(threads).for_each(static_cast<std::int64_t>(pairs.size()), [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        comparison.products[at] = ProductCheck(pairs[at], thresholds).run();
    });
    comparison.code = code_of(comparison.products);
    return comparison;
}

}  // namespace pbrbake::verify
