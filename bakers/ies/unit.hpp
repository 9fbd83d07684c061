#pragma once
// What a texture's 1.0 stands for, and names of documents.

#include <string>

#include "bakers/ies/params.hpp"
#include "pbr/light/photometric_web.hpp"

namespace pbrbake::ies {

/// Candela of a texture value of 1; 0 for a dark web.
double unit_candela(Normalise normalise, const pbr::PhotometricWeb& web);

/// "light.json", "gltf", "polar.svg", "sphere.svg", "html".
std::string document_suffix(DocumentKind kind);

}  // namespace pbrbake::ies
