#include "bakers/run/bake_one.hpp"

#include <algorithm>
#include <new>
#include <sstream>

#include "bakers/formats.hpp"
#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/run/embedded_pictures.hpp"
#include "bakers/run/entry.hpp"

namespace pbrbake::run {
namespace fs = std::filesystem;
namespace {

std::string number_text(double number) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream << number;
    return stream.str();
}

/// Whether a document is the bake's product itself, as its format has no pictures.
bool is_main_document(const job::Bake& bake, const std::string& suffix) {
    return find_format(bake.format)->is_document() && suffix == bake.format;
}

/// Files that a bake will write, as far as the sources that are known tell.
std::vector<fs::path> outputs_of(const job::Job& job, const job::Bake& bake, const Inputs& known) {
    std::vector<fs::path> files{(job.output / bake.file).lexically_normal()};
    if (bake.baker->images)
        for (const std::string& name : bake.baker->images(bake.json))
            files.push_back((job.output / job::image_file(bake, name)).lexically_normal());
    if (bake.baker->documents)
        for (const std::string& suffix : bake.baker->documents(bake.json, known))
            if (!is_main_document(bake, suffix))
                files.push_back((job.output / job::document_file(bake, suffix)).lexically_normal());
    if (job.record == job::Record::sidecar) files.push_back(sidecar_file(job, bake));
    return files;
}

PixelType pixel_of(const Product& product, const job::Bake& bake) {
    return product.pixel.value_or(bake.pixel);
}

/// What a bake's own stage makes, its values as they will be stored.
Product baked(const job::Bake& bake, const Inputs& inputs, Context& context) {
    context.set_product_file(bake.file);
    context.set_pixels(bake.pixel_stated ? std::vector{bake.pixel} : picture_format(bake.format).pixels);
    Product product = bake.baker->run(bake.json, inputs, context);
    product.scale = io::quantise(product.images, pixel_of(product, bake));
    return product;
}

/// A bake on its way: what one stage leaves for the next.
class BakeRun {
  public:
    BakeRun(const job::Job& job, const job::Bake& bake, const Options& options)
        : job_(job),
          bake_(bake),
          options_(options),
          report_(outline_bake(job, bake)),
          sources_(bake.sources) {}

    BakeReport run() {
        guarded([&] {
            run_stages();
            report_.status = report_.error.empty() ? Status::done : Status::accuracy_missed;
        });
        report_.peak_memory_bytes = peak_memory_bytes();
        return std::move(report_);
    }

    BakeReport plan() {
        if (bake_.baker->follow) guarded([&] { look_ahead(); });
        return std::move(report_);
    }

    Inputs decoded() {
        decode();
        return std::move(inputs_);
    }

  private:
    /// What a step throws goes into the report.
    template <class Step>
    void guarded(Step step) {
        try {
            step();
        } catch (const Cancelled&) {
            end(Status::interrupted, ExitCode::interrupted, "interrupted");
        } catch (const Error& error) {
            end(Status::failed, error.code(), error.what());
        } catch (const std::bad_alloc&) {
            end(Status::failed, ExitCode::mixed_failures, "does not fit into memory; bake it smaller");
        } catch (const std::exception& error) {
            end(Status::failed, ExitCode::mixed_failures,
                std::string("internal error, please report: ") + error.what());
        }
    }

    void run_stages() {
        if (bake_.error) throw *bake_.error;
        timed(Stage::decode, [&] { decode(); });
        timed(Stage::bake, [&] { bake(); });
        if (bake_.certify != job::Certify::none) timed(Stage::certify, [&] { certify(); });
        release_sources();
        timed(Stage::encode, [&] { encode(); });
        timed(Stage::write, [&] { write(); });
        check_accuracy();
    }

    template <class Step>
    void timed(Stage stage, Step step) {
        if (options_.cancel && options_.cancel->load(std::memory_order_relaxed)) throw Cancelled{};
        if (options_.observer) options_.observer->progress(stage, 0);
        const Stopwatch watch;
        step();
        report_.seconds[stage] = watch.elapsed();
    }

    void end(Status status, ExitCode code, std::string error) {
        report_.status = status;
        report_.code = code;
        report_.error = std::move(error);
    }

    std::unique_ptr<Context> context(Stage stage) const {
        Context::ProgressSink sink;
        if (options_.observer)
            sink = [observer = options_.observer, stage](double fraction) {
                observer->progress(stage, fraction);
            };
        return std::make_unique<Context>(options_.threads, bake_.accuracy, std::move(sink), options_.cancel);
    }

    void decode() {
        for (const job::Source& source : bake_.sources) {
            SourceImage image = source.file.empty() ? builtin(source.read.path) : read(source);
            warn_of(source, image);
            inputs_.emplace(source.read.field, std::move(image));
        }
        warn_of_assumptions();
        for (const fs::path& buffer : embedded_.buffers()) report_.reads.push_back(buffer);
        if (!bake_.baker->follow) return;
        for (const Read& read : bake_.baker->follow(inputs_)) {
            const auto source = followed(read);
            if (!source) continue;
            inputs_.emplace(read.field, io::read_text_source(source->file));
            report_.reads.push_back(source->file);
            sources_.push_back(*source);
        }
    }

