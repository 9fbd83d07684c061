// Materials of other formats through the program: `texture --source`, jobs, glTF out, and what can go wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// An 8 x 8 TGA of one colour.
std::string targa(int red, int green, int blue) {
    std::string file(18, '\0');
    file[2] = 2;
    file[12] = file[14] = 8;
    file[16] = 24;
    file[17] = 0x20;
    for (int i = 0; i < 64; ++i)
        for (const int value : {blue, green, red}) file += static_cast<char>(value);
    return file;
}

Json read_json(const fs::path& file) { return job::parse_json(job::read_text(file), file.string()); }

void expect_valid(const fs::path& document, const char* schema_name) {
    const fs::path file = fs::path(PBRBAKE_SOURCE_DIR) / "schemas" / schema_name;
    const job::Schema schema(job::parse_json(job::read_text(file), file.string()));
    for (const Mistake& mistake : schema.mistakes(read_json(document)))
        ADD_FAILURE() << document << " " << mistake.pointer << ": " << mistake.message;
}

/// A folder with sources in it, and pbrbake texture over them.
class Scene {
  public:
    explicit Scene(const std::string& file, const std::string& text) : source_(folder_.write(file, text)) {}

    fs::path path(const std::string& name) const { return source_.parent_path() / name; }
    void add(const std::string& name, const std::string& bytes) const { folder_.write(name, bytes); }

    Outcome bake(const std::string& output, std::vector<std::string> flags = {}) const {
        std::vector<std::string> arguments{"texture", "--source", source_, "-o", path(output)};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        return run_program(arguments);
    }

    /// The material of a glTF file that was written.
    Json material(const std::string& file) const { return read_json(path(file))["materials"][0]; }

  private:
    TemporaryFolder folder_;
    fs::path source_;
};

const char* const kThree =
    "newmtl brick wall\nKd .8 .8 .8\nKs .1\nNs 10\nillum 2\nmap_Kd Brick.TGA\n"
    "newmtl gold\nKd 1 .766 .336\nPr .25\nPm 1\n"
    "newmtl veil\nKd .5 .25 .125\nillum 1\nd .5\nKe 2 1 0\n";

