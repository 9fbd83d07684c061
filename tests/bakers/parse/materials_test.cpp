// Materials of MTL, glTF, COLLADA and plain JSON: what a file says, and what it must not.

#include "bakers/parse/materials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pbrbake::parse {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MaterialFile read(const std::string& text, const std::string& file) {
    return parse_materials(std::as_bytes(std::span(text)), file);
}

LegacyMaterial mtl(const std::string& lines) { return read("newmtl m\n" + lines, "m.mtl").materials.at(0); }

/// The error that a text gives, the whole or its first material that has one.
std::string refusal(const std::string& text, const std::string& file) {
    try {
        for (const LegacyMaterial& material : read(text, file).materials)
            if (material.error) throw Error(*material.error);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        return error.what();
    }
    ADD_FAILURE() << "was read: " << text;
    return "";
}

std::string codes(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += diagnostic.code + " ";
    return text;
}

TEST(Mtl, ReadsFactorsAndMaps) {
    const LegacyMaterial m =
        mtl("Ka 1 1 1\nKd .1 .2 .3\nks 0.5\nKe 0 .5 0\nNs 96.078431\nillum 2\n"
            "map_Kd a.png\nMAP_KS textures\\with blanks.png\nmap_Ns n.png\nmap_d o.png\nmap_Ke e.jpg\nnorm "
            "normal.png\n");
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.lobe, MaterialLobe::blinn_phong);
    EXPECT_EQ(m.diffuse_factor, glm::dvec3(.1, .2, .3));
    EXPECT_EQ(m.specular_factor, glm::dvec3(.5));
    EXPECT_EQ(m.emissive_factor, glm::dvec3(0, .5, 0));
    EXPECT_EQ(m.exponent, 96.078431);
    EXPECT_EQ(m.diffuse.path, "a.png");
    EXPECT_EQ(m.diffuse.line, 8);
    EXPECT_EQ(m.specular.path, "textures/with blanks.png");
    EXPECT_EQ(m.gloss.path, "n.png");
    EXPECT_EQ(m.opacity.path, "o.png");
    EXPECT_EQ(m.emissive.path, "e.jpg");
    EXPECT_EQ(m.normal.path, "normal.png");
    EXPECT_EQ(m.alpha, AlphaMode::blend);
    EXPECT_TRUE(m.diagnostics.empty());
}

TEST(Mtl, KeepsWhatIsNotSaidApartFromZero) {
    const LegacyMaterial m = mtl("");
    EXPECT_FALSE(m.specular_factor || m.exponent || m.emissive_factor);
    EXPECT_EQ(mtl("Ks 0 0 0\nNs 0").specular_factor, glm::dvec3(0));
}

TEST(Mtl, ReadsMapOptions) {
    const LegacyMaterial m =
        mtl("map_Kd -s 2 3 1 -o .25 .5 -clamp on a b.png\nmap_bump -bm -0.2 -imfchan l bump.png\n"
            "map_Ks -odd.png\nmap_Ns -s 1 1 1 -o 0 0 0 n.png");
    EXPECT_EQ(m.diffuse.path, "a b.png");
    // u = 2 u + .25; of v up: 3 v + .5, so of v down 1 - (3 (1 - v) + .5) = 3 v - 2.5
    EXPECT_EQ(m.diffuse.transform, (UvTransform{{.25, -2.5}, {2, 3}, 0}));
    EXPECT_EQ(m.gloss.transform, UvTransform{});
    EXPECT_TRUE(m.is_clamped);
    EXPECT_EQ(m.normal_scale, -.2);
    EXPECT_EQ(m.normal.path, "bump.png");
    EXPECT_EQ(m.specular.path, "-odd.png");
    EXPECT_EQ(codes(m.diagnostics), "texture_option ");
}

TEST(Mtl, PrefersNormalsToBumps) {
    EXPECT_EQ(mtl("norm n.png\nbump b.png").normal.path, "n.png");
    EXPECT_EQ(mtl("bump b.png\nnorm n.png").normal.path, "n.png");
}

