// What a comparison came to: lines for people, JSON for programs.

#include <cmath>

#include "bakers/verify/compare.hpp"
#include "bakers/verify/page.hpp"

namespace pbrbake::verify {
namespace {

/// JSON has no infinity.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json figures_json(const ErrorFigures& figures) {
    return {{"values", figures.values},
            {"differing", figures.differing},
            {"non_finite_a", figures.non_finite_a},
            {"non_finite_b", figures.non_finite_b},
            {"max_ulp", figures.max_ulp},
            {"max_abs", finite(figures.max_abs)},
            {"mean_abs", finite(figures.mean_abs)},
            {"rms", finite(figures.rms)},
            {"relative_rms", finite(figures.relative_rms)},
            {"relative_p50", finite(figures.relative_p50)},
            {"relative_p95", finite(figures.relative_p95)},
            {"relative_p99", finite(figures.relative_p99)},
            {"relative_max", finite(figures.relative_max)},
            {"energy_change", finite(figures.energy_change)}};
}

Json place_json(const PlaceErrors& place, const std::vector<std::string>& channels) {
    Json json{{"level", place.level}};
    if (place.face >= 0) json["face"] = place.face;
    json["channel"] = channels[static_cast<std::size_t>(place.channel)];
    const Json figures = figures_json(place.figures);
    for (const auto& [key, value] : figures.items()) json[key] = value;
    json["energy_a"] = finite(place.figures.energy_a);
    json["energy_b"] = finite(place.figures.energy_b);
    return json;
}

Json product_json(const ProductComparison& product) {
    Json json{{"name", product.pair.name},
              {"a", product.pair.a.generic_string()},
              {"b", product.pair.b.generic_string()},
              {"passed", product.passed()},
              {"verdict", kVerdictNames[static_cast<std::size_t>(product.verdict)]},
              {"reasons", product.reasons},
              {"notes", product.notes}};
    if (!product.looks_like.empty()) json["looks_like"] = product.looks_like;
    if (product.worst.values > 0) json["worst"] = figures_json(product.worst);
    if (product.flip)
        json["flip"] = {{"mean", product.flip->mean},
                        {"max", product.flip->max},
                        {"exposures", {product.flip->start_exposure, product.flip->stop_exposure}}};
    if (product.verdict == Verdict::identical) return json;
    for (const auto& [key, places] : {std::pair{"levels", &product.levels}, {"faces", &product.faces}}) {
        json[key] = Json::array();
        for (const PlaceErrors& place : *places) json[key].push_back(place_json(place, product.channels));
    }
    return json;
}

}  // namespace

std::string verdict_line(const ProductComparison& product) {
    const ErrorFigures& worst = product.worst;
    std::string line = (product.passed() ? "ok    " : "FAIL  ") + product.pair.name + ": ";
    switch (product.verdict) {
        case Verdict::identical:
            line += "identical";
            break;
        case Verdict::within_ulp:
            line += worst.differing == 0
                        ? "equal values in files that differ"
                        : "equal within " + std::to_string(worst.max_ulp) + " ulp; " +
                              count(worst.differing) + " of " + count(worst.values) + " values differ";
            break;
        case Verdict::within:
            line += worst.values == 0
                        ? "within thresholds"
                        : "within thresholds: " + std::to_string(worst.max_ulp) + " ulp, relative RMS " +
                              number(worst.relative_rms) + ", largest relative error " +
                              number(worst.relative_max) + ", energy change " + number(worst.energy_change);
            break;
        default:
            line += product.reasons.front();
            if (product.reasons.size() > 1)
                line += " (and " + std::to_string(product.reasons.size() - 1) + " more)";
            if (!product.looks_like.empty()) line += "; looks like: " + product.looks_like;
    }
    for (const std::string& note : product.notes) line += "; " + note;
    return line;
}

std::string summary_line(const Comparison& comparison) {
    if (comparison.products.empty()) return "FAIL  nothing to compare";
    std::size_t failed = 0;
    for (const ProductComparison& product : comparison.products) failed += !product.passed();
    const std::string all = std::to_string(comparison.products.size()) +
                            (comparison.products.size() == 1 ? " product" : " products");
    return failed == 0 ? "ok    " + all : "FAIL  " + std::to_string(failed) + " of " + all;
}

Json comparison_json(const Comparison& comparison) {
    Json products = Json::array();
    for (const ProductComparison& product : comparison.products) products.push_back(product_json(product));
    return {{"version", 1},
            {"passed", comparison.code == ExitCode::done},
            {"exit_code", static_cast<int>(comparison.code)},
            {"thresholds", thresholds_json(comparison.thresholds)},
            {"products", std::move(products)}};
}

}  // namespace pbrbake::verify