TEST(Materials, OfASceneAreBakedOneByOne) {
    const Scene scene("scene.mtl", kThree);
    scene.add("brick.tga", targa(180, 90, 60));
    const Outcome outcome = scene.bake("out.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("scene.mtl:6: material \"brick wall\": map_Kd: took"));

    const Json document = read_json(scene.path("out_brick_wall.gltf"));
    EXPECT_EQ(document["images"][0]["uri"], "out_brick_wall_base_color.png");
    for (const Json& image : document["images"])
        EXPECT_TRUE(fs::exists(scene.path(image["uri"].get<std::string>()))) << image;
    const Json brick = document["materials"][0];
    EXPECT_EQ(brick["name"], "brick wall");
    EXPECT_EQ(brick["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    EXPECT_FALSE(brick.contains("alphaMode") || brick.contains("occlusionTexture"));
    for (const char* name : {"out_brick_wall", "out_gold", "out_veil"}) {
        expect_valid(scene.path(std::string(name) + ".gltf.json"), "sidecar.schema.json");
        expect_valid(scene.path(std::string(name) + ".material.json"), "material.schema.json");
    }
}

TEST(Materials, WithoutPicturesAreFactors) {
    const Scene scene("scene.mtl", kThree);
    ASSERT_EQ(scene.bake("gold.gltf", {"--material", "gold"}).code, 0);
    EXPECT_FALSE(fs::exists(scene.path("gold_base_color.png")));
    const Json gold = scene.material("gold.gltf")["pbrMetallicRoughness"];
    const double base[] = {1, .766, .336};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(gold["baseColorFactor"][i].get<double>(), base[i], 1e-4);
    EXPECT_NEAR(gold["metallicFactor"].get<double>(), 1, 1e-3);
    EXPECT_NEAR(gold["roughnessFactor"].get<double>(), .25, 1e-6);
    EXPECT_LE(read_json(scene.path("gold.gltf.json"))["certificate"]["headline"]["value"].get<double>(),
              1e-4);

    ASSERT_EQ(scene.bake("veil.gltf", {"--material", "veil"}).code, 0);
    const Json veil = scene.material("veil.gltf");
    EXPECT_EQ(veil["alphaMode"], "BLEND");
    EXPECT_EQ(veil["pbrMetallicRoughness"]["baseColorFactor"][3], .5);
    EXPECT_NEAR(veil["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), .5, 1e-4);
    EXPECT_EQ(veil["emissiveFactor"], Json({1, .5, 0}));
    EXPECT_EQ(veil["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 2);
    EXPECT_EQ(veil["extensions"]["KHR_materials_specular"]["specularFactor"], 0);  // Lambert's
    EXPECT_THAT(read_json(scene.path("veil.gltf"))["extensionsUsed"].dump(),
                AllOf(HasSubstr("emissive_strength"), HasSubstr("KHR_materials_specular")));
}

TEST(Materials, SayTheirDielectricF0) {
    const auto extensions = [](const std::string& f0) {
        const Scene scene("m.json", R"({"materials": [{"name": "m", "diffuse_factor": [0.5, 0.5, 0.5],
            "surface": "dielectric", "specular_factor": )" +
                                        f0 + "}]}");
        const Outcome outcome = scene.bake("m.gltf");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return scene.material("m.gltf").value("extensions", Json::object());
    };
    EXPECT_TRUE(extensions("[0.04, 0.04, 0.04]").empty());
    const double root = std::sqrt(.08);
    EXPECT_NEAR(extensions("[0.08, 0.08, 0.08]")["KHR_materials_ior"]["ior"].get<double>(),
                (1 + root) / (1 - root), 1e-4);
    const Json coloured = extensions("[0.02, 0.04, 0.08]")["KHR_materials_specular"]["specularColorFactor"];
    EXPECT_NEAR(coloured[0].get<double>(), .5, 1e-4);
    EXPECT_NEAR(coloured[2].get<double>(), 2, 1e-4);
}

/// One bad number, and what is known of the others is still baked; the exit code is that of unreadable input.
TEST(Materials, ThatCannotBeReadFailAlone) {
    struct Case {
        const char *file, *text, *error;
    };
    const Case cases[] = {
        {"m.mtl",
         "newmtl good\nKd .5 .5 .5\nKs .1\nNs 10\nnewmtl bad\nKd .5 .5 .5\nNs x\nnewmtl other\nKd 0 .5 1\n",
         "m.mtl:7: material \"bad\": found 'x' as 'ns'"},
        {"m.gltf", R"({"asset": {"version": "2.0"}, "materials": [
            {"name": "good", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0.5, 0.5, 1]}}},
            {"name": "bad", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 2}}},
            {"name": "other", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 0.5, 1, 1]}}}]})",
         "glossinessFactor: material \"bad\": found '2'; allowed: a number from 0 to 1"},
        {"m.dae", R"(<COLLADA><library_effects>
<effect id="e"><profile_COMMON><technique><lambert><diffuse><color>0 .5 1 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="f"><profile_COMMON><technique><constant/></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="good"><instance_effect url="#e"/></material><material id="bad"><instance_effect url="#f"/></material>
<material id="other"><instance_effect url="#e"/></material></library_materials></COLLADA>)",
         "m.dae:3: material \"bad\": the effect 'f' has no lambert, phong or blinn"}};
    for (const Case& each : cases) {
        const Scene scene(each.file, each.text);
        const Outcome outcome = scene.bake("out.ktx2");
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_THAT(outcome.err, AllOf(HasSubstr(each.error), HasSubstr(each.file)));
        EXPECT_TRUE(fs::exists(scene.path("out_good.ktx2")) && fs::exists(scene.path("out_other.ktx2")))
            << each.file;
        EXPECT_FALSE(fs::exists(scene.path("out_bad.ktx2")));
        EXPECT_EQ(scene.bake("one.ktx2", {"--material", "other"}).code, 0);
        const Outcome bad = scene.bake("two.ktx2", {"--material", "bad"});
        EXPECT_EQ(bad.code, 4);
        EXPECT_THAT(bad.err, HasSubstr(each.error));
    }
    // A file that is broken as a whole fails as a whole.
    for (const auto& [file, text] :
         {std::pair{"m.dae", "<COLLADA><library"}, {"m.gltf", "{\"asset\""}, {"m.mtl", "Kd 1\n"}}) {
        const Scene scene(file, text);
        EXPECT_EQ(scene.bake("out.ktx2").code, 4);
        EXPECT_FALSE(fs::exists(scene.path("out.ktx2")));
    }
}

