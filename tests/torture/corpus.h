// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "droplet/mask/mask.h"

namespace droplet::torture {

/// Picture to make droplets of.
struct Item {
    std::string name;              ///< valid as a file name
    std::vector<std::byte> bytes;  ///< encoded picture; a greymap (P5) is read as with --channel luma
};

/// Bytes of a text.
inline std::vector<std::byte> bytesOf(const std::string& text)
{
    const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
}

struct Verdict;

/// Items that are generated one by one, reproducibly.
struct Corpus {
    std::string name;
    std::size_t count = 0;
    std::function<Item(std::size_t index)> item;
    std::function<Verdict(const Item&)> trial = {};  ///< replaces the usual trial for items that are not pictures
};

/// Item of a mask, as a 16-bit greymap.
Item greymapItem(const std::string& name, const Mask& mask);

/// Every glyph of DejaVu Sans, in alternating sizes, anti-aliased.
/// @throws std::runtime_error without the font
Corpus smoothGlyphs();

/// Every fourth glyph of DejaVu Sans, with hard edges.
/// @throws std::runtime_error without the font
Corpus hardGlyphs();

/// Every PNG of an icon theme of Debian's, elementary-xfce-icon-theme.
/// @throws std::runtime_error without it
Corpus icons();

/// Given files, and all files in given folders and subfolders, in order.
/// @throws std::runtime_error if there are none
Corpus files(const std::vector<std::filesystem::path>& paths);

/// White noise at every percent of density, hard and grey, in several sizes.
Corpus whiteNoise();

/// Coastlines, caves, mazes and dust from fixed seeds.
Corpus randomWorlds();

/// Deliberately awkward pictures: lines, combs, spirals, rings, dithers, plateaus, extreme sizes.
Corpus adversaries();

/// Every arrangement of liquid in a square of 3 × 3 cells of several pixels.
Corpus patterns();

/// Noise and shapes in every kind of PNG and in JPEG of low quality, read like users' pictures.
Corpus encodedNoise();

/// Short drawings that require huge work.
Corpus hostileDrawings();

/// SVG, meshes of every format and fonts, changed at random from fixed seeds.
Corpus brokenDrawings();
Corpus brokenMeshes();
Corpus brokenFonts();

/// 200 meshes over which droplets run for half a second: soups, strips, folds, needles, copies, numbers that are none.
/// All liquid must be accounted for, and no droplet may leave its face.
Corpus strayMeshes();

}  // namespace droplet::torture