    /// The first source names files, of which some are read and some may be written.
    void look_ahead() {
        const job::Source& first = sources_.front();
        const Inputs known{{first.read.field, read(first)}};
        for (const Read& read : bake_.baker->follow(known))
            if (const auto source = followed(read)) report_.reads.push_back(source->file);
        report_.writes = outputs_of(job_, bake_, known);
    }

    /// A file that the first source names. What leads out of that source's folder counts as absent: a
    /// downloaded file must not choose what is read.
    std::optional<job::Source> followed(const Read& read) const {
        const fs::path path(read.path);
        const bool inside =
            path.is_relative() && std::find(path.begin(), path.end(), fs::path("..")) == path.end();
        job::Source source{read, sources_.front().file.parent_path() / path};
        std::error_code error;
        if (!inside || !fs::is_regular_file(source.file, error)) return {};
        return source;
    }

    SourceImage builtin(const std::string& path) const {
        if (job_.working_space != "lin_rec709")
            throw Error(ExitCode::unreadable_input, path,
                        "is defined in lin_rec709; bake it with that working_space, or take a file");
        return bake_.baker->builtin(path.substr(kBuiltinScheme.size()));
    }

    SourceImage read(const job::Source& source) {
        if (source.read.as == Read::As::text) return io::read_text_source(source.file);
        io::ReadRequest request{source.file,
                                source.read.colour_space,
                                job_.working_space,
                                source.read.with_alpha,
                                {job_.max_side, job_.max_decoded_bytes},
                                source.read.as_codes,
                                source.read.infinity};
        if (source.image) {
            request.bytes = embedded_.read(source.file, *source.image);
            request.path = source.file.parent_path() / source.read.path;
        }
        return io::read_source(request);
    }

    void warn_of(const job::Source& source, const SourceImage& image) {
        const std::string& path = source.read.path;
        const Repairs& repairs = image.repairs;
        if (repairs.non_finite > 0)
            report_.warnings.push_back(path + ": " + std::to_string(repairs.non_finite) +
                                       " texels were NaN or infinite; NaN became 0, infinity the largest " +
                                       (source.read.infinity == Infinity::peak ? "value" : "float"));
        if (repairs.negative > 0)
            report_.warnings.push_back(path + ": " + std::to_string(repairs.negative) +
                                       " texels were negative (lowest " + number_text(repairs.lowest) +
                                       "); they became 0");
        if (!image.colour_doubt.empty())
            report_.warnings.push_back(path + ": " + image.colour_doubt);
        else if (image.colour_space_assumed)
            assumed_[image.colour_space].push_back(path);
    }

    void warn_of_assumptions() {
        for (const auto& [colour_space, paths] : assumed_) {
            const std::size_t others = paths.size() - 1;
            std::string text = paths.front();
            if (others > 0) text += " and " + (others == 1 ? paths[1] : std::to_string(others) + " more");
            text += others > 0 ? ": do not tell their colour space" : ": does not tell its colour space";
            report_.warnings.push_back(text + "; taken as " + colour_space + " (state it with colour_space)");
        }
    }

    void bake() {
        const auto context = this->context(Stage::bake);
        product_ = baked(bake_, inputs_, *context);
        report_.bake_evaluations = context->counts();
        for (const std::string& warning : product_.warnings) report_.warnings.push_back(warning);
        if (product_.scale != 1)
            report_.warnings.push_back("values exceed what the pixel format holds; they are stored times " +
                                       number_text(product_.scale) + " (\"scale\" in the record)");
    }

    PixelType pixel() const { return pixel_of(product_, bake_); }

    void certify() {
        const auto context = this->context(Stage::certify);
        context->set_certify_fully(bake_.certify == job::Certify::full);
        certificate_ = bake_.baker->certify(bake_.json, inputs_, product_, *context);
        report_.certify_evaluations = context->counts();
    }

    /// Nobody looks at sources' texels any more; the record still wants the rest.
    void release_sources() {
        for (auto& [field, source] : inputs_) {
            source.image.levels.clear();
            source.codes = {};
        }
    }

    void encode() {
        const io::FileInfo info{pixel(), metadata(job_, bake_, product_), bake_.name};
        for (Image& image : product_.images) {
            const bool is_first = files_.empty() && !find_format(bake_.format)->is_document();
            const fs::path file = is_first ? fs::path(bake_.file) : named_file(image.name);
            std::vector<std::byte> bytes = io::encode(picture_format(bake_.format).name, image, info);
            outputs_.push_back({file, io::hash_bytes(bytes.data(), bytes.size()), bytes.size()});
            files_.push_back(std::move(bytes));
            image.levels.clear();
        }
        // Pictures come before documents, and of these the main file first.
        std::stable_partition(product_.documents.begin(), product_.documents.end(),
                              [&](const Document& document) { return is_main(document.suffix); });
        for (const Document& document : product_.documents) add_document(document);
    }

