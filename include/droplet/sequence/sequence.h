// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/droplet.h"

namespace droplet {

/// What is kept from frame to frame.
enum class VolumeMode {
    Total,  ///< the volume of all droplets together, which share it as one reservoir (thesis 4.2.4); all of it is gone
            ///< in frames without liquid and back after them
    Track,  ///< the volume of every droplet, through merging and splitting
};

/// How frames become droplets.
struct SequenceOptions {
    DropletOptions droplet;  ///< of every frame; how much liquid: of the first, and of droplets that come from nowhere
    VolumeMode volume_mode = VolumeMode::Total;
    bool keep_vertices = true;  ///< move a mesh with its footprint, or keep its triangles far from where the rim
                                ///< changed, where that is possible; else triangulate every frame

    /// @throws Error InvalidArgument also with a fill_range, volumes of each droplet, or with VolumeMode::Total unless
    ///               fill.sharing is Total
    void validate() const;
};

/// Where a droplet of a frame comes from, and what it holds.
struct Ancestry {
    std::size_t id = 0;             ///< the same from frame to frame; never given twice
    std::vector<std::size_t> from;  ///< ids in the frame before of what became this droplet; empty where it is new
    double volume = 0.0;            ///< prescribed [m³]
};

/// What the next frame needs to know of how a frame was made.
struct FrameLineage;

/// One frame of a sequence.
struct Frame {
    Droplet droplet;                 ///< without meshes and surface where there is no liquid
    std::vector<Ancestry> droplets;  ///< one per droplet
    bool continues = false;  ///< the surface is that of the frame before, moved: vertex by vertex, same triangles
    std::optional<double> vertices_kept;  ///< share of the meshes' vertices that the frame before had, there or moved;
                                          ///< empty if there is no frame before, or no liquid in one of the two
    double volume_gained = 0.0;  ///< by droplets that come from nowhere; with VolumeMode::Total only after a frame
                                 ///< without liquid [m³]
    double volume_lost = 0.0;    ///< by droplets that went nowhere; with VolumeMode::Total only into such a frame [m³]
    std::shared_ptr<const FrameLineage> lineage;  ///< of firstFrame() and nextFrame(), for nextFrame()
};

/// The first frame: makeDroplet(), with one pressure for all if the total volume is to be kept.
/// @param outline  without loops: a frame without liquid
/// @throws Error as makeDroplet
Frame firstFrame(Outline outline, const SequenceOptions& options, const Progress& progress = {});

/// The next frame.
///
/// Droplets belong together where their footprints overlap by a quarter of the smaller one, or where each overlaps none
/// more than the other. What belongs together, directly or by way of others, is a group, whose volume is conserved. Of
/// a group that ends as one droplet, that has all of it. One that ends as several was one liquid at one pressure until
/// it broke, so they get what they held then: volumes in proportion to what one pressure would give them, by the linear
/// model on level flat ground, which is exact for that, in proportion elsewhere. Of the parts of the droplet that gave
/// the most, the one that covers most of its ground keeps its id. Overlap with nothing: a new droplet, filled as
/// droplet.solve.fill says, or a lost one.
///
/// Where every droplet goes on as one droplet with as many holes, meshes move along (mesh/follow.h), and droplets stand
/// in the order they had. Elsewhere, with the linear model and without grading, droplets keep their triangles far from
/// where their rims changed (mesh/patch.h), and the edge's length is that of the frames before, as long as that gives
/// half to twice the triangles asked for.
///
/// An outline without loops makes a frame without liquid: all droplets are lost, and those of the next are new. The
/// first droplets of all are filled as droplet.solve.fill says, whenever they come.
///
/// Guarantees: volumes are those of the frame before − lost + gained, and with VolumeMode::Total the same in every
/// frame with liquid, to 1e-9.
/// @param before   the frame before, as firstFrame() or nextFrame() made it, of a picture of the same extent
/// @throws Error   as makeDroplet; InvalidInput if the extent is another; InvalidArgument if `before` has no lineage
Frame nextFrame(const Frame& before, Outline outline, const SequenceOptions& options, const Progress& progress = {});

}  // namespace droplet