TEST(Materials, OfAJobAreNamedAfterItsBakeAndOverriddenByIt) {
    const Scene scene("scene.mtl", kThree);
    scene.add("brick.tga", targa(180, 90, 60));
    scene.add("job.json", R"({"version": 1, "output": "baked", "bakes": [
        {"kind": "texture", "name": "level", "source": "scene.mtl", "format": "gltf", "double_sided": true},
        {"kind": "texture", "name": "brick", "source": "scene.mtl", "material": "brick wall", "format": "ktx2"}]})");
    const Outcome outcome = run_program({"bake", scene.path("job.json")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json manifest = read_json(scene.path("baked/manifest.json"));
    std::vector<std::string> names;
    for (const Json& product : manifest["products"]) names.push_back(product["name"]);
    EXPECT_THAT(names, testing::ElementsAre("level_brick_wall", "level_gold", "level_veil", "brick"));
    EXPECT_EQ(scene.material("baked/level_gold.gltf")["doubleSided"], true);
    EXPECT_TRUE(fs::exists(scene.path("baked/brick.ktx2")));
    EXPECT_EQ(manifest["products"][0]["inputs"].size(), 2u);  // brick.tga and scene.mtl
}

TEST(Materials, OfANameAreItsPictures) {
    const Scene scene("crate_d.tga", targa(120, 100, 80));
    scene.add("crate_s.tga", targa(40, 40, 40));
    scene.add("crate_local.tga", targa(128, 128, 255));
    scene.add("crate_glow.tga", targa(255, 0, 0));
    const fs::path base = scene.path("crate"), product = scene.path("out.gltf");
    const Outcome outcome = run_program({"texture", "--source", base, "-o", product});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json material = scene.material("out.gltf");
    EXPECT_TRUE(material.contains("normalTexture") && material.contains("emissiveTexture"));
    EXPECT_EQ(material["emissiveFactor"], Json({1, 1, 1}));
    const Json record = read_json(scene.path("out.gltf.json"));
    EXPECT_EQ(record["params"]["power"], 16);
    EXPECT_EQ(record["params"]["source"], "crate");  // no path of this machine
    EXPECT_EQ(record["pixel"], "unorm8");
}

/// What a name's gloss map means may be stated alone; who says where gloss is says all of it.
TEST(Materials, GlossIsAloneSaysHowTheMapIsRead) {
    const Scene scene("crate_d.tga", targa(120, 100, 80));
    scene.add("crate_s.tga", targa(40, 40, 40));
    scene.add("crate_g.tga", targa(200, 200, 200));
    const fs::path base = scene.path("crate"), product = scene.path("out.exr");
    const auto gloss = [&](const std::vector<std::string>& stated) {
        std::vector<std::string> arguments{"texture", "--source", base, "-o", product};
        arguments.insert(arguments.end(), stated.begin(), stated.end());
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return read_json(scene.path("out.exr.json"))["set"]["gloss"];
    };
    EXPECT_EQ(gloss({"--gloss-is", "perceptual_roughness"}),
              Json({{"in", "gloss.r"}, {"is", "perceptual_roughness"}, {"reason", "stated by gloss_is"}}));
    EXPECT_EQ(gloss({"--power", "20"}), Json({{"in", "none"}, {"reason", "stated by power"}}));
}

TEST(Materials, OfMtlMayBeMetallicByTheTexel) {
    const Scene scene("m.mtl", "newmtl m\nKd 1 .5 .25\nmap_Kd d.tga\nmap_Pr r.tga\nmap_Pm p.tga");
    scene.add("d.tga", targa(255, 255, 255));
    scene.add("r.tga", targa(51, 51, 51));
    scene.add("p.tga", targa(255, 255, 255));
    const Outcome outcome = scene.bake("m.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json record = read_json(scene.path("m.gltf.json"));
    EXPECT_EQ(record["params"]["model"], "metallic_roughness");
    EXPECT_EQ(record["set"]["mean_metallic"], 1);
    EXPECT_EQ(record["set"]["gloss"]["in"], "gloss.r");
    EXPECT_EQ(record["set"]["gloss"]["is"], "perceptual_roughness");
}

TEST(Materials, LeaveHeightsOutAndSaySo) {
    const Scene scene("m.mtl", "newmtl m\nmap_Kd d.tga\nbump h.tga");
    scene.add("d.tga", targa(90, 80, 70));
    scene.add("h.tga", targa(90, 90, 90));
    const Outcome outcome = scene.bake("m.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("normal: is grey, so it holds heights"));
    EXPECT_FALSE(scene.material("m.gltf").contains("normalTexture"));
}

TEST(Materials, FailOneByOneAndSayWhere) {
    const Scene scene("scene.mtl", kThree);  // brick.tga is absent
    const Outcome outcome = scene.bake("out.gltf");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("scene.mtl:6: material \"brick wall\": map_Kd: there is no file"));
    EXPECT_TRUE(fs::exists(scene.path("out_gold.gltf")));
    EXPECT_FALSE(fs::exists(scene.path("out_brick_wall.gltf")));
    EXPECT_FALSE(fs::exists(scene.path("out_brick_wall_base_color.png")));
}

TEST(Materials, NameWhatIsWrong) {
    const auto refused = [](const std::string& file, const std::string& text,
                            std::vector<std::string> flags = {}) {
        const Scene scene(file, text);
        const Outcome outcome = scene.bake("out.gltf", std::move(flags));
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_FALSE(fs::exists(scene.path("out.gltf")));
        return outcome.err;
    };
    EXPECT_THAT(
        refused("s.mtl", kThree, {"--material", "glod"}),
        HasSubstr(
            "found no material 'glod'; allowed: \"brick wall\", \"gold\", \"veil\"; did you mean \"gold\"?"));
    EXPECT_THAT(refused("s.mtl", ""), HasSubstr("s.mtl"));
    EXPECT_THAT(refused("s.mtl", "newmtl a\nKd 1 inf 1"),
                HasSubstr("s.mtl:2: material \"a\": found 'inf' as 'kd'"));
    EXPECT_THAT(refused("s.mtl", "newmtl a\nmap_Kd ../../x.tga"), HasSubstr("leads out of the folder"));
    EXPECT_THAT(refused("s.json", R"({"materials": [{"name": "a", "diffues": "x"}]})"),
                HasSubstr("material \"a\": found \"diffues\", which is no field of a texture set"));
    EXPECT_THAT(refused("s.json", R"({"materials": [{"name": "a", "power": "x"}]})"),
                AllOf(HasSubstr("material \"a\": power: found \"x\""), HasSubstr("s.json")));
    EXPECT_THAT(refused("s.json", R"({"materials": [{"name": "a", "power": -1}]})"), HasSubstr("power"));
    EXPECT_THAT(refused("crates.fbx", "no picture"), HasSubstr("is a file of a kind that isn't read"));
    const Outcome nothing = run_program({"texture", "--source", "no/crates", "-o", "/tmp/none.gltf"});
    EXPECT_EQ(nothing.code, 4);
    EXPECT_THAT(nothing.err, HasSubstr("there is no no/crates_d.png or _s.png"));
    const Outcome absent = run_program({"texture", "--source", "none.mtl", "-o", "/tmp/none.gltf"});
    EXPECT_EQ(absent.code, 4);
    EXPECT_THAT(absent.err, HasSubstr("none.mtl"));
}

TEST(Materials, AreHeldAgainstTheFormat) {
    const Scene scene("s.mtl", "newmtl a\nKd .5");
    Outcome outcome = scene.bake("out.gltf", {"--packing", "unity"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--packing: found \"unity\"; allowed with format gltf: \"gltf\""));
    outcome = run_program({"texture", "--material", "a", "-o", scene.path("out.gltf")});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--material: needs the source"));
    EXPECT_EQ(scene.bake("out.png", {"--packing", "unity"}).code, 0);  // one texel
    outcome = scene.bake("out.gltf", {"--dry-run"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("out.gltf"), HasSubstr("out.material.json"), Not(HasSubstr("base_color"))));
}

/// RFC 4648's base64, written apart from the program's.
std::string base64(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    std::uint32_t held = 0;
    int bits = 0;
    for (const char byte : bytes) {
        held = held << 8 | static_cast<unsigned char>(byte);
        for (bits += 8; bits >= 6; bits -= 6) text += digits[held >> (bits - 6) & 63];
    }
    if (bits > 0) text += digits[held << (6 - bits) & 63];
    return text + std::string((4 - text.size() % 4) % 4, '=');
}

std::string little_endian(std::size_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> 8 * i & 255);
    return text;
}

/// A binary glTF of JSON and a buffer.
std::string glb(std::string json, std::string buffer) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    const std::string chunks = little_endian(json.size()) + "JSON" + json + little_endian(buffer.size()) +
                               std::string("BIN\0", 4) + buffer;
    return "glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks;
}

