#pragma once
// Photometric files, IES LM-63 and EULUMDAT, as plain data: what the file says, before anything is made of
// it.
//
// Parsers are pure functions over bytes: strict where a mistake would be dangerous (counts, order, numbers),
// tolerant where it is harmless, and then a Diagnostic says what was assumed.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/parse/diagnostic.hpp"
#include "pbr/light/photometric_web.hpp"

namespace pbrbake::parse {

/// Lamp flux that depends on how the luminaire is tilted: TILT of LM-63.
struct TiltTable {
    int geometry = 1;  ///< 1 lamp base up or down, 2 and 3 horizontal
    std::vector<double> angles_deg, factors;
};

/// One [KEYWORD] of an LM-63 file; MORE lines are joined by '\n'. A line without a keyword has the name "".
struct Keyword {
    std::string name, value;
    bool operator==(const Keyword&) const = default;
};

/// What only LM-63 says. Numbers as filed.
struct Lm63Header {
    int edition = 2019;  ///< 1986, 1991, 1995, 2002, 2019
    std::vector<Keyword> keywords;
    std::string tilt_file;  ///< of TILT=FILE; its table is read apart
    std::optional<TiltTable> tilt;
    double lamps = 1, lumens_per_lamp = -1, multiplier = 1;
    int units = 2;  ///< 1 feet, 2 metres
    double width = 0, length = 0, height = 0;
    double ballast_factor = 1;
    double watts = 0;
    double field_12 =
        1;  ///< to 1991 the ballast-lamp photometric factor, then reserved, in 2019 how the file was made

    /// The first value of a keyword, or "".
    std::string_view value_of(std::string_view name) const;
};

/// Lamps that an EULUMDAT luminaire may hold; sets are alternatives.
struct LampSet {
    double count = 1;  ///< negative: absolute photometry
    std::string type;
    double flux_lm = 0;  ///< of all lamps of the set
    std::string colour, rendering;
    double watts = 0;
    bool operator==(const LampSet&) const = default;
};

/// What only EULUMDAT says. Numbers as filed; lengths in mm.
struct EulumdatHeader {
    std::string company;
    int type = 1;      ///< Ityp: 0 point, 1 about the vertical axis, 2 linear, 3 point without symmetry
    int symmetry = 0;  ///< Isym
    int planes = 1;    ///< Mc, of a full turn
    double plane_step_deg = 0, angle_step_deg = 0;  ///< Dc, Dg
    std::vector<double> plane_angles_deg;           ///< all Mc of them, whatever the symmetry
    std::string report, name, number, file, date;
    double length_mm = 0, width_mm = 0, height_mm = 0;
    double opening_length_mm = 0, opening_width_mm = 0;
    std::vector<double> opening_height_mm = std::vector<double>(4);  ///< at C0, C90, C180, C270
    double downward_percent = 100, output_ratio_percent = 100, factor = 1, tilt_deg = 0;
    std::vector<LampSet> lamp_sets;
    std::vector<double> direct_ratios = std::vector<double>(10);
};

/// A file's grid and header.
struct PhotometricFile {
    pbr::Photometry type = pbr::Photometry::type_c;
    std::vector<double> vertical_deg, horizontal_deg;
    std::vector<double> values;  ///< as filed; vertical runs fastest. cd before factors, or cd/klm
    std::variant<Lm63Header, EulumdatHeader> header;
    int values_line = 0;  ///< where they begin
    std::vector<Diagnostic> diagnostics;

    /// Either header, or null.
    const Lm63Header* lm63() const { return std::get_if<Lm63Header>(&header); }
    const EulumdatHeader* eulumdat() const { return std::get_if<EulumdatHeader>(&header); }
};

/// Reads either format, told apart by what the file holds. `file` names it in errors. Throws
/// Error(unreadable_input) "file:line: …".
PhotometricFile parse_photometry(std::span<const std::byte> bytes, std::string_view file);

/// Reads one format.
PhotometricFile parse_lm63(std::span<const std::byte> bytes, std::string_view file);
PhotometricFile parse_eulumdat(std::span<const std::byte> bytes, std::string_view file);

/// The table of a TILT=FILE.
TiltTable parse_tilt(std::span<const std::byte> bytes, std::string_view file);

/// The file as LM-63-2019, or as EULUMDAT: CRLF, UTF-8. What the other format has no field for goes into
/// keywords of the user's own (`_LDT_…`), and is taken from there again; what EULUMDAT has no place for is
/// named in `lost`. Throws Error(unwritable_output) for types A and B in EULUMDAT.
/// `lamp_set` (from 0) is EULUMDAT's that LM-63, which has one, is written for.
std::string write_lm63(const PhotometricFile& file, std::size_t lamp_set = 0);
std::string write_eulumdat(const PhotometricFile& file, std::vector<std::string>& lost);

}  // namespace pbrbake::parse
