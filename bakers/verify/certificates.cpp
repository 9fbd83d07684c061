#include "bakers/verify/certificates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/verify/page.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kNothing = 1e-6;  // roundings of a float, which differ between platforms

bool is_same_bake(const Json& a, const Json& b) {
    return std::ranges::all_of(std::array{"kind", "params", "inputs"}, [&](const char* key) {
        return a.contains(key) && b.contains(key) && a[key] == b[key];
    });
}

Json key_of(const Json& figure) {
    return {figure.value("metric", Json()), figure.value("level", Json()), figure.value("evidence", Json())};
}

std::string name_of(const Json& figure) {
    std::string name = figure["metric"].get<std::string>();
    if (figure.contains("level")) name += " of level " + std::to_string(figure["level"].get<int>());
    return name;
}

}  // namespace

std::string certificate_difference(const Json& a, const Json& b, double most) {
    if (!a.is_object() || !b.is_object() || !is_same_bake(a, b)) return "";
    const Json::json_pointer figures("/certificate/figures");
    if (!a.contains(figures) || !b.contains(figures)) return "";
    for (const Json& of_b : b[figures]) {
        const Json& list = a[figures];
        const auto of_a = std::ranges::find(list, key_of(of_b), key_of);
        if (of_a == list.end()) continue;
        const double va = (*of_a)["value"].get<double>(), vb = of_b["value"].get<double>();
        const double larger = std::max(std::abs(va), std::abs(vb));
        if (larger > kNothing && !(std::abs(va - vb) <= most * larger))
            return "the certificate's " + name_of(of_b) + " is " + number(va) + " instead of " + number(vb);
    }
    return "";
}

}  // namespace pbrbake::verify
