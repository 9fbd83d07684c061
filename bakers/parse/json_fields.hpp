#pragma once
// Fields of a JSON source, read with errors that name the file and the pointer.

#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::parse {

/// A source's JSON. Throws Error(unreadable_input) with file, line and column.
Json parse_json_source(std::string_view text, const std::string& file);

/// An object or array of a document, and where it stands. Views into the document.
class JsonFields {
  public:
    JsonFields(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    const Json& json() const { return *json_; }
    const std::string& place() const { return place_; }  ///< "scene.json#/lights/0"
    bool has(std::string_view key) const;

    /// A finite number; `fallback` where there is none under any of the names. null counts as absent.
    double number(std::initializer_list<std::string_view> keys, double fallback) const;
    std::optional<double> number(std::initializer_list<std::string_view> keys) const;
    std::string text(std::initializer_list<std::string_view> keys, std::string fallback) const;
    bool boolean(std::string_view key, bool fallback) const;
    /// `count` finite numbers, or nothing where the key is absent.
    std::optional<std::vector<double>> numbers(std::initializer_list<std::string_view> keys,
                                               std::size_t count) const;
    std::optional<glm::dvec3> vector(std::initializer_list<std::string_view> keys) const;
    /// An object; nothing where absent.
    std::optional<JsonFields> object(std::initializer_list<std::string_view> keys) const;
    /// The elements of an array, each an object; none where absent.
    std::vector<JsonFields> objects(std::string_view key) const;
    /// The elements of an array of indices in [0, count); none where absent.
    std::vector<std::size_t> indices(std::string_view key, std::size_t count) const;
    std::optional<std::size_t> index(std::string_view key, std::size_t count) const;

    /// Throws for a key that is none of these: "place/key: unknown key; allowed: …".
    void allow(const std::vector<std::string>& keys) const;

    /// Throws: "place/key: found …; allowed: …".
    [[noreturn]] void refuse(std::string_view key, std::string_view allowed) const;

  private:
    const Json* find(std::initializer_list<std::string_view> keys, std::string_view& found) const;

    const Json* json_;
    std::string place_;
};

}  // namespace pbrbake::parse