TEST(Mtl, ReadsOpacityEitherWayRound) {
    EXPECT_EQ(mtl("d .25").opacity_factor, .25);
    EXPECT_EQ(mtl("Tr .25").opacity_factor, .75);
    EXPECT_EQ(mtl("d -halo .25").opacity_factor, .25);
    EXPECT_EQ(codes(mtl("d .9\nTr .1").diagnostics), "");
    const LegacyMaterial both = mtl("d 1\nTr 1");  // 3ds Max's Tr is d
    EXPECT_EQ(both.opacity_factor, 1);
    EXPECT_EQ(codes(both.diagnostics), "transparency ");
    EXPECT_EQ(mtl("Tr 1\nd 1").opacity_factor, 1);
}

TEST(Mtl, ReadsIlluminationModels) {
    EXPECT_EQ(mtl("illum 1\nKs 1").lobe, MaterialLobe::none);
    EXPECT_EQ(codes(mtl("illum 0").diagnostics), "unlit ");
    EXPECT_EQ(codes(mtl("illum 7").diagnostics), "glass ");
    EXPECT_EQ(mtl("illum 3").lobe, MaterialLobe::blinn_phong);
}

TEST(Mtl, ReadsThePbrExtension) {
    const LegacyMaterial m = mtl("Kd 1 .7 .3\nPr .3\nPm 1\nillum 1");
    EXPECT_EQ(m.lobe, MaterialLobe::metallic);
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.perceptual_roughness, .3);
    EXPECT_EQ(mtl("map_Pr r.png").roughness_map.path, "r.png");
    EXPECT_EQ(mtl("map_Pm m.png").lobe, MaterialLobe::metallic);
}

TEST(Mtl, JoinsLinesAndTakesTheFirstOfANameTwice) {
    const MaterialFile file = read("newmtl a\r\nKd 1 0 \\\r\n 0\r\nnewmtl b\nnewmtl a\nKd 0", "m.mtl");
    ASSERT_EQ(file.materials.size(), 2u);
    EXPECT_EQ(file.materials[0].diffuse_factor, glm::dvec3(1, 0, 0));
    EXPECT_EQ(codes(file.diagnostics), "twice ");
}

TEST(Mtl, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(refusal("newmtl a\nKd 1 x 1", "m.mtl"), HasSubstr("m.mtl:2: found 'x' as 'kd'"));
    for (const char* line : {"Kd nan", "Ks inf", "Ns -1", "Ns 1e9", "Kd 1 1", "d 2", "Tr -1", "Pr 2",
                             "illum many", "map_Kd", "map_Kd -s 1 1 1", "map_Kd -bm", "Ns"})
        EXPECT_THAT(refusal(std::string("newmtl a\n") + line, "m.mtl"), HasSubstr("m.mtl:2: ")) << line;
    EXPECT_THAT(refusal("Kd 1", "m.mtl"), HasSubstr("before the first newmtl"));
    EXPECT_THAT(refusal("newmtl \n", "m.mtl"), HasSubstr("m.mtl:1: found newmtl without a name"));
    EXPECT_THAT(refusal("# nothing\n", "m.mtl"), HasSubstr("m.mtl: holds no materials"));
    EXPECT_THAT(refusal("", "m.mtl"), HasSubstr("m.mtl"));
}