/// A specular-glossiness material over one image, and what else the document has.
std::string gltf_of(const std::string& image, const std::string& rest = "") {
    return R"({"asset": {"version": "2.0"}, "images": [{"name": "unused", "uri": "none.png"}, )" + image +
           R"(], "textures": [{"source": 1}], "materials": [{"name": "crate", "extensions": {
             "KHR_materials_pbrSpecularGlossiness": {"diffuseTexture": {"index": 0},
             "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.5}}}])" +
           rest + "}";
}

/// A PNG as the program writes it.
std::string png() {
    const TemporaryFolder folder;
    const fs::path source = folder.write("a.tga", targa(180, 90, 60)),
                   product = source.parent_path() / "a.png";
    EXPECT_EQ(run_program({"texture", "--diffuse", source, "--pixel", "unorm8", "-o", product}).code, 0);
    return job::read_text(product);
}

TEST(Materials, OfGltfMayEmbedTheirPictures) {
    const std::string picture = png(), size = std::to_string(picture.size()),
                      all = std::to_string(picture.size() + 5);
    const std::string view = R"({"mimeType": "image/png", "bufferView": 0})",
                      views = R"(, "bufferViews": [{"buffer": 0, "byteOffset": 5, "byteLength": )" + size +
                              R"(}], "buffers": [{"byteLength": )" + all;
    const auto colours = [&](const std::string& file, const std::string& bytes, const char* input) {
        const Scene scene(file, bytes);
        scene.add("p.png", picture);
        scene.add("p.bin", "12345" + picture);
        const Outcome outcome =
            scene.bake("out.gltf", {"--material", "crate", "--depfile", scene.path("out.d")});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const Json record = read_json(scene.path("out.gltf.json"));
        EXPECT_EQ(record["inputs"][0]["path"], input);
        EXPECT_EQ(record["params"]["diffuse"], input);
        const std::string depends = job::read_text(scene.path("out.d"));
        EXPECT_THAT(depends, HasSubstr(file));
        EXPECT_EQ(depends.find("p.bin") != depends.npos, bytes.find("p.bin") != bytes.npos);
        return record["inputs"][0]["xxh3"].get<std::string>() +
               job::read_text(scene.path("out_base_color.png"));
    };
    const std::string expected = colours("s.gltf", gltf_of(R"({"uri": "p.png"})"), "p.png");
    const std::string data = R"({"uri": "data:image/png;base64,)" + base64(picture) + R"("})";
    EXPECT_EQ(colours("s.gltf", gltf_of(data), "s.gltf#/images/1"), expected);
    EXPECT_EQ(colours("s.gltf", gltf_of(view, views + R"(, "uri": "p.bin"}])"), "s.gltf#/images/1"),
              expected);
    EXPECT_EQ(colours("s.glb", glb(gltf_of(view, views + "}]"), "12345" + picture), "s.glb#/images/1"),
              expected);
}

TEST(Materials, MayBeOverriddenByAPictureInside) {
    const Scene scene("s.gltf", gltf_of(R"({"uri": "data:image/png;base64,)" + base64(png()) + R"("})"));
    scene.add("job.json", R"({"version": 1, "output": "baked", "bakes": [
        {"kind": "texture", "name": "a", "diffuse": "s.gltf#/images/1", "format": "png"},
        {"kind": "texture", "name": "b", "diffuse": "s.gltf#/images/7", "format": "png"}]})");
    const Outcome outcome = run_program({"bake", scene.path("job.json")});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("s.gltf: has 2 images, and none of index 7"));
    EXPECT_TRUE(fs::exists(scene.path("baked/a.png")));
}

