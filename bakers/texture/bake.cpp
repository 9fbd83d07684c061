#include <algorithm>
#include <cmath>

#include "bakers/texture/chain.hpp"
#include "bakers/texture/convert.hpp"
#include "bakers/texture/difference.hpp"
#include "bakers/texture/gltf_document.hpp"
#include "bakers/texture/material.hpp"
#include "bakers/texture/store.hpp"

namespace pbrbake::texture {
namespace {

constexpr std::string_view kGltfEnd = ".gltf";

/// A map's value of a texel, before codes: what an even sky makes of it against what it made of the source.
float map_value(ExtraMap map, const Layout& layout, const Rows& rows, const Texels& texels, std::size_t x,
                pbr::Scattering scattering) {
    if (map == ExtraMap::confidence) return rows.confidence[texels.begin + x];
    constexpr double kLargestDelta = 10, kLargestChange = .5;
    const Colour before = rows.albedo[texels.begin + x];
    const Unpacked made = packed(layout, texels, x);
    const Colour after = pbr_albedo(made.reflected, made.f90, made.perceptual_roughness, scattering).total();
    if (map == ExtraMap::difference)
        return static_cast<float>(std::min(1., delta_e(before, after) / kLargestDelta));
    const double energy = static_cast<double>(pbr::mean_channel(before)),
                 change = static_cast<double>(pbr::mean_channel(after)) - energy;
    const double relative = energy > 0 ? change / energy : 0;
    return static_cast<float>(.5 + std::clamp(relative / kLargestChange, -1., 1.) / 2);
}

void warn(const Sources& sources, const Survey& survey, const Findings& found, Product& product) {
    for (const std::string& warning : sources.warnings()) product.warnings.push_back(warning);
    for (const std::string& warning : survey.doubts.warnings) product.warnings.push_back(warning);
    if (found.f0_clamped > 0)
        product.warnings.push_back(
            percent(found.f0_clamped) +
            " of texels had specular lobes that reflect more than a PBR lobe can; f0 is 1 there");
    if (found.above_one > 0)
        product.warnings.push_back(percent(found.above_one) +
                                   " of texels have a diffuse or specular above 1, and are taken as 1; state "
                                   "diffuse_factor or specular_factor if the map is scaled");
    if (found.over_unity > .01)
        product.warnings.push_back(percent(found.over_unity) + " of texels return more light than arrives");
    if (found.low_confidence > .5)
        product.warnings.push_back("the data don't tell metal from dielectric in " +
                                   percent(found.low_confidence) + " of texels; state surface, or calibrate");
    if (!survey.calibration.warning.empty()) product.warnings.push_back(survey.calibration.warning);
}

/// Of lobes with Frostbite's f90 below 1, the largest f0 in a channel over f90: all of it in one channel.
constexpr float kLargestDimF0 = 1 / (50 * .33f);

/// Levels that a strip of rows makes below its own before it is let go.
constexpr int kStripLevels = 2;

/// A set on its way to images. The largest levels are never in memory but as stored: they are made by strips,
/// each of which leaves its rows of a level further down.
class SetBake {
  public:
    SetBake(const Sources& sources, Context& context)
        : sources_(sources),
          params_(sources.params()),
          context_(context),
          layout_(layout_of(sources)),
          survey_(survey(sources, context)),
          findings_(static_cast<std::size_t>(sources.height())),
          largest_f0_(static_cast<std::size_t>(sources.height())),
          least_factor_(static_cast<std::size_t>(sources.height()), 1.f),
          is_coded_(context.may_store(PixelType::unorm8) && has_pictures(params_)),
          rounds_first_(is_coded_ && !params_.dither),
          store_(params_, layout_, sources.width(), sources.height(), is_coded_) {}

    Product run() {
        const int by_strips = std::min(kStripLevels, store_.levels() - 1);
        MapLevel level = make_strips(by_strips);
        for (int l = by_strips + 1; l < store_.levels(); ++l) {
            context_.check_cancelled();
            level = make_below(level, l);
        }
        const float unit = layout_.has_residual ? specular_unit() : 1;
        if (least_factor() == 1) layout_.drop_specular_factor();
        if (layout_.has_residual) {
            const bool holds_more =
                context_.may_store(PixelType::half) || context_.may_store(PixelType::float32);
            store_.divide_residual(unit, layout_.has_specular_factor(), is_coded_ || !holds_more);
        }
        Product product;
        product.images = store_.take();
        if (context_.may_store(PixelType::unorm8)) product.pixel = PixelType::unorm8;
        Findings total;
        for (const Findings& row : findings_) total += row;
        const double texels = static_cast<double>(sources_.width()) * sources_.height();
        for (double* sum : {&total.f0_clamped, &total.above_one, &total.over_unity, &total.low_confidence,
                            &total.metallic, &total.confidence})
            *sum /= texels;
        product.properties["set"] = properties_json(params_, layout_, survey_, total, sources_, unit);
        add_documents(unit, product);
        warn(sources_, survey_, total, product);
        return product;
    }

