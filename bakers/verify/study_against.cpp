#include "bakers/verify/study_against.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/verify/page.hpp"

namespace pbrbake::verify {
namespace {

/// "probe_indoor, fis 32" -> ratio, of every setting that was timed and is no base.
std::map<std::string, double> ratios_of(const Json& study) {
    std::map<std::string, double> ratios;
    for (const Json& studied : study.at("cases"))
        for (std::size_t i = 0; i < studied.at("points").size(); ++i) {
            const Json& point = studied["points"][i];
            if (!point.contains("time_ratio") || i == studied.at("base").get<std::size_t>()) continue;
            ratios[studied.at("name").get<std::string>() + ", " + point.at("series").get<std::string>() +
                   " " + point.at("step").get<std::string>()] = point["time_ratio"].at("median").get<double>();
        }
    return ratios;
}

}  // namespace

std::string ratio_agreement(const Json& now, const Json& before, double most) {
    const std::map<std::string, double> of_now = ratios_of(now), of_before = ratios_of(before);
    std::size_t both = 0, agree = 0;
    double furthest = 0;
    std::string where;
    for (const auto& [setting, ratio] : of_now) {
        const auto found = of_before.find(setting);
        if (found == of_before.end() || !(ratio > 0 && found->second > 0)) continue;
        const double apart = std::max(ratio / found->second, found->second / ratio) - 1;
        ++both;
        agree += apart <= most;
        if (apart <= furthest) continue;
        furthest = apart;
        where = " (" + setting + ": " + number(ratio) + ", before " + number(found->second) + ")";
    }
    if (both == 0) return "no setting in common";
    return std::to_string(agree) + " of " + std::to_string(both) + " ratios agree within " + percent(most) +
           "; furthest apart by " + percent(furthest) + where;
}

}  // namespace pbrbake::verify
