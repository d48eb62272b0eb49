// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// What the JavaScript around the module does for it; see node_host.js.

#define DROPLET_HOST(name) __attribute__((import_module("droplet"), import_name(#name)))

extern "C" {

/// As open(), and a negative error number.
DROPLET_HOST(open) int droplet_host_open(const char* path, int flags, int mode);

/// Gives a file another name unless a file has that, and returns 0 or a negative error number.
DROPLET_HOST(rename_to_free) int droplet_host_rename_to_free(const char* from, const char* to);

/// Shows a page in the user's browser; whether one was started.
DROPLET_HOST(open_page) bool droplet_host_open_page(const char* path);

DROPLET_HOST(sleep) void droplet_host_sleep(double milliseconds);

/// Whether a first signal does not end the command.
DROPLET_HOST(await_signals) void droplet_host_await_signals(bool are_awaited);

/// Number of the signal that was received while signals were awaited, or 0.
DROPLET_HOST(received_signal) int droplet_host_received_signal();

/// Page of an SVG.
struct DropletPage {
    double width;           ///< [CSS px]
    double height;          ///< [CSS px]
    double physical_width;  ///< [m]; 0 if it states none
    int is_damaged;         ///< whether the file is why there is no page
    char problem[1000];     ///< why it cannot be opened or drawn; else empty
    char lacking[1000];     ///< as Image::lacking
};

/// Opens an SVG; it stays open until the next one is opened.
/// @param seconds  that opening and drawing may take
DROPLET_HOST(open_svg)
void droplet_host_open_svg(const std::byte* text, std::size_t size, double seconds, DropletPage* page);

/// Draws the open SVG as wide as that, into premultiplied RGBA.
/// @param page  receives a problem
DROPLET_HOST(draw_svg)
void droplet_host_draw_svg(int width, int height, std::uint8_t* pixels, DropletPage* page);
}