  private:
    void add_documents(float unit, Product& product) const {
        const bool is_gltf = context_.product_file().ends_with(kGltfEnd);
        std::optional<Unpacked> factors;
        if (is_gltf && !has_pictures(params_)) {
            factors = unpack(layout_, product.images, 0, 0, unit, 1);
            product.properties["set"]["factors"] = factors_json(*factors);
            product.images.clear();
        }
        Json material = material_json(params_, layout_, unit, factors);
        if (is_gltf)
            product.documents.push_back(
                {"gltf", gltf_document(params_, material["gltf"], context_.product_file()), ""});
        product.documents.push_back({"material.json", std::move(material), ""});
    }

    /// The rows that a strip has of a level: those before `own_end` are stored, and those beyond, which are
    /// another strip's, are for levels of odd height below.
    struct Band {
        int begin, own_end, end;
    };
    using Bands = std::array<Band, kStripLevels + 1>;

    /// A strip's rows of levels 0 to `deepest`, of which it has `own`.
    Bands bands_of(RowRange own, int deepest) const {
        Bands bands{};
        bands[static_cast<std::size_t>(deepest)] = {own.begin, own.end, own.end};
        for (int l = deepest - 1; l >= 0; --l) {
            const Band& next = bands[static_cast<std::size_t>(l) + 1];
            const int height = side_below(sources_.height(), l);
            const RowRange rows = rows_under({next.begin, next.own_end}, height);
            bands[static_cast<std::size_t>(l)] = {rows.begin, rows.end,
                                                  std::max(rows.end, reach_under(next.end - 1, height))};
        }
        return bands;
    }

    /// Makes levels 0 to `deepest`, some rows at a time; returns the last where there are several.
    MapLevel make_strips(int deepest) {
        const int width = sources_.width(), height = sources_.height(),
                  deepest_height = side_below(height, deepest);
        // Strips of about 2^16 texels, with room for rows of others.
        const int step = std::max(1, std::clamp((1 << 16) / width, 2, 64) >> deepest);
        const int most_rows = (step + 2) << deepest;
        MapLevel last = level_below(maps_of_set(), deepest, deepest > 0 ? deepest_height : 0);
        const std::int64_t strips = (deepest_height + step - 1) / step;
        const std::int64_t grain = std::max<std::int64_t>(1, strips / (4 * context_.threads()));
        context_.parallel_for(strips, grain, [&](std::int64_t begin, std::int64_t end) {
            Converter converter(sources_, survey_, most_rows);
            MapLevel between = level_below(maps_of_set(), 1, deepest > 1 ? most_rows / 2 : 0);
            for (std::int64_t strip = begin; strip < end; ++strip) {
                const auto first = static_cast<int>(strip) * step;
                const Bands bands = bands_of({first, std::min(first + step, deepest_height)}, deepest);
                make_strip(converter, bands, between, deepest, last);
            }
        });
        context_.count("texels", static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height));
        return last;
    }

    void make_strip(Converter& converter, const Bands& bands, MapLevel& between, int deepest,
                    MapLevel& last) {
        const Rows& rows = converter.convert(bands[0].begin, bands[0].own_end, bands[0].end, findings_);
        for (int y = bands[0].begin; y < bands[0].own_end; ++y) store_largest(rows, y);
        const MapLevel* above = &rows.level;
        for (int l = 1; l <= deepest; ++l) {
            const Band& band = bands[static_cast<std::size_t>(l)];
            MapLevel& level = l == deepest ? last : between;
            if (l < deepest) {
                level.first = band.begin;
                level.rows = band.end - band.begin;
            }
            for (int y = band.begin; y < band.end; ++y) fill_smaller(*above, y, level);
            for (int y = band.begin; y < band.own_end; ++y) store_row(level, y, l);
            above = &level;
        }
    }

    /// Makes a level from the whole one above.
    MapLevel make_below(const MapLevel& above, int l) {
        MapLevel level = level_below(above, 1, side_below(above.height));
        context_.parallel_for(level.height, 16, [&](std::int64_t begin, std::int64_t end) {
            for (auto y = static_cast<int>(begin); y < end; ++y) {
                fill_smaller(above, y, level);
                store_row(level, y, l);
            }
        });
        return level;
    }