TEST(Materials, SayWhatIsWrongWithEmbeddedPictures) {
    const auto refused = [](const std::string& file, const std::string& bytes) {
        const Scene scene(file, bytes);
        const Outcome outcome = scene.bake("out.gltf");
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_FALSE(fs::exists(scene.path("out.gltf")));
        return outcome.err;
    };
    const std::string
        view = R"({"mimeType": "image/png", "bufferView": 0})",
        views = R"(, "bufferViews": [{"buffer": 0, "byteLength": 40}], "buffers": [{"byteLength": 40)";
    EXPECT_THAT(refused("s.gltf", gltf_of(R"({"uri": "data:image/png;base64,Zm9v#mFy"})")),
                HasSubstr("s.gltf#/images/1/uri: found '#' after 4 digits of base64"));
    EXPECT_THAT(refused("s.gltf", gltf_of(R"({"uri": "data:image/png;base64,Zm9vYmFy"})")),
                HasSubstr("s.gltf#/images/1: is none of the formats that are read"));
    EXPECT_THAT(refused("s.gltf", gltf_of(view, views + R"(, "uri": "none.bin"}])")),
                HasSubstr("none.bin: there is no such file"));
    EXPECT_THAT(refused("s.glb", glb(gltf_of(view, views + "}]"), "too short")),
                HasSubstr("s.glb#/buffers/0: claims 40 bytes, but has 12"));
    EXPECT_THAT(refused("s.glb", "glTF" + little_endian(2) + little_endian(99)),
                HasSubstr("claims 99 bytes in all"));
    EXPECT_THAT(refused("s.glb", "glTG"), HasSubstr("s.glb:1:1: not JSON"));
}

/// A document of three materials, two of them specular-glossiness, with what a conversion must keep.
std::string scene_gltf() {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 2}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "mesh data.bin"}],
      "samplers": [{"wrapS": 33071, "wrapT": 33071}],
      "images": [{"uri": "old.png"}, {"uri": "keep.png"}],
      "textures": [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 1, "sampler": 0}],
      "materials": [
        {"name": "paint", "extras": {"id": 7}, "normalTexture": {"index": 0, "texCoord": 1}, "extensions": {
          "KHR_materials_pbrSpecularGlossiness": {"diffuseTexture": {"index": 0}, "glossinessFactor": 0.25},
          "KHR_materials_unlit": {}}},
        {"name": "steel", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 0, 0, 1],
          "specularFactor": [0.5, 0.5, 0.5]}}},
        {"name": "kept", "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}, "metallicFactor": 0}}],
      "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit"],
      "extensionsRequired": ["KHR_materials_pbrSpecularGlossiness"]})";
}

