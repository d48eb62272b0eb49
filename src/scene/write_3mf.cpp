// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF Consortium, "3MF Core Specification" (1.3); ECMA-376-2, "Open Packaging Conventions".
//
// All geometries are components of one object, as slicers show parts of one thing then, each with a colour, that move
// together; objects of their own would be put side by side on the plate.
#include "scene/write_3mf.h"

#include <fmt/core.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "axes.h"
#include "byte_stream.h"
#include "droplet/printable.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "droplet/zip.h"
#include "image/rgb.h"
#include "scene/welded_vertices.h"
#include "xml_text.h"

namespace droplet {
namespace {

constexpr int kSignificantDigits = 9;  // enough to distinguish any two floats

/// Text as an attribute's value. XML has no control characters but three.
std::string attribute(const std::string& text)
{
    return xmlText(printable(text), "&<\"");
}

/// `#RRGGBB` of a linear colour.
std::string colourText(Vec3 colour)
{
    const auto [red, green, blue] = levelsOf(colour);
    return fmt::format("#{:02X}{:02X}{:02X}", red, green, blue);
}

/// Geometry with its name.
struct Component {
    std::string name;
    const SceneGeometry& geometry;
};

std::vector<Component> componentsOf(const Scene& scene)
{
    std::vector<Component> components;
    for (const SceneMesh& mesh : scene.meshes) {
        for (const SceneGeometry& geometry : mesh.geometries) {
            const Look& look = scene.materials[geometry.parts.front().material].look;
            components.push_back({mesh.geometries.size() == 1 ? mesh.name : mesh.name + " " + look.name, geometry});
        }
    }
    return components;
}

void writeMesh(const SceneGeometry& geometry, ByteStream& bytes)
{
    const WeldedVertices welded = weldVertices(geometry.weld);
    bytes.text("<mesh><vertices>\n");
    for (const std::uint32_t v : welded.first) {
        const Float3& place = geometry.vertices[v];
        const Vec3 up = zUp({place[0], place[1], place[2]});
        const auto coordinate = [&](std::string_view name, double value) {
            bytes.text(name);
            bytes.digits(value / kMillimetre, std::chars_format::general, kSignificantDigits);
        };
        coordinate("<vertex x=\"", up.x);
        coordinate("\" y=\"", up.y);
        coordinate("\" z=\"", up.z);
        bytes.text("\"/>\n");
    }
    bytes.text("</vertices><triangles>\n");
    for (const ScenePart& part : geometry.parts) {
        for (const Triangle& t : part.triangles) {
            bytes.text("<triangle v1=\"");
            bytes.digits(welded.number[t[0]]);
            bytes.text("\" v2=\"");
            bytes.digits(welded.number[t[1]]);
            bytes.text("\" v3=\"");
            bytes.digits(welded.number[t[2]]);
            bytes.text("\"/>\n");
        }
    }
    bytes.text("</triangles></mesh>");
}

std::uint64_t writeModel(const Scene& scene, std::ostream& out)
{
    constexpr std::size_t kColours = 1;  // identifiers; every object has one more
    ByteStream bytes(out);
    bytes.text(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
        "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
        "<metadata name=\"Application\">droplet-shape " +
        std::string(kVersion) + "</metadata>\n<resources>\n");
    const std::vector<Component> components = componentsOf(scene);
    if (!scene.materials.empty()) {
        bytes.text(fmt::format("<basematerials id=\"{}\">\n", kColours));
        for (const SceneMaterial& material : scene.materials) {
            bytes.text("<base name=\"" + attribute(material.look.name) + "\" displaycolor=\"" +
                       colourText(material.look.colour) + "\"/>\n");
        }
        bytes.text("</basematerials>\n");
    }
    std::size_t id = kColours;
    for (const Component& component : components) {
        bytes.text(fmt::format("<object id=\"{}\" name=\"{}\" type=\"model\" pid=\"{}\" pindex=\"{}\">", ++id,
                               attribute(component.name), kColours, component.geometry.parts.front().material));
        writeMesh(component.geometry, bytes);
        bytes.text("</object>\n");
    }
    if (components.empty()) {
        bytes.text("</resources>\n<build/>\n</model>\n");
        return bytes.finish();
    }
    bytes.text(fmt::format("<object id=\"{}\" name=\"droplet\" type=\"model\"><components>\n", id + 1));
    for (std::size_t part = kColours + 1; part <= id; ++part) {
        bytes.text(fmt::format("<component objectid=\"{}\"/>\n", part));
    }
    bytes.text(fmt::format("</components></object>\n</resources>\n<build><item objectid=\"{}\"/></build>\n</model>\n",
                           id + 1));
    return bytes.finish();
}

}  // namespace

std::uint64_t write3mf(const Scene& scene, std::ostream& out)
{
    constexpr const char* kTypes =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
        "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
        "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>"
        "</Types>\n";
    constexpr const char* kRelations =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
        "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";
    const auto fixed = [](const char* text) {
        return [text](std::ostream& file) {
            ByteStream bytes(file);
            bytes.text(text);
            return bytes.finish();
        };
    };
    return writeZip({{"[Content_Types].xml", fixed(kTypes)},
                     {"_rels/.rels", fixed(kRelations)},
                     {"3D/3dmodel.model", [&](std::ostream& model) { return writeModel(scene, model); }}},
                    out, {.deflates = true, .kind = "3MF"});
}

}  // namespace droplet