const char* const kGltf = R"({"asset": {"version": "2.0"},
  "images": [{"uri": "a%20b.png"}, {"uri": "data:image/png;base64,AAAA"}, {"bufferView": 0}],
  "samplers": [{"wrapS": 33071}],
  "textures": [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 2}],
  "materials": [{"name": "m", "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true,
    "normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0, "strength": 0.25},
    "emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 0},
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4},
      "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.25, 0.125, 0.75], "specularFactor": [0.1, 0.2, 0.3], "glossinessFactor": 0.6,
        "diffuseTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 2]}}}}}}]})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(GltfMaterials, ReadSpecularGlossiness) {
    const LegacyMaterial m = read(kGltf, "m.gltf").materials.at(0);
    EXPECT_EQ(m.lobe, MaterialLobe::specular_gloss);
    EXPECT_EQ(m.diffuse_factor, glm::dvec3(.5, .25, .125));
    EXPECT_EQ(m.specular_factor, glm::dvec3(.1, .2, .3));
    EXPECT_EQ(m.glossiness, .6);
    EXPECT_EQ(m.opacity_factor, .75);
    EXPECT_EQ(m.alpha, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, .3);
    EXPECT_EQ(m.emissive_factor, glm::dvec3(4, 2, 0));
    EXPECT_EQ(m.normal_scale, .5);
    EXPECT_EQ(m.occlusion_strength, .25);
    EXPECT_TRUE(m.double_sided && m.is_clamped);
    for (const MaterialMap* map : {&m.diffuse, &m.normal, &m.occlusion, &m.emissive})
        EXPECT_EQ(map->path, "a b.png");
    EXPECT_EQ(m.diffuse.transform, (UvTransform{{.5, 0}, {2, 2}, 0}));
}

TEST(GltfMaterials, PointAtPicturesTheyEmbed) {
    for (const char* index : {"1", "2"}) {
        const std::string text = replaced(kGltf, "\"diffuseTexture\": {\"index\": 0",
                                          std::string("\"diffuseTexture\": {\"index\": ") + index);
        const MaterialMap diffuse = read(text, "m.gltf").materials.at(0).diffuse;
        EXPECT_TRUE(diffuse.is_embedded);
        EXPECT_EQ(diffuse.path, std::string("#/images/") + index);
    }
}

TEST(GltfMaterials, RefuseWhatIsAbsentOrOutOfRange) {
    const auto with = [](const char* from, const char* to) {
        return refusal(replaced(kGltf, from, to), "m.gltf");
    };
    EXPECT_THAT(with("\"diffuseTexture\": {\"index\": 0", "\"diffuseTexture\": {\"index\": 7"),
                HasSubstr("diffuseTexture/index: found '7'"));
    EXPECT_THAT(with("\"source\": 0", "\"source\": 9"), HasSubstr("m.gltf#/textures/0/source"));
    EXPECT_THAT(with("{\"uri\": \"a%20b.png\"}", "{}"), HasSubstr("m.gltf#/images/0/uri: found nothing"));
    EXPECT_THAT(with("0.25, 0.125", "2, 0.125"), HasSubstr("diffuseFactor"));
    EXPECT_THAT(with("\"glossinessFactor\": 0.6", "\"glossinessFactor\": \"x\""),
                HasSubstr("glossinessFactor"));
    EXPECT_THAT(with("\"MASK\"", "\"GLASS\""),
                HasSubstr("alphaMode: found '\"GLASS\"'; allowed: \"OPAQUE\""));
    EXPECT_THAT(with("\"emissiveStrength\": 4", "\"emissiveStrength\": -4"), HasSubstr("emissiveStrength"));
    EXPECT_THAT(refusal(R"({"asset": {}, "materials": [{"name": "steel"}]})", "m.gltf"),
                HasSubstr("they are metallic already"));
    EXPECT_THAT(refusal(R"({"asset": {}})", "m.gltf"), HasSubstr("holds no materials"));
    EXPECT_THAT(refusal("{}", "m.json"), HasSubstr("JSON without \"asset\" (glTF) or \"materials\""));
    EXPECT_THAT(refusal("{", "m.gltf"), HasSubstr("m.gltf"));
}

const char* const kCollada = R"(<?xml version="1.0"?>
<COLLADA version="1.4.1">
<library_images><image id="img"><init_from>brick%20wall.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
<technique sid="common"><phong>
<emission><color>0 0 .5 1</color></emission>
<diffuse><texture texture="samp" texcoord="UV"/></diffuse>
<specular><color>.4 .4 .4 1</color></specular>
<shininess><float>50</float></shininess>
<transparent opaque="A_ONE"><color>1 1 1 .5</color></transparent>
<transparency><float>.5</float></transparency>
</phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="wall-id" name="wall"><instance_effect url="#e"/></material></library_materials>
</COLLADA>)";