TEST(MaterialsScene, KeepsAllButItsMaterials) {
    const Scene scene("s.gltf", scene_gltf());
    for (const char* name : {"old.png", "keep.png"}) scene.add(name, png());
    scene.add("mesh data.bin", std::string(36, '\0'));
    const Outcome outcome = scene.bake("out/new.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json document = read_json(scene.path("out/new.gltf")),
               before = job::parse_json(scene_gltf(), "", 64);
    for (const char* key :
         {"asset", "scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "samplers"})
        EXPECT_EQ(document[key], before[key]) << key;
    EXPECT_EQ(document["extensionsUsed"][0], "KHR_materials_unlit");
    EXPECT_FALSE(document.contains("extensionsRequired"));
    EXPECT_EQ(document["buffers"][0]["uri"], "new.bin");
    EXPECT_EQ(job::read_text(scene.path("out/new.bin")), std::string(36, '\0'));
    const Json paint = document["materials"][0], steel = document["materials"][1],
               kept = document["materials"][2];
    EXPECT_EQ(paint["extras"], Json({{"id", 7}}));
    EXPECT_EQ(paint["extensions"]["KHR_materials_unlit"], Json::object());
    EXPECT_FALSE(document.dump().find("SpecularGlossiness") != std::string::npos);
    EXPECT_EQ(paint["normalTexture"]["texCoord"], 1);
    EXPECT_GT(steel["pbrMetallicRoughness"]["metallicFactor"].get<double>(), .9);
    const auto file = [&](const Json& info) {
        const Json texture = document["textures"][info["index"].get<std::size_t>()];
        return document["images"][texture["source"].get<std::size_t>()]["uri"].get<std::string>();
    };
    EXPECT_EQ(file(paint["pbrMetallicRoughness"]["baseColorTexture"]), "new_paint_base_color.png");
    EXPECT_EQ(file(paint["normalTexture"]), "new_paint_normal.png");
    for (const Json& image : document["images"]) {
        EXPECT_NE(image["uri"], "old.png");
        EXPECT_TRUE(fs::exists(scene.path("out") / image["uri"].get<std::string>())) << image;
    }
    EXPECT_EQ(job::read_text(scene.path("out") / file(kept["pbrMetallicRoughness"]["baseColorTexture"])),
              job::read_text(scene.path("keep.png")));
    for (const Json& info : {paint["normalTexture"], kept["pbrMetallicRoughness"]["baseColorTexture"]})
        EXPECT_EQ(document["textures"][info["index"].get<std::size_t>()]["sampler"], 0);
    expect_valid(scene.path("out/new.gltf.json"), "sidecar.schema.json");
    EXPECT_TRUE(fs::exists(scene.path("out/new_steel.gltf")));
}

TEST(MaterialsScene, OfAJobStandsInItsManifest) {
    const Scene scene("s.gltf", scene_gltf());
    for (const char* name : {"old.png", "keep.png"}) scene.add(name, png());
    scene.add("mesh data.bin", std::string(36, '\0'));
    scene.add("job.json", R"({"version": 1, "output": "baked", "accuracy": {"max_error": 0.5}, "bakes": [
        {"kind": "texture", "name": "s", "source": "s.gltf", "format": "gltf"}]})");
    const Outcome outcome = run_program({"bake", scene.path("job.json")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json products = read_json(scene.path("baked/manifest.json"))["products"];
    ASSERT_EQ(products.size(), 3u);
    EXPECT_EQ(products[2]["name"], "s");
    EXPECT_EQ(products[2]["inputs"][1]["path"], "s_paint.material.json");
}

TEST(MaterialsScene, OfPicturesAloneHasNoBuffer) {
    const std::string picture = png(), size = std::to_string(picture.size());
    const Scene scene("s.glb", glb(gltf_of(R"({"mimeType": "image/png", "bufferView": 0})",
                                           R"(, "bufferViews": [{"buffer": 0, "byteLength": )" + size +
                                               R"(}], "buffers": [{"byteLength": )" + size + "}]"),
                                   picture));
    const Outcome outcome = scene.bake("out.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json document = read_json(scene.path("out.gltf"));
    for (const char* key : {"buffers", "bufferViews"}) EXPECT_FALSE(document.contains(key)) << key;
    EXPECT_FALSE(fs::exists(scene.path("out.bin")));
    for (const Json& image : document["images"]) EXPECT_FALSE(image.contains("bufferView"));
}

/// Three views of a buffer around a replaced picture of odd length and one that stays: floats, shorts that
/// overlap them, and more floats.
struct Embedded {
    std::string picture = png(), kept = png() + "x", floats = "abcdefghijkl", more = "mnopqrst";
    std::size_t picture_at = 12, kept_at = picture_at + picture.size(),
                more_at = (kept_at + kept.size() + 3) / 4 * 4;

    std::string buffer() const {
        std::string bytes = floats + picture + kept;
        bytes.resize(more_at, '.');
        return bytes + more;
    }

    std::string json(const std::string& rest, const std::string& uri = "") const {
        const auto view = [](std::size_t at, std::size_t size, const std::string& more_members = "") {
            return R"({"buffer": 0, "byteOffset": )" + std::to_string(at) + R"(, "byteLength": )" +
                   std::to_string(size) + more_members + "}";
        };
        const auto accessor = [](int of, int component, int count) {
            return R"({"bufferView": )" + std::to_string(of) + R"(, "componentType": )" +
                   std::to_string(component) + R"(, "type": "SCALAR", "count": )" + std::to_string(count) +
                   "}";
        };
        return R"({"asset": {"version": "2.0"}, "bufferViews": [)" + view(picture_at, picture.size()) + "," +
               view(0, 12) + "," + view(more_at, 8) + "," + view(kept_at, kept.size()) + "," + view(4, 8) +
               R"(], "buffers": [{"byteLength": )" + std::to_string(more_at + 8) + uri + R"(}],
          "accessors": [)" +
               accessor(1, 5126, 3) + "," + accessor(2, 5126, 2) + "," + accessor(4, 5123, 4) +
               R"(], "images": [{"bufferView": 0, "mimeType": "image/png"}, {"bufferView": 3, "mimeType": "image/png"}],
          "textures": [{"source": 0}, {"source": 1}], "materials": [
            {"name": "crate", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseTexture": {"index": 0}}}},
            {"name": "kept", "emissiveTexture": {"index": 1}}])" +
               rest + "}";
    }
};

TEST(MaterialsScene, LeavesOutWhatReplacedPicturesHeld) {
    const Embedded embedded;
    const std::string bytes = embedded.buffer(),
                      data = R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes) + "\"";
    for (const auto& [file, text] :
         {std::pair{"s.glb", glb(embedded.json(""), bytes)}, std::pair{"s.gltf", embedded.json("", data)},
          std::pair{"s.gltf", embedded.json("", R"(, "uri": "b.bin")")}}) {
        const Scene scene(file, text);
        scene.add("b.bin", bytes);
        const Outcome dry = scene.bake("out.gltf", {"--dry-run"});
        EXPECT_THAT(dry.out, HasSubstr("out.bin"));
        const Outcome outcome = scene.bake("out.gltf");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const Json document = read_json(scene.path("out.gltf"));
        const std::string left = job::read_text(scene.path("out.bin"));
        EXPECT_EQ(document["buffers"], Json::array({{{"byteLength", left.size()}, {"uri", "out.bin"}}}));
        EXPECT_LE(left.size(), bytes.size() - embedded.picture.size() + 8);
        EXPECT_EQ(left.find(embedded.picture.substr(8)), left.find(embedded.kept.substr(8)));
        ASSERT_EQ(document["bufferViews"].size(), 4u);
        const auto held = [&](const Json& user) {
            const Json view = document["bufferViews"][user["bufferView"].get<std::size_t>()];
            const std::size_t at = view.value("byteOffset", std::size_t{0});
            EXPECT_TRUE(at % 4 == 0 || !user.contains("componentType"));
            return left.substr(at, view["byteLength"].get<std::size_t>());
        };
        EXPECT_EQ(held(document["accessors"][0]), embedded.floats);
        EXPECT_EQ(held(document["accessors"][1]), embedded.more);
        EXPECT_EQ(held(document["accessors"][2]), embedded.floats.substr(4));
        EXPECT_EQ(held(document["images"][0]), embedded.kept);
    }
}

TEST(MaterialsScene, KeepsAllBytesThatAnExtensionMayMean) {
    const Embedded embedded;
    const Scene scene(
        "s.glb", glb(embedded.json(R"(, "extensions": {"EXT_structural_metadata": {}})"), embedded.buffer()));
    const Outcome outcome = scene.bake("out.gltf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(job::read_text(scene.path("out.bin")), embedded.buffer());
    EXPECT_EQ(read_json(scene.path("out.gltf"))["bufferViews"].size(), 5u);
}

TEST(MaterialsScene, RefusesViewsBeyondTheirBuffers) {
    const Embedded embedded;
    std::string json = embedded.json("", R"(, "uri": "b.bin")");
    const Scene scene("s.gltf", json);
    scene.add("b.bin", embedded.buffer().substr(0, embedded.more_at + 1));
    const Outcome outcome = scene.bake("out.gltf");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("bytes of the file \"b.bin\", which has"));
    const std::string claim = R"("byteLength": 12)";
    json.replace(json.find(claim), claim.size(), R"("byteLength": 99999)");
    scene.add("s.gltf", json);
    for (std::vector<std::string> flags : {std::vector<std::string>{}, {"--dry-run"}}) {
        const Outcome beyond = scene.bake("out.gltf", std::move(flags));
        EXPECT_EQ(beyond.code, 4);
        EXPECT_THAT(beyond.err,
                    HasSubstr("s.gltf#/bufferViews/1: found bytes 0 to 0 + 99999; its buffer has"));
        EXPECT_FALSE(fs::exists(scene.path("out.gltf")));
    }
}

TEST(MaterialsScene, NeverReplacesABufferOfItsSource) {
    const Embedded embedded;
    const Scene scene("s.gltf", embedded.json("", R"(, "uri": "out.bin")"));
    scene.add("out.bin", embedded.buffer());
    const Outcome outcome = scene.bake("out.gltf");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.err, HasSubstr("out.bin: is a source of this bake too"));
    EXPECT_EQ(job::read_text(scene.path("out.bin")), embedded.buffer());
    EXPECT_FALSE(fs::exists(scene.path("out.gltf")));
}

TEST(MaterialsScene, TellsBeforehandWhatItWillKeep) {
    const Scene scene("s.gltf", scene_gltf());
    for (const char* name : {"old.png", "keep.png"}) scene.add(name, png());
    scene.add("mesh data.bin", std::string(36, '\0'));
    const Outcome dry = scene.bake("out/new.gltf", {"--dry-run"});
    ASSERT_EQ(dry.code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("mesh data.bin"));
    ASSERT_EQ(scene.bake("out/new.gltf").code, 0);
    for (const auto& entry : fs::directory_iterator(scene.path("out")))
        EXPECT_THAT(dry.out, HasSubstr("writes  " + entry.path().string()));
}

TEST(MaterialsScene, WarnsOfCoordinatesThatItLosesAlone) {
    // paint's normal has TEXCOORD_1: its own document can't say so, the whole one can.
    const auto warned = [](const std::string& json, std::vector<std::string> flags) {
        const Scene scene("s.gltf", json);
        for (const char* name : {"old.png", "keep.png"}) scene.add(name, png());
        scene.add("mesh data.bin", std::string(36, '\0'));
        const Outcome outcome = scene.bake("out.gltf", std::move(flags));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err.find("texture coordinates") != outcome.err.npos;
    };
    EXPECT_FALSE(warned(scene_gltf(), {}));
    EXPECT_TRUE(warned(scene_gltf(), {"--material", "paint"}));
    std::string apart = scene_gltf();
    const std::string diffuse = R"("diffuseTexture": {"index": 0},)";
    apart.replace(apart.find(diffuse), diffuse.size(),
                  diffuse + R"("specularGlossinessTexture": {"index": 1, "texCoord": 1},)");
    EXPECT_TRUE(warned(apart, {}));
}

TEST(MaterialsScene, IsNotWrittenWithoutItsParts) {
    const Scene scene("s.gltf", scene_gltf());  // old.png is absent
    const Outcome outcome = scene.bake("out.gltf");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("out.gltf: isn't written, because \"out_paint\" failed"));
    EXPECT_FALSE(fs::exists(scene.path("out.gltf")));
    for (const char* name : {"old.png", "keep.png"}) scene.add(name, png());
    const Outcome again = scene.bake("out.gltf");
    EXPECT_EQ(again.code, 4);
    EXPECT_THAT(again.err, HasSubstr("s.gltf: names the file \"mesh data.bin\", which is not there"));
}

TEST(MaterialsRealFiles, Convert) {
    const char* data = std::getenv("PBRBAKE_SHARED_DATA");
    if (!data) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    const TemporaryFolder folder;
    const fs::path out = folder.write("x", "").parent_path();
    for (const char* file :
         {"assimp/box_spaces.mtl", "assimp/regr01.mtl", "assimp/regr_3429812.mtl", "assimp/BoxTextured.gltf",
          "obj_mtl/box-complex-material/box-complex-material.mtl",
          "obj_mtl/box-complex-material-alpha/box-complex-material-alpha.mtl",
          "obj_mtl/box-multiple-materials/box-multiple-materials.mtl",
          "obj_mtl/box-texture-options/box-texture-options.mtl"}) {
        SCOPED_TRACE(file);
        const fs::path source = fs::path(data) / "legacy" / file;
        const Outcome outcome =
            run_program({"texture", "--source", source, "-o", out / (source.stem().string() + ".gltf")});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    const auto factor = [&](const char* file, const char* name) {
        return read_json(out / file)["materials"][0]["pbrMetallicRoughness"][name].get<double>();
    };
    EXPECT_LT(factor("box-multiple-materials_Red.gltf", "metallicFactor"), .05);
    EXPECT_LT(factor("box_spaces_Floor.gltf", "metallicFactor"), .05);
    // Its pictures are another repository's: five clear errors.
    const Outcome spider = run_program(
        {"texture", "--source", fs::path(data) / "legacy/assimp/spider.mtl", "-o", out / "spider.gltf"});
    EXPECT_EQ(spider.code, 4);
    EXPECT_THAT(spider.err, HasSubstr("spider.mtl:10: material \"Skin\": map_Kd: there is no file"));
}

}  // namespace
}  // namespace pbrbake::test