    /// The largest level without rows: which maps the set has.
    MapLevel maps_of_set() const {
        MapLevel maps;
        maps.width = sources_.width();
        maps.height = sources_.height();
        if (sources_.may_be_dim()) maps.f90.resize(1);
        if (sources_.has_normal()) maps.normal.resize(1);
        if (sources_.has_occlusion()) maps.occlusion.resize(1);
        if (sources_.has_opacity()) maps.opacity.resize(1);
        if (sources_.has_emissive()) maps.emissive.resize(1);
        return maps;
    }

    void store_largest(const Rows& rows, int y) {
        const MapLevel& level = rows.level;
        const auto width = static_cast<std::size_t>(level.width);
        Texels texels{level, level.at(y), width, rounds_first_, {}};
        make_materials(layout_, sources_.visible_error(), texels);
        find_residual(texels, y);
        const std::size_t to = static_cast<std::size_t>(y) * width;
        store(texels, 0, to);
        std::vector<float> values(width);
        const pbr::Scattering scattering = scattering_of(params_);
        for (std::size_t i = 0; i < params_.maps.size(); ++i) {
            for (std::size_t x = 0; x < width; ++x)
                values[x] = map_value(params_.maps[i], layout_, rows, texels, x, scattering);
            store_.put(layout_.images.size() + i, 0, 0, to, values);
        }
    }

    /// A row of means, of no more metal than a material has that reflects as much.
    void fill_smaller(const MapLevel& above, int y, MapLevel& level) const {
        fill_row(above, y, level);
        if (layout_.has_residual && survey_.calibration.surface != "metal")
            limit_metallic(sources_.visible_error(), level.at(y), static_cast<std::size_t>(level.width),
                           level);
    }

    void store_row(const MapLevel& level, int y, int l) {
        const auto width = static_cast<std::size_t>(level.width);
        Texels texels{level, level.at(y), width, rounds_first_, {}};
        make_materials(layout_, sources_.visible_error(), texels);
        store(texels, static_cast<std::size_t>(l), static_cast<std::size_t>(y) * width);
    }

    /// What row y of the largest level asks of the residual.
    void find_residual(const Texels& texels, int y) {
        if (!layout_.has_residual) return;
        float& largest = largest_f0_[static_cast<std::size_t>(y)];
        float& least = least_factor_[static_cast<std::size_t>(y)];
        for (std::size_t x = 0; x < texels.count; ++x) {
            const float f0 = pbr::max_channel(texels.dielectric_f0[x]);
            const float factor = texels.specular_factor.empty() ? 1 : texels.specular_factor[x];
            least = std::min(least, factor);
            if (texels.level.metallic[texels.begin + x] < .99f)
                largest = std::max(largest, factor < 1 ? std::min(f0 / factor, kLargestDimF0) : f0);
        }
    }

    float least_factor() const { return *std::ranges::min_element(least_factor_); }

    /// Into all of the layout's channels, from texel `to` of a level on.
    void store(const Texels& texels, std::size_t l, std::size_t to) {
        std::vector<float> values(texels.count);
        for (std::size_t i = 0; i < layout_.images.size(); ++i)
            for (std::size_t c = 0; c < layout_.images[i].channels.size(); ++c) {
                pack(layout_.images[i].channels[c], texels, values.data());
                store_.put(i, c, l, to, values);
            }
    }

    /// The largest dielectric f0 that matters, at least the usual one: what a code of 1 stands for. Texels
    /// that are nearly all metal don't show theirs. Of the largest level: where smaller ones mix metal with
    /// dielectric, what is left for dielectric f0 can be twenty times as much, and would take level 0's
    /// codes.
    float specular_unit() const {
        return store_.residual_unit(
            std::max(static_cast<float>(params_.dielectric_f0), *std::ranges::max_element(largest_f0_)));
    }

    const Sources& sources_;
    const TextureParams& params_;
    Context& context_;
    Layout layout_;
    Survey survey_;
    std::vector<Findings> findings_;   ///< sums of each row
    std::vector<float> largest_f0_;    ///< of each row's dielectrics, over their specular_factor
    std::vector<float> least_factor_;  ///< of each row
    bool is_coded_;                    ///< factors alone may end up in a document, as they are
    bool rounds_first_;                ///< Texels::is_coded; codes with noise aren't known before
    Store store_;
};

}  // namespace

Product bake(const TextureParams& params, const Inputs& inputs, Context& context) {
    const Sources sources(params, inputs);
    return SetBake(sources, context).run();
}

}  // namespace pbrbake::texture
