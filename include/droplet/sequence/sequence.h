// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/droplet.h"

namespace droplet {

/// Volume that is conserved from frame to frame.
enum class VolumeMode {
    Total,  ///< total volume of all droplets, which share it as one reservoir (thesis 4.2.4); it is 0 in frames without
            ///< liquid and restored after them
    Track,  ///< volume of each droplet, through merging and splitting
    Fill,   ///< none: the fill applies to every frame, so that liquid grows and shrinks with its footprint
};

/// Options of a sequence.
struct SequenceOptions {
    DropletOptions droplet;  ///< options of every frame; the fill is that of new droplets, or of all
    VolumeMode volume_mode = VolumeMode::Total;  ///< volume that is conserved
    bool keep_vertices = true;  ///< move each mesh with its footprint, or keep triangles far from changes of the rim,
                                ///< where possible; if false, triangulate every frame
    bool hold = false;  ///< show the droplets of the frame before where a frame has none that is stable, instead
                        ///< of throwing NoSuchDroplet; the first droplets of a sequence must exist

    /// @throws Error InvalidArgument if a value is out of its range, with a fill_range, with quads, with volumes of
    ///               each droplet, or with VolumeMode::Total unless fill.sharing is Total
    void validate() const;
};

/// Origin of a droplet and its prescribed volume.
struct Ancestry {
    std::size_t id = 0;             ///< the same in all frames; never reused
    std::vector<std::size_t> from;  ///< ids of droplets of the frame before that became this one; empty if it is new
    double volume = 0.0;            ///< prescribed volume [m³]
};

/// Drop that fell off a droplet under a ceiling.
struct FallingDrop {
    std::size_t droplet = 0;  ///< id of the droplet that it left
    double volume = 0.0;      ///< [m³]
    Vec3 start;               ///< middle when it left [m]
    double since = 0.0;       ///< time since then [s]
    double gravity = 0.0;     ///< away from the ceiling [m/s²]

    /// Its middle [m].
    [[nodiscard]] Vec3 place() const { return {start.x, start.y, start.z + 0.5 * gravity * since * since}; }
};

/// Data about a frame that nextFrame() needs.
struct FrameLineage;

/// Frame of a sequence.
struct Frame {
    Droplet droplet;                 ///< the droplets; without meshes and surface if the frame has no liquid
    std::vector<Ancestry> droplets;  ///< one per droplet
    bool continues = false;          ///< the surface has the triangles of the frame before; only its vertices moved
    std::optional<double> vertices_kept;  ///< share of the vertices of meshes and sheets that the frame before had, in
                                          ///< place or moved; empty if there is none, or one of the two is dry
    double volume_gained = 0.0;  ///< volume of new droplets [m³]; with VolumeMode::Total only after a dry frame; with
                                 ///< VolumeMode::Fill how much the total volume grew
    double volume_lost = 0.0;  ///< volume of lost droplets [m³]; with VolumeMode::Total only before a dry frame; with
                               ///< VolumeMode::Fill how much the total volume shrank
    std::string held = {};  ///< with SequenceOptions::hold: why the frame has no droplets of its own and shows those of
                            ///< the frame before; empty if it has
    std::vector<FallingDrop> falling = {};  ///< drops on their way, with nextDripping(): in the surface, not in figures
    std::size_t drops_shed = 0;             ///< number of drops that fell so far
    std::shared_ptr<const FrameLineage> lineage;  ///< set by firstFrame() and nextFrame(), read by nextFrame()
};

/// Makes the first frame: as makeDroplet(), with one pressure for all droplets if the total volume is conserved.
/// @param outline   rims; none for a frame without liquid
/// @param options   options of the sequence
/// @param progress  called at every stage; may be empty
/// @throws Error    as makeDroplet
Frame firstFrame(Outline outline, const SequenceOptions& options, const Progress& progress = {});

/// Makes the next frame.
///
/// Two droplets belong together if their footprints overlap by a quarter of the smaller one, or if each of the two
/// overlaps no other droplet more. Droplets that belong together, directly or through others, form a group, and the
/// volume of a group is conserved. If a group ends as one droplet, that droplet gets all of it. If it ends as several,
/// they were one liquid at one pressure until it broke. So they get volumes in proportion to what one common pressure
/// would give them by the linear model on level flat ground; there this is exact. Of the parts of the droplet that gave
/// the most volume, the one that covers most of its ground keeps its id. A droplet that overlaps nothing is new, filled
/// by droplet.solve.fill, or lost.
///
/// If every droplet continues as one droplet with the same number of holes, meshes move along (mesh/follow.h) and
/// droplets keep their order. Sheets follow their rims (shape/sheet.h); if one of them cannot, the surface does not
/// continue. Else, with the linear model and without grading, droplets keep their triangles far from changes of their
/// rims (mesh/patch.h). The length of an edge then stays the same as long as it gives half to twice the requested
/// number of triangles.
///
/// An outline without loops makes a frame without liquid: all droplets are lost, and those of the next frame are new.
/// The first droplets of a sequence are filled by droplet.solve.fill, in whatever frame they appear.
///
/// A frame that is held continues the frame before, with its outline, volumes and vertices; the next one goes on from
/// there.
///
/// Guarantees: the volume is that of the frame before − lost + gained; with VolumeMode::Total it is the same in every
/// frame with liquid; both to 1e-9.
/// @param before    frame before, made by firstFrame() or nextFrame() from a picture of the same extent
/// @param outline   rims; none for a frame without liquid
/// @param options   options of the sequence
/// @param progress  called at every stage; may be empty
/// @throws Error    as makeDroplet, but with options.hold NoSuchDroplet only after a dry frame; InvalidInput if the
///                  extent differs; InvalidArgument if `before` has no lineage
Frame nextFrame(const Frame& before, Outline outline, const SequenceOptions& options, const Progress& progress = {});

/// Exact bytes of what nextFrame() needs of the frame before, so that an interrupted sequence can go on.
/// @param frame  made by firstFrame() or nextFrame()
std::string bytesOf(const Frame& frame);

/// Frame from its bytes, for nextFrame() alone: it has no warnings.
///
/// Guarantees: the next frame is the same as with the frame itself, to the last bit.
/// @param bytes   of bytesOf()
/// @param name    of their source, for messages
/// @throws Error  InvalidInput if they are damaged, or those of another version
Frame frameFromBytes(std::string_view bytes, const std::string& name);

}  // namespace droplet
