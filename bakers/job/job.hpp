#pragma once
// A job: bakes that were validated as a whole, with every default filled in and every path resolved.
//
// Job files and one-shot commands come in by the same door: a JSON document. What differs is how a mistake is
// named (a JSON pointer, or a flag) and whether paths are trusted.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/registry.hpp"

namespace pbrbake::job {

enum class Certify { none, sampled, full };

/// A file (or built-in) that a bake reads, found and allowed.
struct Source {
    Read read;
    std::filesystem::path file;             ///< empty for "builtin:NAME"
    std::optional<std::size_t> image = {};  ///< of that glTF file, in place of the file itself
};

/// One bake, ready to run.
struct Bake {
    const Baker* baker = nullptr;
    std::string kind, name, format;
    std::string file;  ///< of its first image, in the job's output folder: "lamp.exr"
    PixelType pixel = PixelType::half;
    bool pixel_stated = false;  ///< by the job, instead of "auto"
    Certify certify = Certify::sampled;
    Accuracy accuracy;
    Json json;    ///< what the baker reads: every property, defaults filled in
    Json params;  ///< the same as manifests show it: without kind and name, and without absolute paths
    std::vector<Source> sources;
    std::vector<std::string> warnings;  ///< of the source that filled it in
    std::optional<Error> error;         ///< why it fails though the job is sound: a source can't be read
    std::vector<std::string> parts;     ///< names of the bakes that it joins, which come before it
};

/// "X_normal.png" for image "normal" of a bake whose first file is X.png or the document X.gltf.
std::string image_file(const Bake& bake, const std::string& image);
/// "X.light.json" for document "light.json" of a bake whose first file is X.exr.
std::string document_file(const Bake& bake, const std::string& suffix);

/// Where the record of what was baked goes.
enum class Record {
    manifest,  ///< one manifest.json in the output folder
    sidecar,   ///< X.ext.json beside each X.ext
};

struct Job {
    std::filesystem::path file;    ///< as the user gave it; empty for a one-shot command
    std::filesystem::path output;  ///< folder
    Record record = Record::manifest;
    std::string working_space;
    int max_side = 0;                     ///< of a source, pixels
    std::uint64_t max_decoded_bytes = 0;  ///< of a source
    std::vector<Bake> bakes;
};

/// All mistakes of a job at once; what() has one a line.
class JobError : public Error {
  public:
    /// `mistakes` is not empty; each `pointer` holds the whole place, as in "job.json#/bakes/0/size" or
    /// "--size".
    JobError(ExitCode code, std::vector<Mistake> mistakes);
    const std::vector<Mistake>& mistakes() const noexcept { return mistakes_; }

  private:
    std::vector<Mistake> mistakes_;
};

/// Reads and validates a job file. `roots` are allowed besides those that the job declares.
/// Throws Error(unreadable_input) if there is no such file, JobError(invalid_job) for what is wrong with it.
Job load(const std::filesystem::path& file, const std::vector<std::filesystem::path>& roots = {});

/// A document that is not a file: how to name its mistakes, and where its one product goes.
struct OneShot {
    std::filesystem::path output;  ///< "out/dfg.exr"; trusted
    std::vector<std::pair<std::string, std::string>>
        places;  ///< JSON pointer -> how the user knows it ("--size")
};

/// Validates the document of a one-shot command; throws JobError(usage).
Job from_document(Json document, const OneShot& command);

}  // namespace pbrbake::job
