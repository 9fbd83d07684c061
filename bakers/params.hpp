#pragma once
// From a validated JSON bake to a plain Params struct: one field a schema property, the same names, no
// defaults.
//
// A Params struct lists its fields once:
//     template <class Visit> static void fields(Visit&& visit) { visit("size", &DfgParams::size); … }
// and an enumeration its names, in the order of its values:
//     template <> struct EnumNames<Axis> { static constexpr std::array names{"nov", "sqrt_nov"}; };
// By the time read_params runs, the schema has filled in defaults and refused everything it doesn't allow.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake {

template <class E>
struct EnumNames;

template <class E>
std::string_view enum_name(E value) {
    return EnumNames<E>::names[static_cast<std::size_t>(value)];
}

namespace params_detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

template <class T>
T read_value(const Json& value);

template <class E>
E read_enum(const Json& value) {
    const auto& text = value.get_ref<const std::string&>();
    for (std::size_t i = 0; i < EnumNames<E>::names.size(); ++i)
        if (text == EnumNames<E>::names[i]) return static_cast<E>(i);
    throw Error(ExitCode::invalid_job, "", "unknown value '" + text + "': schema and code disagree");
}

/// A property that is "one or several" in the schema is a vector in the struct; a lone value becomes one
/// element.
template <class T>
T read_value(const Json& value) {
    if constexpr (IsVector<T>::value) {
        T list;
        if (!value.is_array()) return {read_value<typename T::value_type>(value)};
        for (const Json& element : value) list.push_back(read_value<typename T::value_type>(element));
        return list;
    } else if constexpr (std::is_enum_v<T>) {
        return read_enum<T>(value);
    } else {
        return value.get<T>();
    }
}

}  // namespace params_detail

template <class Params>
Params read_params(const Json& bake) {
    Params params{};
    Params::fields([&]<class T>(const char* name, T Params::*member) {
        if (!bake.contains(name))
            throw Error(ExitCode::invalid_job, "",
                        std::string("property '") + name + "' has no value and no default");
        params.*member = params_detail::read_value<T>(bake.at(name));
    });
    return params;
}

template <class Params>
std::vector<std::string> field_names() {
    std::vector<std::string> names;
    Params::fields([&]<class T>(const char* name, T Params::*) { names.emplace_back(name); });
    return names;
}

}  // namespace pbrbake