    bool is_main(const std::string& suffix) const { return is_main_document(bake_, suffix); }

    void add_document(const Document& document) {
        const std::string text = document.json.is_null() ? document.text : job::to_text(document.json);
        const fs::path file = job::document_file(bake_, document.suffix);
        for (const job::Bake& other : job_.bakes)
            if (other.file == file && !(&other == &bake_ && is_main(document.suffix)))
                throw Error(ExitCode::unwritable_output, file.string(),
                            "is the product of bake \"" + other.name + "\" too; rename one of the two");
        const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
        outputs_.push_back({file, io::hash_bytes(bytes, text.size()), text.size()});
        files_.emplace_back(bytes, bytes + text.size());
    }

    /// "X_<name>.ext"; refused if it is another bake's own product.
    fs::path named_file(const std::string& image_name) const {
        const fs::path file = job::image_file(bake_, image_name);
        for (const job::Bake& other : job_.bakes)
            if (other.file == file)
                throw Error(ExitCode::unwritable_output, file.string(),
                            "is the product of bake \"" + other.name + "\" too; rename one of the two");
        return file;
    }

    /// What a source's own files lead to is known to no job.
    void keep_sources() const {
        for (const Output& output : outputs_)
            for (const fs::path& read : report_.reads) {
                std::error_code error;  // of a file that isn't there
                if (fs::equivalent(job_.output / output.file, read, error))
                    throw Error(ExitCode::unwritable_output, (job_.output / output.file).string(),
                                "is a source of this bake too; choose another name or output folder");
            }
    }

    void write() {
        keep_sources();
        report_.entry =
            entry(job_, bake_, sources_, inputs_, product_, certificate_, report_.bake_evaluations, outputs_);
        report_.writes.clear();
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const fs::path file = job_.output / outputs_[i].file;
            write_atomically(file, files_[i]);
            const bool is_first = outputs_[i].file == bake_.file;
            report_.writes.insert(is_first ? report_.writes.begin() : report_.writes.end(), file);
        }
        if (job_.record == job::Record::manifest) return;
        const fs::path sidecar = sidecar_file(job_, bake_);
        write_atomically(sidecar, job::to_text(report_.entry));
        report_.writes.push_back(sidecar);
    }

    void check_accuracy() {
        if (!bake_.accuracy.stated()) return;
        const auto& headline = certificate_.headline;
        if (headline && headline->value <= bake_.accuracy.max_error) return;
        report_.code = ExitCode::accuracy_missed;
        const std::string place =
            headline && headline->level ? "level " + std::to_string(*headline->level) + ": " : "";
        report_.error = headline ? place + headline->metric + " is " + number_text(headline->value) +
                                       ", above the max_error of " + number_text(bake_.accuracy.max_error) +
                                       " that was stated"
                                 : "its certificate has no figure to hold max_error against";
        report_.error += "; the product was written all the same";
    }

    const job::Job& job_;
    const job::Bake& bake_;
    const Options& options_;
    BakeReport report_;
    std::vector<job::Source> sources_;  ///< the bake's, and those that its files name
    std::map<std::string, std::vector<std::string>>
        assumed_;  ///< sources by the colour space they are taken for
    EmbeddedPictures embedded_;
    Inputs inputs_;
    Product product_;
    Certificate certificate_;
    std::vector<Output> outputs_;
    std::vector<std::vector<std::byte>> files_;
};

}  // namespace

BakeReport outline_bake(const job::Job& job, const job::Bake& bake) {
    BakeReport report;
    report.job = &job;
    report.bake = &bake;
    report.warnings = bake.warnings;
    for (const job::Source& source : bake.sources)  // pictures may be embedded in one file
        if (!source.file.empty() && std::ranges::find(report.reads, source.file) == report.reads.end())
            report.reads.push_back(source.file);
    report.writes = outputs_of(job, bake, {});
    return report;
}

BakeReport plan_bake(const job::Job& job, const job::Bake& bake, const Options& options) {
    return BakeRun(job, bake, options).plan();
}

BakeReport run_bake(const job::Job& job, const job::Bake& bake, const Options& options) {
    return BakeRun(job, bake, options).run();
}

Inputs decoded_inputs(const job::Job& job, const job::Bake& bake, const Options& options) {
    return BakeRun(job, bake, options).decoded();
}

Seconds time_bake_stage(const job::Bake& bake, const Inputs& inputs, const Options& options) {
    Context context(options.threads, bake.accuracy, {}, options.cancel);
    const Stopwatch watch;
    const Product product = baked(bake, inputs, context);
    return watch.elapsed();
}

}  // namespace pbrbake::run