TEST(ColladaMaterials, ReadTheCommonProfile) {
    const LegacyMaterial m = read(kCollada, "m.dae").materials.at(0);
    EXPECT_EQ(m.name, "wall");
    EXPECT_EQ(m.id, "wall-id");
    EXPECT_EQ(m.lobe, MaterialLobe::phong);
    EXPECT_EQ(m.diffuse.path, "brick wall.png");
    EXPECT_EQ(m.specular_factor, glm::dvec3(.4));
    EXPECT_EQ(m.exponent, 50);
    EXPECT_EQ(m.emissive_factor, glm::dvec3(0, 0, .5));
    EXPECT_EQ(m.opacity_factor, .25);
    EXPECT_EQ(m.alpha, AlphaMode::blend);
    const auto lobe = [](const char* name) {
        const std::string open = std::string("<") + name + ">", close = std::string("</") + name + ">";
        return read(replaced(replaced(kCollada, "<phong>", open), "</phong>", close), "m.dae")
            .materials.at(0)
            .lobe;
    };
    EXPECT_EQ(lobe("blinn"), MaterialLobe::blinn_phong);
    EXPECT_EQ(lobe("lambert"), MaterialLobe::none);
}

TEST(ColladaMaterials, TurnRgbZeroRound) {
    const std::string text = replaced(replaced(kCollada, "A_ONE", "RGB_ZERO"), "<color>1 1 1 .5</color>",
                                      "<color>.5 .5 .5 1</color>");
    EXPECT_EQ(read(text, "m.dae").materials.at(0).opacity_factor, .75);
}

TEST(ColladaMaterials, RefuseWhatIsAbsentOrWrong) {
    const auto with = [](const char* from, const char* to) {
        return refusal(replaced(kCollada, from, to), "m.dae");
    };
    EXPECT_THAT(with("url=\"#e\"", "url=\"#x\""), HasSubstr("m.dae:15: names the effect 'x'"));
    EXPECT_THAT(with("<source>surf", "<source>none"), HasSubstr("m.dae:9: names the image"));
    EXPECT_THAT(with(">50<", ">nan<"), HasSubstr("m.dae:11: found 'nan' in <float>"));
    EXPECT_THAT(with(">.4 .4 .4 1<", ">.4 .4<"), HasSubstr("m.dae:10: found 2 numbers in <color>"));
    EXPECT_THAT(with("</phong>", "</fong>"), HasSubstr("is no XML"));
    EXPECT_THAT(refusal("<a/>", "m.dae"), HasSubstr("found the element 'a'; allowed: COLLADA"));
    EXPECT_THAT(refusal("<COLLADA/>", "m.dae"), HasSubstr("holds no materials"));
    // A sampler that leads to itself leads to no image.
    EXPECT_THAT(with("<source>surf", "<source>samp"), HasSubstr("names the image 'samp'"));
}

TEST(PlainMaterials, HoldFieldsOfASet) {
    const MaterialFile file = read(
        R"({"materials": [{"name": "a", "diffuse": "x\\a.png", "power": 20}, {"name": "b", "surface": "metal"}]})",
        "m.json");
    ASSERT_EQ(file.materials.size(), 2u);
    EXPECT_EQ(file.materials[0].diffuse.path, "x/a.png");
    EXPECT_EQ(file.materials[0].fields, Json({{"power", 20}}));
    EXPECT_EQ(file.materials[1].fields, Json({{"surface", "metal"}}));
    EXPECT_THAT(refusal(R"({"materials": [{"diffuse": "a.png"}]})", "m.json"),
                HasSubstr("m.json#/materials/0/name"));
    EXPECT_THAT(refusal(R"({"materials": [3]})", "m.json"), HasSubstr("m.json#/materials/0"));
    EXPECT_THAT(refusal(R"({"materials": []})", "m.json"), HasSubstr("holds no materials"));
}

