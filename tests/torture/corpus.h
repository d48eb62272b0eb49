// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "droplet/footprint/mask.h"

namespace droplet::torture {

/// A picture to make droplets of.
struct Item {
    std::string name;              ///< fit for a file's name
    std::vector<std::byte> bytes;  ///< of the encoded picture; a greymap (P5) stands as it is, like --channel luma
};

struct Verdict;

/// Items that are made one by one, the same whenever asked for.
struct Corpus {
    std::string name;
    std::size_t count = 0;
    std::function<Item(std::size_t index)> item;
    std::function<Verdict(const Item&)> trial = {};  ///< of items that are no pictures to make droplets of
};

/// A mask as an item, in a 16-bit greymap.
Item greymapItem(const std::string& name, const Mask& mask);

/// Every glyph of DejaVu Sans, in sizes that take turns, anti-aliased.
/// @throws std::runtime_error without the font
Corpus smoothGlyphs();

/// Every fourth glyph of DejaVu Sans, hard.
/// @throws std::runtime_error without the font
Corpus hardGlyphs();

/// Every PNG of an icon theme of Debian's, elementary-xfce-icon-theme.
/// @throws std::runtime_error without it
Corpus icons();

/// Files, and those in folders and below them, in order.
/// @throws std::runtime_error if there are none
Corpus files(const std::vector<std::filesystem::path>& paths);

/// White noise at every percent of density, hard and grey, in several sizes.
Corpus whiteNoise();

/// Coastlines, caves, mazes and dust from fixed seeds.
Corpus randomWorlds();

/// Pictures drawn to be as awkward as possible: lines, combs, spirals, rings, dithers, plateaus, extreme sizes.
Corpus adversaries();

/// Every arrangement of liquid in a square of 3 × 3 cells of several pixels.
Corpus patterns();

/// Noise and shapes in every kind of PNG, and JPEG at bad quality, read as a user's pictures are.
Corpus encodedNoise();

/// Drawings that ask for far more than they are long.
Corpus hostileDrawings();

/// SVG, meshes of every format and fonts, changed at random from fixed seeds.
Corpus brokenDrawings();
Corpus brokenMeshes();
Corpus brokenFonts();

}  // namespace droplet::torture
