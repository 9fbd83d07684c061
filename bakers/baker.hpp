#pragma once
// The contract between a baker and the rest of the house: pure functions from memory to memory.
//
// A baker is three functions over its own Params struct:
//   reads(params)                              what it will read, before it runs
//   bake(params, inputs, context)  -> Product
//   certify(params, inputs, product, context) -> Certificate, of the product as it will be written
//   (quantised)
// and `check(params)`, which finds what a schema can't say. registry.cpp lists them.

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/context.hpp"
#include "bakers/error.hpp"
#include "bakers/image.hpp"

namespace pbrbake {

/// A JSON value in memory. Only job, parse and run turn it from or into text.
using Json = nlohmann::ordered_json;

/// What a path starts with that names a baker's own source instead of a file.
inline constexpr std::string_view kBuiltinScheme = "builtin:";

/// A file a bake will read: the Params field that names it, and how to decode it.
struct Read {
    /// A picture is decoded and colour-managed; a text is handed over as its bytes.
    enum class As { picture, text };

    std::string field;                  ///< "source": the key in Inputs, and the JSON pointer's last part
    std::string path;                   ///< as in the job, or "builtin:NAME"
    std::string colour_space = "auto";  ///< of a picture
    As as = As::picture;
    bool with_alpha = false;  ///< of a picture: keeps a fourth (or of grey, second) channel as A, as stored
    bool as_codes = false;    ///< of a picture: 8-bit files stay codes (SourceImage::codes)
    Infinity infinity = Infinity::peak;  ///< of a picture
};

/// What may be asked of files before a bake is settled. Paths are as in the job.
struct FileQueries {
    /// A file's bytes; throws Error.
    std::function<std::string(const std::string& path)> text;
    /// The path of a file that the job may read: as given, or else as the file is spelt that differs in the
    /// case of letters alone (the first of several); "" where there is none.
    std::function<std::string(const std::string& path)> find;
};

/// One bake that an unsettled one stands for.
struct Expansion {
    Json bake;                          ///< what it leaves out filled in; not checked against the schema
    std::string suffix;                 ///< of its name, "_brick"; "": the bake stands for this one alone
    std::vector<std::string> warnings;  ///< what was tolerated in its source
    std::optional<Error> error;         ///< why it can't be baked
};

/// Decoded and colour-managed sources, by Params field.
using Inputs = std::map<std::string, SourceImage>;

/// How a certified figure was had.
enum class Evidence {
    exact,     ///< equal by construction
    bound,     ///< proven not to be exceeded
    measured,  ///< computed over all of the product
    estimate,  ///< sampled; `interval` holds its 95 % confidence interval
};

/// One figure of a certificate.
struct Figure {
    std::string metric;  ///< "max_abs_error", "relative_rmse", "energy_error", …
    double value = 0;
    Evidence evidence = Evidence::measured;
    std::string method;  ///< how, in words
    std::optional<std::pair<double, double>> interval;
    std::optional<int> level;
    Json curve = nullptr;  ///< what the value sums up: {"columns": […], "rows": [[…], …]}
};

/// What is known of a product's error, and the work done for the bake. Deterministic: no times.
struct Certificate {
    std::vector<Figure> figures;
    /// The figure a stated max_error is held against (the worst level's, say).
    std::optional<Figure> headline;
};

/// A text that a bake makes besides its images: written to X.<suffix>.
struct Document {
    std::string suffix;  ///< "light.json"
    Json json;           ///< written as text by run; null: `text` is the document
    std::string text;
};

/// What a bake makes: images, documents, and the properties that go into its manifest entry.
struct Product {
    std::vector<Image> images;  ///< images[0] is written to X.ext; images[i] to X_<name>.ext
    std::string units = "relative";
    std::optional<PixelType> pixel;  ///< in place of the job's, where the accuracy chose it
    double scale = 1;  ///< stored value = scale * value; run sets it when the pixel format is too narrow
    std::vector<Document> documents;
    std::vector<std::string>
        warnings;     ///< what was tolerated or is doubtful in the sources, for the run report
    Json properties;  ///< "levels": […] of a probe, "columns": […] of a table
};

/// A mistake in a job, at a JSON pointer relative to the bake.
struct Mistake {
    std::string pointer;  ///< "/levels"
    std::string message;
};

}  // namespace pbrbake