/// Three of each format, the second with a mistake: the others are as they would be without it.
TEST(Materials, FailAlone) {
    struct Case {
        const char *file, *text, *wrong, *right, *error;
    };
    const Case cases[] = {
        {"m.mtl", "newmtl a\nKd .25 .5 1\nnewmtl b\nNs @\nKd x\nNs 3\nnewmtl c\nKd .25 .5 1\n", "many", "3",
         "m.mtl:4: found 'many' as 'ns'"},
        {"m.gltf", R"({"asset": {}, "materials": [
            {"name": "a", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.25, 0.5, 1, 1]}}},
            {"name": "b", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": @}}},
            {"name": "c", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.25, 0.5, 1, 1]}}}]})",
         "2", "1",
         "m.gltf#/materials/1/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor: found '2'"},
        {"m.dae", R"(<COLLADA><library_effects>
<effect id="e"><profile_COMMON><technique><lambert><diffuse><color>.25 .5 1 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="f"><profile_COMMON><technique><@/></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="a"><instance_effect url="#e"/></material><material id="b"><instance_effect url="#f"/></material>
<material id="c"><instance_effect url="#e"/></material></library_materials></COLLADA>)",
         "constant", "lambert", "m.dae:3: the effect 'f' has no lambert, phong or blinn"},
        {"m.json",
         R"({"materials": [{"name": "a", "diffuse_factor": 1}, {"name": "b", "diffuse": @}, {"name": "c"}]})",
         "5", "\"d.png\"", "m.json#/materials/1/diffuse: found '5'; allowed: a text"}};
    for (const Case& each : cases) {
        const MaterialFile broken = read(replaced(each.text, "@", each.wrong), each.file);
        ASSERT_EQ(broken.materials.size(), 3u) << each.file;
        EXPECT_EQ(broken.materials[1].name, "b");
        ASSERT_TRUE(broken.materials[1].error) << each.file;
        EXPECT_THAT(broken.materials[1].error->what(), HasSubstr(each.error));
        const MaterialFile whole = read(replaced(each.text, "@", each.right), each.file);
        for (const std::size_t i : {0u, 2u}) {
            const LegacyMaterial &a = broken.materials[i], &b = whole.materials[i];
            EXPECT_FALSE(a.error) << each.file;
            EXPECT_EQ(a.name, i == 0 ? "a" : "c");
            EXPECT_EQ(a.diffuse_factor, b.diffuse_factor);
            EXPECT_EQ(a.fields, b.fields);
        }
        if (each.file != std::string("m.json")) {
            EXPECT_EQ(broken.materials[2].diffuse_factor, glm::dvec3(.25, .5, 1)) << each.file;
        }
    }
}

TEST(Materials, AreFoundByNameOrIdOrListed) {
    const MaterialFile file = read(kCollada, "m.dae");
    EXPECT_EQ(find_material(file, "wall-id", "m.dae").name, "wall");
    try {
        find_material(file, "wal", "m.dae");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("found no material 'wal'; allowed: \"wall\"; did you mean \"wall\"?"));
    }
}

TEST(Materials, LeadOnlyIntoTheirOwnFolder) {
    for (const char* path : {"a.png", "maps/a b.png", "./a.png", "..a.png", "a..png"})
        EXPECT_FALSE(path_refusal(path)) << path;
    for (const char* path : {"", "../a.png", "maps/../../a.png", "/etc/passwd", "C:/a.png", "file:///a.png",
                             "http://x/a.png", "data:image/png;base64,AA", "a\nb.png", ".."})
        EXPECT_TRUE(path_refusal(path)) << path;
}

TEST(Materials, KnowTheirExtensions) {
    for (const char* file : {"a.mtl", "a.MTL", "x/a.gltf", "a.glb", "a.dae", "a.b.json"})
        EXPECT_TRUE(has_material_extension(file)) << file;
    for (const char* file : {"", "a", "mtl", "a.png", "a.mtl/b", "a.mtlx"})
        EXPECT_FALSE(has_material_extension(file)) << file;
    EXPECT_EQ(path_of_uri("a%20b%2fc%zz\\d"), "a b/c%zz/d");
}

}  // namespace
}  // namespace pbrbake::parse
