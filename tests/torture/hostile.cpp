// SPDX-License-Identifier: GPL-3.0-or-later
// Broken or hostile drawings, meshes and fonts: each must be read or refused with a reason.
#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "droplet/compare/compare.h"
#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/io/object.h"
#include "droplet/io/output.h"
#include "droplet/io/read_surface.h"
#include "droplet/type/glyph.h"
#include "droplet/windshield/glass.h"
#include "support/command.h"
#include "support/fonts.h"
#include "support/hostile_drawings.h"
#include "support/masks.h"
#include "support/paths.h"
#include "torture/corpus.h"
#include "torture/random.h"
#include "torture/trial.h"

namespace droplet::torture {
namespace {

/// File to break, and the positions of its crucial numbers.
struct Seed {
    std::string name;
    std::string bytes;
    std::size_t head = 0;
};

std::string mutated(const Seed& seed, Random& random)
{
    static const std::array<std::string, 9> kWords{
        "1e9", "-1", "0", "1e-9", "4294967295", "99999", "nan", "\xff\xff\xff\xff", std::string(4, '\0')};
    std::string bytes = seed.bytes;
    const auto place = [&](std::size_t size) {
        const std::size_t within = random.below(2) == 0 && seed.head > 0 ? std::min(seed.head, size) : size;
        return static_cast<std::size_t>(random.real() * static_cast<double>(within));
    };
    for (int left = 1 + random.below(6); left > 0 && !bytes.empty(); --left) {
        const std::size_t at = place(bytes.size());
        const std::size_t count = std::min(bytes.size() - at, static_cast<std::size_t>(1 + random.below(64)));
        switch (random.below(6)) {
            case 0:
                bytes[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8));
                break;
            case 2: {
                const std::string& word = kWords[static_cast<std::size_t>(random.below(kWords.size()))];
                bytes.replace(at, std::min(word.size(), bytes.size() - at), word);
                break;
            }
            case 3:
                bytes.erase(at, count);
                break;
            case 4:
                bytes.insert(place(bytes.size()), bytes.substr(at, count));
                break;
            default:
                if (random.below(8) == 0) {
                    bytes.resize(at);
                }
        }
    }
    return bytes;
}

/// Changes a drawing: exchanges, repeats and nests elements, and makes numbers extreme.
std::string redrawn(const Seed& seed, Random& random)
{
    if (random.below(4) == 0) {
        return mutated(seed, random);
    }
    static const std::array<std::string, 10> kNumbers{"0",   "-1",   "1e9",  "1e-9",  "1e300",
                                                      "100", "2000", "1e39", "32768", "0.001"};
    std::string text = seed.bytes;
    const std::size_t root = text.find('>') + 1;
    for (int left = 1 + random.below(4); left > 0; --left) {
        const auto at = root + static_cast<std::size_t>(random.real() * static_cast<double>(text.size() - root));
        if (random.below(2) == 0) {
            const std::size_t number = text.find_first_of("0123456789", at);
            if (number != std::string::npos) {
                const std::size_t end = text.find_first_not_of("0123456789.", number);
                text.replace(number, std::min(end, text.size()) - number,
                             kNumbers[static_cast<std::size_t>(random.below(kNumbers.size()))]);
            }
            continue;
        }
        const std::size_t begin = text.find('<', at);
        const std::size_t end = begin == std::string::npos ? begin : text.find("/>", begin);
        if (end != std::string::npos) {
            const std::string element = text.substr(begin, end + 2 - begin);
            text.insert(begin, testing::repeated(1 << random.below(8), element));
        }
    }
    return text;
}

std::vector<Seed> drawingSeeds()
{
    const auto seed = [](const std::string& name, const std::string& content) {
        return Seed{name, testing::svgText(content)};
    };
    return {
        seed("shapes",
             "<g transform='rotate(10 5 5)' opacity='.7'><path d='M1 1C3 9 7 1 9 9A2 3 4 0 1 2 8z' stroke='red' "
             "stroke-width='.5' stroke-dasharray='1 .5'/><circle cx='5' cy='5' r='2'/><ellipse cx='2' cy='8' rx='1' "
             "ry='.5'/><polygon points='1,2 3,4 5,1'/></g>"),
        seed("text",
             "<text x='1' y='8' font-size='6' letter-spacing='1'>A<tspan dx='1' font-size='3'>b</tspan></text>"),
        seed("filter",
             "<filter id='f' x='0' y='0' width='1' height='1'><feGaussianBlur stdDeviation='.5 1'/><feOffset dx='1'/>"
             "<feTurbulence baseFrequency='.2' numOctaves='3'/><feMorphology radius='2'/><feTile/>"
             "<feDiffuseLighting surfaceScale='3'><fePointLight x='1' y='2' z='3'/></feDiffuseLighting></filter>"
             "<rect width='9' height='9' filter='url(#f)'/>"),
        seed("references",
             "<defs><pattern id='p' width='2' height='2' patternUnits='userSpaceOnUse'><circle r='1'/></pattern><mask "
             "id='m'><rect width='7' height='7' fill='white'/></mask><clipPath id='c'><circle cx='5' cy='5' r='4'/>"
             "</clipPath><marker id='k' markerWidth='3' markerHeight='3'><rect width='1' height='1'/></marker>"
             "<symbol id='s' viewBox='0 0 4 4'><rect width='3' height='3'/></symbol></defs><rect width='9' height='9' "
             "fill='url(#p)' mask='url(#m)' clip-path='url(#c)'/><path d='M1 1L5 5L9 1' marker-mid='url(#k)'/><use "
             "xlink:href='#s' x='2' y='2' width='5' height='5'/>"),
        seed("paint",
             "<style>.a{fill:url(#l);stroke:url(#r)}</style><linearGradient id='l' x2='1'><stop offset='0'/><stop "
             "offset='1' stop-color='red'/></linearGradient><radialGradient id='r' cx='.5' cy='.5' r='.5' fx='.3'>"
             "<stop offset='.5'/></radialGradient><rect class='a' width='9' height='9' rx='1' stroke-width='2'/>"),
    };
}

/// Reads a drawing as a small mask, within a short time limit.
Verdict tryDrawing(const Item& item)
{
    MaskOptions options;
    options.vector_long_side = 64;
    options.vector_seconds = 1.0;
    options.vector_memory = std::size_t{256} << 20;
    return tryReading([&] { decodeMask(item.bytes, options).validate(); });
}

std::vector<Seed> meshSeeds()
{
    DropletOptions options;
    options.mesh.triangles = 60;
    const Droplet droplet = makeDroplet(testing::hardMask(24, 24,
                                                          [](Vec2 p) {
                                                              return length(p - Vec2{12.0, 12.0}) < 9.0;
                                                          }),
                                        options);
    std::vector<Seed> seeds;
    for (const auto& [extension, format] : {std::pair{".glb", Format::Glb},
                                            {".gltf", Format::Gltf},
                                            {".obj", Format::Obj},
                                            {".ply", Format::Ply},
                                            {".stl", Format::Stl}}) {
        std::ostringstream out;
        writeSurface(droplet.surface, out, format);
        seeds.push_back({extension, out.str(), 2000});
    }
    seeds.push_back({".glb", testing::readFile(testing::inSource("data/can.glb")), 2000});
    return seeds;
}

/// Reads a mesh for `compare`, and as an object for `--onto` and `windshield --surface`.
Verdict tryMesh(const Item& item)
{
    const testing::ScratchDirectory scratch;
    const auto path = scratch.path() / item.name;
    testing::writeFile(path, {reinterpret_cast<const char*>(item.bytes.data()), item.bytes.size()});
    const auto as_surface = [&] {
        const Surface surface = readSurface(path).surface;
        surface.validate();
        CompareOptions options;
        options.max_pieces = std::size_t{1} << 14;  // a broken mesh can be far larger than its droplet
        compare(surface, surface, options);
    };
    const auto as_object = [&] {
        const TexturedMesh object = readObject(path);
        object.validate();
        const Glass glass(object, {});
    };
    Verdict verdict = tryReading(as_surface);
    const std::string extension = path.extension().string();
    if (verdict.outcome != Outcome::Failed && (extension == ".glb" || extension == ".gltf")) {
        const Verdict object = tryReading(as_object);
        verdict.seconds += object.seconds;
        if (object.outcome == Outcome::Failed || verdict.outcome == Outcome::Refused) {
            verdict.outcome = object.outcome;
            verdict.message = object.message;
        }
    }
    return verdict;
}

Verdict tryFont(const Item& item)
{
    return tryReading([&] {
        const Font font = decodeFont(item.bytes);
        for (GlyphId glyph = 0; glyph < std::min<std::size_t>(font.glyphCount(), 40); ++glyph) {
            static_cast<void>(font.nameOf(glyph));
            try {
                glyphOutline(font, glyph);
            } catch (const Error&) {
                // Only this glyph is broken.
            }
        }
        TextOptions along;
        along.path = {{0.0, 0.0}, {0.1, 0.0}, {0.1, -0.1}};
        along.line_sizes = {2.0, 1.0};
        layOutText(font, "fA\u0301V \u05d0\n&", along);
        layOutText(font, "fA\u0301V \u05d0\u0628\u0629 ffi\n&");
    });
}

using Break = std::string (*)(const Seed&, Random&);

Corpus broken(const std::string& name, std::vector<Seed> seeds, std::size_t count, Break change,
              std::function<Verdict(const Item&)> trial)
{
    return {name, count,
            [seeds = std::move(seeds), change](std::size_t index) {
                Random random(index);
                const Seed& seed = seeds[index % seeds.size()];
                return Item{std::to_string(index) + seed.name, bytesOf(change(seed, random))};
            },
            std::move(trial)};
}

}  // namespace

Corpus hostileDrawings()
{
    const std::vector<testing::HostileDrawing> drawings = testing::hostileDrawings();
    return {"hostile drawings", drawings.size(),
            [drawings](std::size_t index) {
                return Item{drawings[index].name + ".svg", bytesOf(drawings[index].text())};
            },
            tryDrawing};
}

Corpus brokenDrawings()
{
    return broken("broken drawings", drawingSeeds(), 3000, redrawn, tryDrawing);
}

Corpus brokenMeshes()
{
    return broken("broken meshes", meshSeeds(), 6000, mutated, tryMesh);
}

Corpus brokenFonts()
{
    std::vector<Seed> seeds;
    for (const char* path : {testing::kSans, testing::kSerif, testing::kVariable}) {
        seeds.push_back({".ttf", testing::readFile(path), 4096});
    }
    return broken("broken fonts", std::move(seeds), 6000, mutated, tryFont);
}

}  // namespace droplet::torture
